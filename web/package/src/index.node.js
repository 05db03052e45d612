// The package in Node, Deno and Bun: the engine is read at once, nothing is waited for.
import "./start.node.js";

export * from "./exports.js";
