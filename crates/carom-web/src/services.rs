//! Services that the page's script provides to the interface.

use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"
/** Services that the page provides to the interface. */
export interface Services {
    /** Offers a file to the user for saving. */
    save(name: string, type: string, content: Uint8Array): void;
    /**
     * Lets the user choose a file and passes its name and content to `take`; no call if none is
     * chosen.
     */
    openFile(take: (name: string, content: Uint8Array) => void): void;
    /**
     * Starts a film; throws an `Error` with a message for the user if the browser cannot make any.
     */
    beginFilm(width: number, height: number, framesPerSecond: number): FilmService;
    /** Returns the tilt of the device, right and down, each in [-1, 1]; `null` while unknown. */
    tilt(): [number, number] | null;
    /** Returns whether the device can measure its tilt. */
    offersTilt(): boolean;
    /**
     * Switches the measurement of the tilt on or off; the browser may ask the user for permission.
     */
    useTilt(on: boolean): void;
    /** Shows the run in the address bar. */
    showFragment(fragment: string): void;
    /** Returns a message about an error since the last call, for the user. */
    trouble(): string | null;
    /** Returns whether the canvas is embedded in another document that no link opens. */
    isEmbedded(): boolean;
    /** Returns the largest number of spheres in the run of a link; `null` for the default. */
    maxSpheres(): number | null;
}

/** A film that is being written. */
export interface FilmService {
    /** Adds a picture of RGBA rows as the frame with this number, from 0; throws an `Error`. */
    add(pixels: Uint8Array, frame: number): void;
    /** Completes the film and offers it to the user for saving. Returns its name. */
    finish(name: string): string;
}
"#;

#[wasm_bindgen]
extern "C" {
    /// Services that the page provides to the interface.
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

    /// A film that is being written.
    #[wasm_bindgen(typescript_type = "FilmService")]
    pub type FilmService;

    #[wasm_bindgen(method, catch)]
    pub fn add(this: &FilmService, pixels: &[u8], frame: u32) -> Result<(), JsValue>;

    #[wasm_bindgen(method, catch)]
    pub fn finish(this: &FilmService, name: &str) -> Result<String, JsValue>;
}

/// Returns the message of a thrown value.
pub fn message(thrown: JsValue) -> String {
    match thrown.dyn_ref::<js_sys::Error>() {
        Some(error) => error.message().into(),
        None => thrown.as_string().unwrap_or_else(|| format!("{thrown:?}")),
    }
}
