// Compares the time of a frame in the package, in Node.js, with that in the native engine.
//
// `node compare.js NATIVE PACKAGE`: the program `frame_times` and the module of the package. They
// take turns, so that other work on the machine slows both. The shortest time of each frame counts.

import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

const TURNS = 5;
/** Runs per turn; in the first, machine code of the package is still being compiled. */
const RUNS = 4;

const folder = import.meta.dirname;
const [rain, tutorial4] = [
  `${folder}/rain.toml`,
  `${folder}/../../../crates/carom-scene/scenes/tutorial4.toml`,
];
const LOADS = [
  ["1,000 spheres, `exact`", rain, { "simulation.rule": "exact" }],
  ["1,000 spheres, `bisect`", rain, { "simulation.rule": "bisect" }],
  ["1,000 spheres, `discrete`", rain, { "simulation.rule": "discrete" }],
  [
    "1,000 spheres, `bisect` that winds back all",
    rain,
    { "simulation.rule": "bisect", "simulation.bisect.wind_back": "all" },
  ],
  ["tutorial4 as it is (147 spheres, likewise)", tutorial4, {}],
];

const [program, module] = process.argv.slice(2).map((path) => resolve(path));
const { World } = await import(pathToFileURL(module));

print("load", "", ["median frame", "longest frame", "all frames"]);
print("---", "---", ["---:", "---:", "---:"]);
for (const [name, file, overrides] of LOADS) {
  const times = { native: [], package: [] };
  for (let turn = 0; turn < TURNS; turn++) {
    keepShorter(times.native, nativeTimes(file, overrides));
    keepShorter(times.package, packageTimes(file, overrides));
  }
  const [native, node] = [summary(times.native), summary(times.package)];
  print(name, "native", native.map(milliseconds));
  print("", "Node.js", node.map(milliseconds));
  print("", "ratio", ratios(node, native));
}

/** Prints a row of a table. */
function print(load, what, values) {
  console.log(`| ${[load, what, ...values].join(" | ")} |`);
}

function milliseconds(time) {
  return `${time.toFixed(3)} ms`;
}

function ratios(times, others) {
  return times.map((time, i) => (time / others[i]).toFixed(2));
}

/** Returns median, maximum and sum of times [ms]. */
function summary(times) {
  const sorted = times.toSorted((a, b) => a - b);
  const sum = sorted.reduce((sum, time) => sum + time, 0);
  return [sorted[Math.floor(sorted.length / 2)], sorted.at(-1), sum];
}

function keepShorter(shortest, times) {
  times.forEach((time, i) => (shortest[i] = Math.min(shortest[i] ?? Infinity, time)));
}

function nativeTimes(file, overrides) {
  const changes = Object.entries(overrides).map(([path, value]) => `${path}=${value}`);
  return JSON.parse(execFileSync(program, [file, String(RUNS), ...changes], { encoding: "utf8" }));
}

function packageTimes(file, overrides) {
  const text = readFileSync(file, "utf8");
  const shortest = [];
  for (let run = 0; run < RUNS; run++) {
    const world = World.fromScene(text, overrides);
    keepShorter(shortest, frameTimes(world));
    world.free();
  }
  return shortest;
}

/** Returns the times of all frames until the scene's duration is over [ms]. */
function frameTimes(world) {
  const { duration } = world.simulation;
  const times = [];
  while (world.time < duration) {
    const began = performance.now();
    world.step();
    times.push(performance.now() - began);
  }
  return times;
}
