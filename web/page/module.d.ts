/** The module, as wasm-bindgen wraps it; `bundle.js` says where it lies. */
declare module "carom-web" {
  import type { Host } from "./interface";

  export default function init(module: { module_or_path: WebAssembly.Module }): Promise<unknown>;

  /** Carom on a canvas. */
  export class Page {
    /** @throws an error in words for people */
    static start(canvas: HTMLCanvasElement, host: Host, fragment: string): Promise<Page>;

    /** What is shown now. */
    status(): Status;

    /** What can be used on the canvas now, in CSS pixels. */
    widgets(): Widget[];

    /** Shows what stands behind the `#` of an address. */
    openFragment(fragment: string): void;
  }

  export interface Status {
    screen: "empty" | "scene" | "maze";
    scene: string;
    source: string;
    rule: string;
    /** Simulated time [s]. */
    time: number;
    frame: number;
    playing: boolean;
    speed: number;
    seeking: boolean;
    spheres: number;
    impacts: number;
    /** [J] */
    energy: number;
    stateHash: string | null;
    notices: string[];
    chooser: boolean;
    scenes: string[];
    maze: { collected: number; of: number; won: boolean; elapsed: number } | null;
    recording: boolean;
    graphics: "WebGPU" | "WebGL2";
    /** How often the interface was drawn. */
    pictures: number;
    /** What the last drawing of the interface took of this thread [s]. */
    frameSeconds: number;
  }

  export interface Widget {
    role: string;
    label: string;
    value: string | null;
    x: number;
    y: number;
    width: number;
    height: number;
  }
}
