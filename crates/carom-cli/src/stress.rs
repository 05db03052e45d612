//! The mean stress of a run.

use carom::{DMat3, StressMeter, World};
use serde::Serialize;

use crate::failure::Failure;

/// Measures the stress in a volume.
pub struct StressGauge {
    meter: StressMeter,
    /// Volume \[m³\].
    volume: Option<f64>,
}

impl StressGauge {
    /// Begins to measure.
    ///
    /// # Errors
    /// A fault of usage where no box is around the spheres and no volume is given.
    pub fn new(world: &World, volume: Option<f64>) -> Result<Self, Failure> {
        let meter = StressMeter::new(world);
        if volume.or(meter.volume()).is_none() {
            let text =
                "--stress needs a volume, as --stress=2.5, where spheres are in no closed box";
            return Err(Failure::Usage(text.to_owned()));
        }
        Ok(Self { meter, volume })
    }

    /// Adds the last frame.
    pub fn add_frame(&mut self, world: &World) {
        self.meter.add_frame(world);
    }

    /// The mean so far; `None` before the first frame.
    pub fn mean(&self) -> Option<MeanStress> {
        let stress = self.meter.stress(self.volume).ok()?;
        let rows = |tensor: DMat3| tensor.transpose().to_cols_array_2d();
        Some(MeanStress {
            dimensions: stress.dimensions,
            pressure: stress.pressure(),
            kinetic: rows(stress.kinetic),
            collisional: rows(stress.collisional),
            contact: rows(stress.contact),
            total: rows(stress.total()),
        })
    }
}

/// Mean stress \[Pa\], row by row, as in JSON.
#[derive(Debug, Serialize)]
pub struct MeanStress {
    #[serde(skip)]
    dimensions: u32,
    pressure: f64,
    kinetic: [[f64; 3]; 3],
    collisional: [[f64; 3]; 3],
    contact: [[f64; 3]; 3],
    total: [[f64; 3]; 3],
}

impl MeanStress {
    /// Lines of the summary.
    pub fn rows(&self) -> Vec<(&'static str, String)> {
        let dimensions = f64::from(self.dimensions);
        let trace = |part: &[[f64; 3]; 3]| (part[0][0] + part[1][1] + part[2][2]) / dimensions;
        let parts = [&self.kinetic, &self.collisional, &self.contact].map(trace);
        let [kinetic, collisional, contact] = parts;
        let row = |[x, y, z]: [f64; 3]| format!("{x:.6e} {y:.6e} {z:.6e} Pa");
        vec![
            (
                "pressure",
                format!(
                    "{:.6e} Pa: motion {kinetic:.3e}, impacts {collisional:.3e}, contacts {contact:.3e}",
                    self.pressure
                ),
            ),
            ("stress x", row(self.total[0])),
            ("stress y", row(self.total[1])),
            ("stress z", row(self.total[2])),
        ]
    }
}
