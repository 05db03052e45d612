// A recorded run in the output of a notebook, tied to `carom.notebook.AnimatedTrajectory`.

/** Most pictures that are kept. */
const KEPT = 600;

/**
 * @typedef {object} Model what anywidget hands over
 * @property {(name: string) => any} get
 * @property {(name: string, value: unknown) => void} set
 * @property {() => void} save_changes
 * @property {(content: object) => void} send
 * @property {(event: string, listener: (...told: any[]) => void) => void} on
 * @property {(event: string, listener: (...told: any[]) => void) => void} off
 */

/**
 * The number of the state nearest to a time.
 *
 * @param {number[]} times ascending
 * @param {number} time
 */
function nearest(times, time) {
  let [low, high] = [0, times.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return time - times[low] <= times[high] - time ? low : high;
}

/** The pictures of states, as Python draws them. */
class Pictures {
  /**
   * @param {Model} model
   * @param {(index: number, picture: ImageBitmap) => void} draw
   */
  constructor(model, draw) {
    this.model = model;
    this.draw = draw;
    /** PNG files: as pixels they would fill the memory. */
    this.files = new Map([[0, new Blob([model.get("_picture")], { type: "image/png" })]]);
    /** What Python is at work on. */
    this.waiting = /** @type {number | null} */ (null);
    this.wanted = 0;
    /** Of pictures being decoded, and of the one shown: none is followed by an older one. */
    this.turns = { last: 0, shown: 0 };
    this.take = (/** @type {any} */ message, /** @type {DataView[]} */ buffers) => {
      this.keep(message.state, buffers[0]);
    };
    model.on("msg:custom", this.take);
  }

  /**
   * Shows a state as soon as it is there; of those that are wanted meanwhile, the last.
   *
   * @param {number} index
   */
  want(index) {
    this.wanted = index;
    const file = this.files.get(index);
    if (file) {
      this.show(index, file).catch(console.error);
    } else if (this.waiting === null) {
      this.waiting = index;
      this.model.send({ state: index });
    }
  }

  /**
   * @param {number} index
   * @param {DataView} content
   */
  keep(index, content) {
    const bytes = /** @type {BlobPart} */ (/** @type {unknown} */ (content));
    const file = new Blob([bytes], { type: "image/png" });
    this.files.set(index, file);
    const [oldest] = this.files.keys();
    if (this.files.size > KEPT) this.files.delete(oldest);
    // Another view of the same run may have asked for it.
    if (this.waiting !== index) return;
    this.waiting = null;
    this.show(index, file).catch(console.error);
    if (this.wanted !== index) this.want(this.wanted);
  }

  /**
   * @param {number} index
   * @param {Blob} file
   */
  async show(index, file) {
    const turn = ++this.turns.last;
    const picture = await createImageBitmap(file);
    if (turn > this.turns.shown) {
      this.turns.shown = turn;
      this.draw(index, picture);
    }
    picture.close();
  }

  end() {
    this.model.off("msg:custom", this.take);
  }
}

/**
 * What the player is made of.
 * @param {Model} model
 * @param {number} states
 */
function elements(model, states) {
  const canvas = document.createElement("canvas");
  const button = document.createElement("button");
  const slider = document.createElement("input");
  const clock = document.createElement("output");
  const bar = document.createElement("div");
  const player = document.createElement("div");
  player.className = "carom-animated";
  player.style.maxWidth = `${model.get("_width")}px`;
  [canvas.width, canvas.height] = [model.get("_width"), model.get("height")];
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", "A recorded run");
  Object.assign(slider, {
    type: "range",
    min: 0,
    max: states - 1,
    step: 1,
  });
  slider.setAttribute("aria-label", "Recorded state");
  bar.append(button, slider, clock);
  player.append(canvas, bar);
  return { player, canvas, button, slider, clock };
}

export default {
  /** @param {{ model: Model, el: HTMLElement }} context */
  render({ model, el }) {
    /** @type {number[]} */
    const times = model.get("_times");
    const { player, canvas, button, slider, clock } = elements(model, times.length);
    el.replaceChildren(player);

    const pictures = new Pictures(model, (index, picture) => {
      canvas.getContext("2d")?.drawImage(picture, 0, 0);
      canvas.dataset.state = String(index);
    });
    const last = times[times.length - 1];
    let beat = 0;
    /** By the clock of the browser [ms], and of the run [s]. */
    let since = { now: 0, time: 0 };
    /** Whether the beat sets the time, and not a hand or Python. */
    let isBeat = false;

    const show = () => {
      const index = nearest(times, model.get("time"));
      pictures.want(index);
      slider.value = String(index);
      clock.value = `${times[index].toFixed(2)} s`;
      clock.style.minWidth = `${last.toFixed(2).length + 2}ch`;
    };
    const tell = (/** @type {Record<string, unknown>} */ traits) => {
      for (const [name, value] of Object.entries(traits)) model.set(name, value);
      model.save_changes();
    };
    const advance = (/** @type {number} */ now) => {
      const time = since.time + (model.get("speed") * (now - since.now)) / 1000;
      beat = requestAnimationFrame(advance);
      isBeat = true;
      if (time >= last) tell({ time: last, playing: false });
      else tell({ time: times[nearest(times, time)] });
      isBeat = false;
    };
    const setBeat = () => {
      const playing = model.get("playing");
      button.textContent = playing ? "⏸" : "▶";
      button.setAttribute("aria-label", playing ? "Pause" : "Play");
      cancelAnimationFrame(beat);
      if (!playing) return;
      if (model.get("time") >= last) tell({ time: times[0] });
      since = { now: performance.now(), time: model.get("time") };
      beat = requestAnimationFrame(advance);
    };
    const obeyTime = () => {
      if (!isBeat) since = { now: performance.now(), time: model.get("time") };
      show();
    };

    button.addEventListener("click", () => tell({ playing: !model.get("playing") }));
    slider.addEventListener("input", () => {
      tell({ time: times[Number(slider.value)] });
    });
    model.on("change:time", obeyTime);
    model.on("change:playing change:speed", setBeat);
    show();
    setBeat();
    return () => {
      cancelAnimationFrame(beat);
      model.off("change:time", obeyTime);
      model.off("change:playing change:speed", setBeat);
      pictures.end();
    };
  },
};
