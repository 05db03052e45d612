// Converts what queries take and find.

import { Filter } from "./engine.js";
import { rowsOf, vectorAt } from "./rows.js";

/** Positions of the values in a row; the last is a fraction of a way or a distance. */
const AT = { isCollider: 0, id: 1, point: 2, normal: 5, measure: 8 };
const COLUMNS = 9;

const ALL_GROUPS = 0xffffffff;

/** Returns the filter of the engine that these options describe; the engine's call frees it. */
export function filterOf({
  spheres = true,
  colliders = true,
  triggers = false,
  withoutSphere,
  groups = ALL_GROUPS,
  collidesWith = ALL_GROUPS,
  ...others
} = {}) {
  const [unknown] = Object.keys(others);
  if (unknown !== undefined) throw new TypeError(`a filter has no "${unknown}"`);
  const bits = [groups32("groups", groups), groups32("collidesWith", collidesWith)];
  const filter = new Filter();
  filter.setKinds(spheres, colliders, triggers);
  filter.setGroups(...bits);
  if (withoutSphere !== undefined) filter.setWithoutSphere(withoutSphere);
  return filter;
}

function groups32(name, value) {
  if (Number.isInteger(value) && value >= 0 && value <= ALL_GROUPS) return value;
  throw new TypeError(`${name} must be a whole number in [0, 2^32), not ${value}`);
}

/** Returns the hits of a table; `undefined` for a row where nothing is met. */
export function hits(table) {
  return rowsOf(table, COLUMNS).map((row) => found(row, "fraction"));
}

/** Returns the near bodies of a table; `undefined` for a row where there is none. */
export function nearBodies(table) {
  return rowsOf(table, COLUMNS).map((row) => found(row, "distance"));
}

function found(row, measure) {
  if (Number.isNaN(row[AT.isCollider])) return undefined;
  const id = row[AT.id];
  return {
    body: row[AT.isCollider] === 1 ? { collider: id } : { sphere: id },
    point: vectorAt(row, AT.point),
    normal: vectorAt(row, AT.normal),
    [measure]: row[AT.measure],
  };
}
