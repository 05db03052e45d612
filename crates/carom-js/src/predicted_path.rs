//! Predicted paths of spheres.

use carom::{DVec3, PathEnd, PredictedPath};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::failure::Failure;
use crate::find;
use crate::impact_table;
use crate::world::World;

/// A predicted path.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Path(PredictedPath);

#[wasm_bindgen]
impl World {
    /// Predicts the path of a sphere for `horizon` \[s\], or up to its impact number `most_impacts`.
    ///
    /// # Errors
    /// [`Failure`] as [`carom::World::predict`].
    pub fn predict(&self, id: f64, horizon: f64, most_impacts: f64) -> Result<Path, Failure> {
        let (sphere, _) = find::sphere(&self.world, id)?;
        Ok(Path(self.world.predict(sphere, horizon, most_impacts as usize)?))
    }
}

#[wasm_bindgen]
impl Path {
    /// Returns the table of impacts, one row each; times are from the prediction on \[s\].
    #[wasm_bindgen(getter)]
    pub fn impacts(&self) -> Vec<f64> {
        impact_table::of(&self.0.impacts)
    }

    /// Returns the legs in rows: start, end, start of the flight \[s\], position, velocity,
    /// acceleration, drag rate.
    #[wasm_bindgen(getter)]
    pub fn legs(&self) -> Vec<f64> {
        let mut table = Vec::with_capacity(LEG_COLUMNS * self.0.legs.len());
        for leg in &self.0.legs {
            table.extend([leg.start, leg.end, leg.flight_start]);
            let flight = leg.flight;
            let vectors = [flight.position, flight.velocity, flight.acceleration];
            table.extend(vectors.iter().flat_map(|vector| vector.to_array()));
            table.push(flight.drag_rate);
        }
        table
    }

    /// Returns where the path ends.
    #[wasm_bindgen(getter)]
    pub fn end(&self) -> String {
        let end = match self.0.end {
            PathEnd::Impacts => "impacts",
            PathEnd::NoClosedForm => "no closed form",
            // `PathEnd` may get further ends.
            _ => "horizon",
        };
        end.to_owned()
    }

    /// Returns when the path ends, on the world's clock \[s\].
    #[wasm_bindgen(getter, js_name = endTime)]
    pub fn end_time(&self) -> f64 {
        self.0.end_time()
    }

    /// Returns the centre \[m\] at a time on the world's clock \[s\]; nothing outside of the path.
    #[wasm_bindgen(js_name = positionAt)]
    pub fn position_at(&self, time: f64) -> Option<Vec<f64>> {
        self.0.position_at(time).map(numbers)
    }

    /// Returns the velocity \[m/s\] at a time on the world's clock \[s\]; nothing outside of the path.
    #[wasm_bindgen(js_name = velocityAt)]
    pub fn velocity_at(&self, time: f64) -> Option<Vec<f64>> {
        self.0.velocity_at(time).map(numbers)
    }
}

/// Numbers per row; `web/package/src/path.js` reads them.
const LEG_COLUMNS: usize = 13;

fn numbers(vector: DVec3) -> Vec<f64> {
    vector.to_array().to_vec()
}
