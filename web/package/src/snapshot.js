// Snapshots of worlds, also as bytes.

import * as engine from "./engine.js";
import { attempt } from "./errors.js";
import { ENGINE, Handle } from "./handle.js";

export class Snapshot extends Handle {
  constructor(snapshot) {
    super(snapshot, "snapshot");
  }

  static fromBytes(bytes) {
    const given = new Uint8Array(bytes);
    return new Snapshot(attempt(() => engine.Snapshot.fromBytes(given)));
  }

  get time() {
    return this[ENGINE].time;
  }

  toBytes() {
    const snapshot = this[ENGINE];
    return attempt(() => snapshot.toBytes());
  }
}
