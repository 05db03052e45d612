// Shows the size of each crate in a module: `node sizes.js MODULE.wasm`; the module must contain
// names.
//
// A function counts for the crate at the start of its name. A type in it, as in
// `<alloc::vec::Vec<T> as Drop>::drop`, counts for the crate of the type.

import { readFile } from "node:fs/promises";
import { gzipSync } from "node:zlib";

/** Number of crates shown by name; smaller ones are added up. */
const SHOWN = 25;

const SECTION = { custom: 0, import: 2, code: 10, data: 11 };

/** Reads the numbers of a module in order. */
class Reader {
  /** @param {Buffer} bytes */
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  byte() {
    return this.bytes[this.at++];
  }

  /** Reads an unsigned number in LEB128. */
  number() {
    let value = 0;
    for (let shift = 1; ; shift *= 128) {
      const byte = this.byte();
      value += (byte & 0x7f) * shift;
      if (byte < 0x80) {
        return value;
      }
    }
  }

  /** @param {number} length */
  take(length) {
    const part = this.bytes.subarray(this.at, this.at + length);
    this.at += length;
    return part;
  }

  text() {
    return this.take(this.number()).toString();
  }

  get isAtEnd() {
    return this.at >= this.bytes.length;
  }
}

/**
 * @param {Buffer} module
 * @returns {{ id: number, name: string, content: Buffer }[]}
 */
function sections(module) {
  const reader = new Reader(module);
  // Magic number and version.
  reader.take(8);
  const found = [];
  while (!reader.isAtEnd) {
    const id = reader.byte();
    const content = reader.take(reader.number());
    const name = id === SECTION.custom ? new Reader(content).text() : "";
    found.push({ id, name, content });
  }
  return found;
}

/**
 * Returns the names of functions by number.
 *
 * @param {Buffer} content of the section "name"
 */
function functionNames(content) {
  const reader = new Reader(content);
  reader.text();
  while (!reader.isAtEnd) {
    const kind = reader.byte();
    const part = new Reader(reader.take(reader.number()));
    if (kind === 1) {
      const names = Array.from({ length: part.number() }, () => [part.number(), part.text()]);
      return new Map(/** @type {[number, string][]} */ (names));
    }
  }
  return new Map();
}

/** @param {Buffer} content of the section of imports */
function importedFunctions(content) {
  const reader = new Reader(content);
  let functions = 0;
  for (let left = reader.number(); left > 0; left -= 1) {
    reader.text();
    reader.text();
    const kind = reader.byte();
    if (kind === 0) {
      reader.number();
      functions += 1;
    } else {
      skipType(reader, kind);
    }
  }
  return functions;
}

/**
 * @param {Reader} reader
 * @param {number} kind of import: table, memory, global or tag
 */
function skipType(reader, kind) {
  const skipLimits = () => {
    const hasMost = (reader.byte() & 1) === 1;
    reader.number();
    if (hasMost) {
      reader.number();
    }
  };
  if (kind === 1) {
    reader.byte();
    skipLimits();
  } else if (kind === 2) {
    skipLimits();
  } else {
    reader.take(2);
  }
}

/** @param {string} name of a function */
function crateOf(name) {
  const first = /[A-Za-z_][A-Za-z0-9_]*(?=::)/.exec(name);
  return first?.[0] ?? "(no crate)";
}

/** @param {string} path */
async function report(path) {
  const parts = sections(await readFile(path));
  const content = (/** @type {number} */ id) => parts.find((part) => part.id === id)?.content;
  const names = parts.find((part) => part.name === "name")?.content;
  const code = content(SECTION.code);
  if (names === undefined || code === undefined) {
    throw new Error(`${path} bears no names of functions`);
  }
  const known = functionNames(names);
  const reader = new Reader(code);
  let index = importedFunctions(content(SECTION.import) ?? Buffer.from([0]));
  /** @type {Map<string, number>} */
  const crates = new Map();
  for (let left = reader.number(); left > 0; left -= 1, index += 1) {
    const { length } = reader.take(reader.number());
    const crate = crateOf(known.get(index) ?? "");
    crates.set(crate, (crates.get(crate) ?? 0) + length);
  }
  const largest = [...crates].sort(([, a], [, b]) => b - a);
  const rest = largest.slice(SHOWN).reduce((sum, [, bytes]) => sum + bytes, 0);
  line("bytes", "gzip", "");
  for (const { id, name, content } of parts.filter((part) => part.content.length > 10_000)) {
    const called = Object.entries(SECTION).find(([, number]) => number === id)?.[0];
    line(content.length, gzipSync(content).length, `section ${name || called || id}`);
  }
  for (const [crate, bytes] of [...largest.slice(0, SHOWN), ["others", rest]]) {
    line(bytes, "", `code of ${crate}`);
  }
}

/** @param {(string | number)[]} columns */
function line(...columns) {
  const [bytes, compressed, what] = columns.map((column) => column.toLocaleString("en"));
  console.log(`${bytes.padStart(11)} ${compressed.padStart(11)}  ${what}`);
}

await report(process.argv[2]);
