// The package in Node.js: the engine is read at once, nothing is waited for.
import "./start.node.js";

export * from "./exports.js";
