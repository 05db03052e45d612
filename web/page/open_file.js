// Lets the user choose a file.

import { noteTrouble } from "./trouble.js";

/** Extensions of files that can be opened: scenes and mazes. */
const ENDINGS = ".toml,.txt";

/**
 * Asks for a file and passes its name and content to `take`; no call if none is chosen.
 *
 * @param {(name: string, content: Uint8Array) => void} take
 */
export function openFile(take) {
  const input = document.createElement("input");
  input.type = "file";
  input.accept = ENDINGS;
  input.addEventListener("change", () => {
    const file = input.files?.[0];
    if (!file) return;
    file.arrayBuffer().then(
      (content) => take(file.name, new Uint8Array(content)),
      (error) => noteTrouble(`cannot read ${file.name}: ${error.message}`),
    );
  });
  input.click();
}
