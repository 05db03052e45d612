// Converts groups of impacts at one time from the engine's rows of numbers.

import { rowsOf, vectorAt } from "./rows.js";

/** Positions of the values in a row. */
const AT = {
  first: 0,
  count: 1,
  momentumBefore: 2,
  momentumAfter: 5,
  energyBefore: 8,
  energyAfter: 9,
  energyDemanded: 10,
  colliderWork: 11,
  kickWork: 12,
};
const COLUMNS = 13;

/** Returns the groups of a table as objects. */
export function impactGroups(table) {
  return rowsOf(table, COLUMNS).map((row) => ({
    first: row[AT.first],
    count: row[AT.count],
    momentumBefore: vectorAt(row, AT.momentumBefore),
    momentumAfter: vectorAt(row, AT.momentumAfter),
    energyBefore: row[AT.energyBefore],
    energyAfter: row[AT.energyAfter],
    energyDemanded: row[AT.energyDemanded],
    colliderWork: row[AT.colliderWork],
    kickWork: row[AT.kickWork],
  }));
}
