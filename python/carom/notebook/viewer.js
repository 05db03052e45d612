// The viewer in the output of a notebook: the interface of the page, tied to the traits of
// `carom.notebook.Viewer`.

/** Time between two looks at the interface [ms]. */
const PAUSE = 100;

/** After so long, a viewer says what it waits for [ms]. */
const PATIENCE = 3000;

/** No scene file of more characters goes to Python: servers close connections over such messages. */
const LARGEST_SCENE = 6e6;

/** Least and largest height that a person can drag it to. */
const HEIGHTS = ["240px", "2000px"];

/**
 * @typedef {object} Model what anywidget hands over
 * @property {(name: string) => any} get
 * @property {(name: string, value: unknown) => void} set
 * @property {() => void} save_changes
 * @property {(content: object) => void} send
 * @property {(event: string, listener: (...told: any[]) => void) => void} on
 * @property {(event: string, listener: (...told: any[]) => void) => void} off
 *
 * @typedef {object} Interface what starts the interface, and the module that it starts
 * @property {any} script `embedded.js` of the page
 * @property {WebAssembly.Module} module
 */

/** Says that the model is gone that was to bring the interface. */
class Gone extends Error {
  name = "Gone";
}

/**
 * The interface, compiled once for all viewers of the document.
 *
 * @param {Model} model
 * @param {AbortSignal} end of the model
 * @returns {Promise<Interface>}
 */
async function sharedInterface(model, end) {
  const shared = /** @type {Record<string, Promise<Interface>>} */ (
    /** @type {any} */ (globalThis)["caromInterfaces"] ??= {}
  );
  const version = model.get("_version");
  for (;;) {
    const coming = (shared[version] ??= received(model, end));
    try {
      return await coming;
    } catch (error) {
      if (shared[version] === coming) delete shared[version];
      if (end.aborted || !(error instanceof Error) || error.name !== "Gone") throw error;
      // Another viewer asked for it, and went: now this one does.
    }
  }
}

/**
 * Has Python hand over the interface, as soon as it is at work on no cell.
 *
 * @param {Model} model
 * @param {AbortSignal} end
 * @returns {Promise<Interface>}
 */
async function received(model, end) {
  const [script, module] = await new Promise((resolve, reject) => {
    const take = (/** @type {any} */ message, /** @type {DataView[]} */ buffers) => {
      if (message.kind !== "interface") return;
      model.off("msg:custom", take);
      resolve(buffers);
    };
    end.addEventListener("abort", () => reject(new Gone()));
    model.on("msg:custom", take);
    model.send({ kind: "interface" });
  });
  const url = URL.createObjectURL(await unzipped(script, "text/javascript").blob());
  try {
    const compiled = WebAssembly.compileStreaming(unzipped(module, "application/wasm"));
    const [own, wasm] = await Promise.all([import(/* webpackIgnore: true */ url), compiled]);
    return { script: own, module: wasm };
  } finally {
    URL.revokeObjectURL(url);
  }
}

/**
 * @param {DataView} content
 * @param {string} type
 */
function unzipped(content, type) {
  const bytes = /** @type {BlobPart} */ (/** @type {unknown} */ (content));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream, { headers: { "Content-Type": type } });
}

/** The interface of one model, whatever cell shows it. */
class Viewer {
  /** @param {Model} model */
  constructor(model) {
    this.model = model;
    this.element = document.createElement("div");
    this.element.className = "carom-viewer";
    // Keys are the interface's own: the notebook would take `D D` as the end of a cell.
    this.element.dataset.lmSuppressShortcuts = "true";
    this.canvas = document.createElement("canvas");
    this.canvas.setAttribute("aria-label", "Carom");
    this.picture = document.createElement("img");
    this.picture.alt = "";
    this.message = document.createElement("p");
    this.message.setAttribute("role", "status");
    this.element.append(this.canvas, this.picture, this.message);
    this.page = /** @type {any} */ (null);
    this.timer = /** @type {any} */ (0);
    /** The scene that Python knows: its version, and the time at which it was told [s]. */
    this.told = { version: -1, at: -1 };
    /** Number of the last command that Python sent; reports begin with the first one. */
    this.command = 0;
    /** From this picture on, the interface shows what Python told it to. */
    this.obeyed = 0;
    this.hasBegun = false;
    this.gone = new AbortController();
    this.listen = (/** @type {any} */ message) => this.follow(message);
  }

