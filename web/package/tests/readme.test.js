// The example for Node.js in the README prints what the README shows.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { test } from "node:test";

const readme = readFileSync(new URL("../node_modules/carom/README.md", import.meta.url), "utf8");

/** Returns the output of a program. */
function printed(program) {
  const [options, cwd] = [["--input-type=module", "--eval", program], import.meta.dirname];
  return execFileSync(process.execPath, options, { cwd, encoding: "utf8" });
}

test("the example prints what stands below it", () => {
  const section = readme.split("## In Node.js")[1];
  const [, program, expected] = section.match(/```js\n(.*?)```\s+```text\n(.*?)```/s);
  assert.equal(printed(program), expected);
});

test("the steps of a game have a place for every ball between two of them", () => {
  const [, program] = readme.split("## In a game")[1].match(/```js\n(.*?)```/s);
  assert.equal(printed(program), "true\n");
});
