// The package in a browser: who imports it waits until the engine has arrived.
import "./start.js";

export * from "./exports.js";
