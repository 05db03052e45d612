//! What the page's script does for the interface; `web/page/interface.d.ts` says it in TypeScript.

use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    /// What the page does for the interface.
    #[wasm_bindgen(typescript_type = "Host")]
    pub type Services;

    #[wasm_bindgen(method)]
    pub fn save(this: &Services, name: &str, kind: &str, content: &[u8]);

    /// Right and up, each in \[-1, 1\].
    #[wasm_bindgen(method)]
    pub fn tilt(this: &Services) -> Option<Vec<f32>>;

    #[wasm_bindgen(method, js_name = askForTilt)]
    pub async fn ask_for_tilt(this: &Services) -> JsValue;

    #[wasm_bindgen(method, js_name = showFragment)]
    pub fn show_fragment(this: &Services, fragment: &str);

    #[wasm_bindgen(method, catch, js_name = beginFilm)]
    pub fn begin_film(
        this: &Services,
        width: u32,
        height: u32,
        frames_per_second: u32,
    ) -> Result<FilmService, JsValue>;

    /// A film in the making.
    #[wasm_bindgen(typescript_type = "Film")]
    pub type FilmService;

    #[wasm_bindgen(method, catch)]
    pub fn add(this: &FilmService, pixels: &[u8], seconds: f64) -> Result<(), JsValue>;

    #[wasm_bindgen(method)]
    pub fn finish(this: &FilmService, name: &str);

    #[wasm_bindgen(method, getter)]
    pub fn busy(this: &FilmService) -> bool;

    /// The file's name once it is saved.
    #[wasm_bindgen(method, getter)]
    pub fn saved(this: &FilmService) -> Option<String>;

    #[wasm_bindgen(method, getter)]
    pub fn error(this: &FilmService) -> Option<String>;
}

/// The message of what a script threw.
pub fn message(thrown: JsValue) -> String {
    match thrown.dyn_ref::<js_sys::Error>() {
        Some(error) => error.message().into(),
        None => thrown.as_string().unwrap_or_else(|| format!("{thrown:?}")),
    }
}
