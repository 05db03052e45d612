// The package in a browser: a module that imports it waits for the engine.
import "./start.js";

export * from "./exports.js";
