export { CaromError, SceneError } from "./errors.js";
export { IMPACT_COLUMNS } from "./impacts.js";
export { scenes } from "./scenes.js";
export { Snapshot } from "./snapshot.js";
export { World } from "./world.js";
