// The pinball of `examples/pinball-web`, without its picture: ten seconds of keys lead to the state hash and the score of
// the game in Rust.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { Table } from "../pinball-web/table.js";

const read = (name) => readFileSync(new URL(`../pinball/${name}`, import.meta.url), "utf8");
const FRAMES = 1200;

/** Returns the keys of `crates/carom-scene/tests/pinball_example.rs`. */
const keys = (frame) => ({
  left: Math.floor(frame / 20) % 2 === 0,
  right: Math.floor(frame / 27) % 2 === 0,
  plunger: frame % 90 < 60,
});

test("ten seconds of pinball lead to the bits of the game in Rust, also after going back", () => {
  const table = new Table(read("table.toml"));
  const reached = () => `${table.world.stateHash()} ${table.score}`;
  for (let frame = 0; frame < FRAMES; frame++) table.step(keys(frame));
  assert.equal(reached(), read("ten_seconds.txt").trim());
  table.goBack(300);
  for (let frame = FRAMES - 300; frame < FRAMES; frame++) table.step(keys(frame));
  assert.equal(reached(), read("ten_seconds.txt").trim());
});
