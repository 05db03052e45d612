// What the README shows of Node.js is what happens.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { test } from "node:test";

const readme = readFileSync(new URL("../node_modules/carom/README.md", import.meta.url), "utf8");

test("the example prints what stands below it", () => {
  const section = readme.split("## In Node.js")[1];
  const [, program, printed] = section.match(/```js\n(.*?)```\s+```text\n(.*?)```/s);
  const [options, cwd] = [["--input-type=module", "--eval", program], import.meta.dirname];
  assert.equal(execFileSync(process.execPath, options, { cwd, encoding: "utf8" }), printed);
});
