//! What the page's script gives to the interface.

use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"
/** What the page gives to the interface. */
export interface Services {
    /** Lets the user keep a file. */
    save(name: string, type: string, content: Uint8Array): void;
    /** Asks the user for a file, and gives its name and content; nothing where none is chosen. */
    openFile(take: (name: string, content: Uint8Array) => void): void;
    /** Begins a film; throws an `Error` for people if the browser cannot make any. */
    beginFilm(width: number, height: number, framesPerSecond: number): FilmService;
    /** Right and down by the tilt of the device, each in [-1, 1]; `null` while it is not known. */
    tilt(): [number, number] | null;
    /** Whether the device can tell its tilt. */
    offersTilt(): boolean;
    /** Begins or ends to listen to the tilt; the browser may ask the user for permission. */
    useTilt(on: boolean): void;
    /** Shows the run in the address bar. */
    showFragment(fragment: string): void;
    /** What went wrong since the last call, for people. */
    trouble(): string | null;
    /** Whether the canvas is a part of some other document, and no link leads there. */
    isEmbedded(): boolean;
    /** How many spheres the run of a link may have; `null` for as many as usual. */
    maxSpheres(): number | null;
}

/** A film in the making. */
export interface FilmService {
    /** Adds a picture of RGBA rows as the frame with this number, from 0 on; throws an `Error`. */
    add(pixels: Uint8Array, frame: number): void;
    /** Completes the film and lets the user keep it. Returns what it is called. */
    finish(name: string): string;
}
"#;

#[wasm_bindgen]
extern "C" {
    /// What the page gives to the interface.
    #[wasm_bindgen(typescript_type = "Services")]
    pub type Services;

    #[wasm_bindgen(method)]
    pub fn save(this: &Services, name: &str, kind: &str, content: &[u8]);

    #[wasm_bindgen(method, js_name = openFile)]
    pub fn open_file(this: &Services, take: &js_sys::Function);

    #[wasm_bindgen(method, catch, js_name = beginFilm)]
    pub fn begin_film(
        this: &Services,
        width: u32,
        height: u32,
        frames_per_second: u32,
    ) -> Result<FilmService, JsValue>;

    #[wasm_bindgen(method)]
    pub fn tilt(this: &Services) -> Option<Vec<f32>>;

    #[wasm_bindgen(method, js_name = offersTilt)]
    pub fn offers_tilt(this: &Services) -> bool;

    #[wasm_bindgen(method, js_name = useTilt)]
    pub fn use_tilt(this: &Services, on: bool);

    #[wasm_bindgen(method, js_name = showFragment)]
    pub fn show_fragment(this: &Services, fragment: &str);

    #[wasm_bindgen(method)]
    pub fn trouble(this: &Services) -> Option<String>;

    #[wasm_bindgen(method, js_name = isEmbedded)]
    pub fn is_embedded(this: &Services) -> bool;

    #[wasm_bindgen(method, js_name = maxSpheres)]
    pub fn max_spheres(this: &Services) -> Option<f64>;

    /// A film in the making.
    #[wasm_bindgen(typescript_type = "FilmService")]
    pub type FilmService;

    #[wasm_bindgen(method, catch)]
    pub fn add(this: &FilmService, pixels: &[u8], frame: u32) -> Result<(), JsValue>;

    #[wasm_bindgen(method, catch)]
    pub fn finish(this: &FilmService, name: &str) -> Result<String, JsValue>;
}

/// The message of what a script threw.
pub fn message(thrown: JsValue) -> String {
    match thrown.dyn_ref::<js_sys::Error>() {
        Some(error) => error.message().into(),
        None => thrown.as_string().unwrap_or_else(|| format!("{thrown:?}")),
    }
}
