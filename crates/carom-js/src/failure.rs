//! The content of a JavaScript error.

use carom_scene::part::PartError;
use carom_scene::{Fault, SceneError};
use wasm_bindgen::prelude::wasm_bindgen;

/// Why a call was refused.
#[wasm_bindgen]
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure {
    message: String,
    place: Option<Place>,
}

/// The place of an error in a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Place {
    field: String,
    line: Option<usize>,
}

impl Failure {
    /// Returns a failure without a place in a scene.
    pub(crate) fn new(message: impl ToString) -> Self {
        Self { message: message.to_string(), place: None }
    }
}

#[wasm_bindgen]
impl Failure {
    /// Returns the message of the engine.
    #[wasm_bindgen(getter)]
    pub fn message(&self) -> String {
        self.message.clone()
    }

    /// Returns whether the error is in a scene or a part of one, not in a step or a call.
    #[wasm_bindgen(getter, js_name = isInScene)]
    pub fn is_in_scene(&self) -> bool {
        self.place.is_some()
    }

    /// Returns the path of the faulty field, for example `colliders[1].restitution`; empty if there
    /// is none.
    #[wasm_bindgen(getter)]
    pub fn field(&self) -> String {
        self.place.as_ref().map_or(String::new(), |place| place.field.clone())
    }

    /// Returns the line in the text of the scene, from 1; none if the scene was described in code.
    #[wasm_bindgen(getter)]
    pub fn line(&self) -> Option<usize> {
        self.place.as_ref()?.line
    }
}

impl From<carom::Error> for Failure {
    fn from(error: carom::Error) -> Self {
        Self::new(error)
    }
}

impl From<PartError> for Failure {
    fn from(PartError { message, field }: PartError) -> Self {
        Self { message, place: Some(Place { field, line: None }) }
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        let message = error.to_string();
        let place = match error {
            SceneError::Invalid(Fault { field, line, .. }) => Place { field, line },
            SceneError::Overridden { fault, .. } => Place { field: fault.field, line: None },
            _ => Place { field: String::new(), line: None },
        };
        Self { message, place: Some(place) }
    }
}

impl From<serde_json::Error> for Failure {
    fn from(error: serde_json::Error) -> Self {
        Self::new(error)
    }
}
