// The spheres of a world: arrays of all, and changes of single ones.

import { attempt, attemptPart } from "./errors.js";
import { ENGINE, Handle } from "./handle.js";
import { writeMatrices } from "./matrices.js";
import { parse } from "./names.js";
import { vector, vectors } from "./numbers.js";
import { tables } from "./toml.js";
import { Views } from "./views.js";

/** A world as far as it has spheres; `World` moves them. */
export class Spheres extends Handle {
  #views = new Views();

  // Arrays of all.

  get count() {
    return this[ENGINE].count;
  }

  get positions() {
    return this.#view("positions", Float64Array, 3);
  }

  get velocities() {
    return this.#view("velocities", Float64Array, 3);
  }

  get radii() {
    return this.#view("radii", Float64Array, 1);
  }

  get masses() {
    return this.#view("masses", Float64Array, 1);
  }

  get restitutions() {
    return this.#view("restitutions", Float64Array, 1);
  }

  get ids() {
    return this.#view("ids", Float64Array, 1);
  }

  get colors() {
    return this.#view("colors", Float32Array, 3);
  }

  get orientations() {
    return this.#viewOr("orientations", NOT_TURNED);
  }

  get angularVelocities() {
    return this.#viewOr("angularVelocities", AT_REST);
  }

  get inertiaFactors() {
    return this.#viewOr("inertiaFactors", SOLID_BALL);
  }

  get appliedForces() {
    return this.#viewOr("appliedForces", NO_FORCE);
  }

  get frictions() {
    return this.#viewOr("frictions", SILENT);
  }

  get rollingFrictions() {
    return this.#viewOr("rollingFrictions", SILENT);
  }

  get spinningFrictions() {
    return this.#viewOr("spinningFrictions", SILENT);
  }

  get tangentialRestitutions() {
    return this.#viewOr("tangentialRestitutions", SILENT);
  }

  #view(name, Type, width) {
    const world = this[ENGINE];
    return this.#views.at(name, Type, world[name], width * world.count);
  }

  /** Returns an array that the engine stores only if a sphere differs from the default. */
  #viewOr(name, usual) {
    const world = this[ENGINE];
    const isUsual = world[name] === undefined;
    return isUsual
      ? this.#views.repeated(name, usual, world.count)
      : this.#view(name, Float64Array, usual.length);
  }

  setAppliedForces(forces) {
    const world = this[ENGINE];
    const given = vectors("forces", forces);
    attempt(() => world.setAppliedForces(given));
  }

  writeMatrices(matrices) {
    writeMatrices(this, matrices);
  }

  // Single ones.

  sphere(id) {
    const world = this[ENGINE];
    return parse(attempt(() => world.sphere(id)));
  }

  setSphere(id, changes) {
    // A size or mass of another kind replaces the present one.
    const { radius, mass, ...rest } = this.sphere(id);
    const size = changes.diameter === undefined ? { radius } : {};
    const weight = changes.density === undefined ? { mass } : {};
    const text = tables({ spheres: [{ ...rest, ...size, ...weight, ...changes }] });
    attemptPart(() => this[ENGINE].setSphere(id, text));
  }

  applyImpulse(id, impulse) {
    const [world, given] = [this[ENGINE], vector("impulse", impulse)];
    attempt(() => world.applyImpulse(id, given));
  }

  applyImpulseAt(id, impulse, point) {
    const world = this[ENGINE];
    const [given, place] = [vector("impulse", impulse), vector("point", point)];
    attempt(() => world.applyImpulseAt(id, given, place));
  }

  strike(id, strike) {
    // The sphere only carries the strike.
    const text = tables({ spheres: [{ radius: 1, strike }] });
    attemptPart(() => this[ENGINE].strike(id, text));
  }

  setVelocity(id, velocity) {
    const [world, given] = [this[ENGINE], vector("velocity", velocity)];
    attempt(() => world.setVelocity(id, given));
  }

  setAngularVelocity(id, angularVelocity) {
    const [world, given] = [this[ENGINE], vector("angularVelocity", angularVelocity)];
    attempt(() => world.setAngularVelocity(id, given));
  }

  removeSphere(id) {
    attempt(() => this[ENGINE].removeSphere(id));
  }
}

// Defaults of a sphere.
const NOT_TURNED = [0, 0, 0, 1];
const AT_REST = [0, 0, 0];
const NO_FORCE = [0, 0, 0];
const SOLID_BALL = [2 / 5];
/** A sphere without its own friction. */
const SILENT = [NaN];