  /** Starts the interface, once the element has its place. */
  async begin() {
    if (this.hasBegun) return;
    this.hasBegun = true;
    const { model } = this;
    const wheel = (/** @type {Event} */ event) => {
      // Until it is clicked the notebook scrolls on over it.
      if (!this.element.contains(document.activeElement)) event.stopPropagation();
    };
    this.element.addEventListener("wheel", wheel, { capture: true });
    for (const event of ["keydown", "keyup", "keypress"]) {
      this.element.addEventListener(event, (pressed) => pressed.stopPropagation());
    }
    const picture = model.get("_picture");
    if (picture) this.picture.src = URL.createObjectURL(new Blob([picture], { type: "image/png" }));
    this.say("Loading the viewer");
    const patience = setTimeout(() => {
      this.say("The viewer waits for Python, which is at work on a cell, or is not running.");
    }, PATIENCE);
    try {
      model.set("_ready", false);
      model.save_changes();
      const { script, module } = await sharedInterface(model, this.gone.signal);
      clearTimeout(patience);
      this.page = await script.start(this.canvas, module, model.get("link"), {
        link: (/** @type {string} */ link) => this.tell("link", link),
        end: (/** @type {string} */ text) => this.fail(text),
      });
    } catch (error) {
      clearTimeout(patience);
      if (!this.gone.signal.aborted) this.fail(error);
      return;
    }
    if (this.gone.signal.aborted) {
      this.page.end();
      return;
    }
    model.on("msg:custom", this.listen);
    this.say("");
    this.timer = setInterval(() => this.report(), PAUSE);
    this.tell("_ready", true);
  }

  /** Ends the interface, with its model. */
  end() {
    this.gone.abort();
    clearInterval(this.timer);
    this.model.off("msg:custom", this.listen);
    this.page?.end();
    this.page = null;
    this.element.remove();
  }

  /**
   * Says something over the picture; nothing more with an empty text.
   *
   * @param {string} text
   */
  say(text) {
    this.message.textContent = text;
    this.message.hidden = text === "";
    this.picture.hidden = text === "" || !this.picture.src;
  }

  /**
   * Says why there is no interface (any more).
   *
   * @param {unknown} error
   */
  fail(error) {
    console.error(error);
    clearInterval(this.timer);
    this.say(error instanceof Error ? error.message : String(error));
    this.element.classList.add("carom-trouble");
  }

  /**
   * @param {string} name of a trait
   * @param {unknown} value
   */
  tell(name, value) {
    this.model.set(name, value);
    this.model.save_changes();
  }

  /**
   * Does what Python has sent.
   *
   * @param {{ kind: string, content: any, number: number }} message
   */
  follow({ kind, content, number }) {
    if (number === undefined) return;
    const { page, told } = this;
    // Python ignores scenes that are on their way when it sends this: the scene is sent again.
    if (kind !== "set") told.version = -1;
    else if (content.time !== undefined) told.at = -1;
    try {
      if (kind === "edit") page.edit(content);
      if (kind === "open") page.openFragment(content);
      if (kind === "set") this.set(content);
    } catch (error) {
      console.error(error);
    }
    this.command = number;
    // A command goes with the next picture, and the one after that shows what became of it.
    this.obeyed = (page.status()?.pictures ?? this.obeyed) + 2;
  }

  /**
   * Shows what Python set.
   *
   * @param {{ time?: number, playing?: boolean, picked?: number | null }} traits
   */
  set({ time, playing, picked }) {
    const { page } = this;
    if (playing === true) page.play();
    if (playing === false) page.pause();
    if (picked !== undefined) page.pick(picked ?? undefined);
    // Even to the time of now: another seek may be under way.
    if (time !== undefined) page.seek(time);
  }

  /** Tells Python what the interface shows now. */
  report() {
    if (!this.element.isConnected || this.command === 0) return;
    const { model, page, told, command: number } = this;
    const status = page.status();
    const now = status?.watching;
    if (!now || now.seeking || status.pictures < this.obeyed) return;
    const { time, playing, picked } = now;
    model.set("_shown", { time, playing, picked: picked ?? null, number });
    if (status.version !== told.version || (!playing && time !== told.at)) {
      const scene = page.scene();
      const isTold = scene !== undefined && scene.length <= LARGEST_SCENE;
      model.set("_scene_shown", { text: isTold ? scene : "", number });
      Object.assign(told, { version: status.version, at: time });
    }
    model.save_changes();
  }
}

/** @type {Viewer | null} */
let viewer = null;

export default {
  /** @param {{ model: Model }} context */
  initialize({ model }) {
    const own = new Viewer(model);
    viewer = own;
    return () => own.end();
  },

  /**
   * @param {{ model: Model, el: HTMLElement }} context
   */
  render({ model, el }) {
    const own = /** @type {Viewer} */ (viewer);
    // Displayed again: the viewer moves on, and leaves word where it was.
    own.element.parentElement?.replaceChildren("This viewer is shown in another output.");
    own.element.style.height = `${model.get("height")}px`;
    [own.element.style.minHeight, own.element.style.maxHeight] = HEIGHTS;
    el.replaceChildren(own.element);
    // Once it has its place, and with it its size.
    requestAnimationFrame(() => own.begin());
  },
};
