// The physics and the rules of the game: flippers, a plunger, points and three balls, on the table of `table.toml`.
// `examples/pinball/src/table.rs` does the same in the same order, so the same keys lead to the same bits.

import { World } from "carom";

/** Length of a frame of the physics [s]. */
export const FRAME = 1 / 120;
/** Balls of a game. */
const BALLS = 3;
/** Where a ball waits for the plunger [m]. */
const START = [0.28, 0.06, 0];
/** Frames that the game can go back. */
const PAST = 360;
/** Half the length of a flipper between the centres of its ends [m]. */
const HALF_FLIPPER = 0.045;
/** The axis of the right flipper [m]. */
const PIVOT = [0.115, 0.14];
/** A flipper rises by as many steps, one in a frame, from as far below. */
const STEPS = 4;
/** Frames in which the plunger is drawn back whole. */
const FULL_PULL = 64;
/** Impulse of the plunger when it is drawn back whole [N s]. */
const LAUNCH = 0.2;
/** Slower impacts neither sound nor score [m/s]. */
const SILENT = 0.05;

/** Points for a hit. */
const POINTS = { bumper: 100, slingshot: 10, target: 500 };

/** Roles of the first colliders of `table.toml`; the others are walls. */
const ROLES = [
  ...["flipper", "flipper", "bumper", "bumper", "bumper", "slingshot", "slingshot"],
  ...["target", "target", "target", "drain"],
];

/** Returns the role of the collider with this number in `table.toml`. */
export const roleOf = (number) => ROLES[number] ?? "wall";

export class Table {
  /** The last frames, the oldest overwritten first: a snapshot and the state beside the world. */
  #past = [];
  /** Frames since the start, and frames that can be gone back. */
  #frames = 0;
  #kept = 0;
  /**
   * What the game needs to go on, besides the world: balls left, with the one on the table; steps of the flippers above
   * the middle, and whether they have turned in the last frame; frames for which the plunger is drawn back.
   */
  #state = {
    score: 0,
    balls: BALLS,
    flippers: [-1, 1].map((side) => ({ side, step: -STEPS, turned: true })),
    pull: 0,
  };

  /** Makes a table from the text of `table.toml`, with a ball before the plunger. */
  constructor(toml) {
    this.world = World.fromScene(toml);
    this.ball = this.world.ids[0];
    this.colliders = this.world.colliders.map(({ id }) => id);
  }

  /**
   * Advances by a frame under the keys `left`, `right` and `plunger` that are down. Returns what there is to hear: the
   * number of the collider that the ball touches, and the impulse [N s], 0 for targets and the drain.
   */
  step(keys) {
    this.#remember();
    this.#moveFlippers([keys.left, keys.right]);
    this.#movePlunger(keys.plunger);
    this.world.step(FRAME);
    const sounds = this.#sounds();
    for (const { collider } of sounds) {
      const role = roleOf(collider);
      if (role === "drain") this.#loseBall();
      else this.#state.score += POINTS[role] ?? 0;
    }
    return sounds;
  }

  /**
   * Turns each flipper by a step; it strikes with the velocity that brings it there in the frame. One that rests is left
   * alone: then its frames are cheaper.
   */
  #moveFlippers(raised) {
    for (const [number, flipper] of this.#state.flippers.entries()) {
      const { side, step, turned } = flipper;
      const next = raised[number] ? Math.min(STEPS, step + 1) : Math.max(-STEPS, step - 1);
      if (next !== step || turned) {
        this.world.setNextPose(this.colliders[number], poseOfFlipper(side, next), FRAME);
      }
      Object.assign(flipper, { step: next, turned: next !== step });
    }
  }

  /**
   * Draws the plunger back, or lets it strike the ball that lies before it. After the last ball, that begins a new game.
   */
  #movePlunger(isDrawn) {
    const state = this.#state;
    if (isDrawn) {
      state.pull = Math.min(FULL_PULL, state.pull + 1);
      return;
    }
    const pull = state.pull;
    state.pull = 0;
    if (pull === 0 || !this.isBallWaiting) return;
    if (state.balls === 0) [state.balls, state.score] = [BALLS, 0];
    this.world.applyImpulse(this.ball, [0, LAUNCH * (pull / FULL_PULL), 0]);
  }

  /** Lists what the ball hits, then the triggers that it enters. */
  #sounds() {
    const number = (id) => this.colliders.indexOf(id);
    const hits = this.world.impacts
      .filter(({ between, approachSpeed }) => "collider" in between && approachSpeed > SILENT)
      .map(({ between, impulse }) => ({ collider: number(between.collider), impulse }));
    const entries = this.world.sensorEvents
      .filter(({ enters }) => enters)
      .map(({ collider }) => ({ collider: number(collider), impulse: 0 }));
    return [...hits, ...entries];
  }

  /** Puts the next ball before the plunger; after the last one, it waits for a new game. */
  #loseBall() {
    this.#state.balls -= 1;
    this.#state.pull = 0;
    this.world.setSphere(this.ball, { position: START, velocity: [0, 0, 0] });
  }

  /** Goes back by some frames, as far as they are kept. */
  goBack(wanted) {
    const frames = Math.min(wanted, this.#kept);
    if (frames === 0) return;
    this.#frames -= frames;
    this.#kept -= frames;
    const { snapshot, state } = this.#past[this.#frames % PAST];
    this.world.restore(snapshot);
    this.#state = structuredClone(state);
  }

  /** Keeps the present state, in the memory of the oldest one. */
  #remember() {
    const state = structuredClone(this.#state);
    const moment = this.#past[this.#frames % PAST];
    if (moment === undefined) {
      this.#past.push({ snapshot: this.world.snapshot(), state });
    } else {
      this.world.snapshotInto(moment.snapshot);
      moment.state = state;
    }
    this.#frames += 1;
    this.#kept = Math.min(PAST, this.#kept + 1);
  }

  get score() {
    return this.#state.score;
  }

  /** Balls left, with the one on the table; 0 after a game. */
  get balls() {
    return this.#state.balls;
  }

  /** Poses of both flippers after the last frame. */
  get flipperPoses() {
    return this.#state.flippers.map(({ side, step }) => poseOfFlipper(side, step));
  }

  /** Whether the ball lies before the plunger. */
  get isBallWaiting() {
    const [x, y] = this.world.positions;
    return x > START[0] - 0.02 && y < START[1] + 0.01;
  }

  /** The part of its way that the plunger is drawn back. */
  get pull() {
    return this.#state.pull / FULL_PULL;
  }
}

/**
 * Returns the pose of a flipper on the side -1 or 1, `step` steps above the middle. It turns about its outer end; a
 * capsule lies along its own y.
 *
 * A step is one of the tangent of half the angle, from which cosine and sine follow by exact divisions: the same bits in
 * every language, which functions for angles do not promise.
 */
function poseOfFlipper(side, step) {
  const tangent = step / 16;
  const square = 1 + tangent * tangent;
  const [cosine, sine] = [(1 - tangent * tangent) / square, (2 * tangent) / square];
  const [x, y] = [PIVOT[0] - HALF_FLIPPER * cosine, PIVOT[1] + HALF_FLIPPER * sine];
  return { position: [side * x, y, 0], rotation: [0, 0, side * (1 - tangent), 1 + tangent] };
}
