// Files that the user chooses.

import { noteTrouble } from "./trouble.js";

/** Endings of what can be opened: scenes and mazes. */
const ENDINGS = ".toml,.txt";

/**
 * Asks for a file, and gives its name and content; nothing where none is chosen.
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
