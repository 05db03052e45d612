// The package in Node.js: the engine is read synchronously.
import "./start.node.js";

export * from "./exports.js";
