// The package in a browser: a module that imports it waits until the engine has arrived.
import "./start.js";

export * from "./exports.js";
