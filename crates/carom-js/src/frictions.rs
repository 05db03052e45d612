//! Friction coefficients of spheres.

use carom::{Friction, Spheres};

/// Coefficients of all spheres for JavaScript: `NaN` for a sphere without its own value. All lists
/// are empty if no sphere has one.
#[derive(Debug, Clone, Default)]
pub struct Frictions {
    /// Coefficients of sliding friction.
    pub sliding: Vec<f64>,
    /// Coefficients of rolling friction.
    pub rolling: Vec<f64>,
    /// Coefficients of spinning friction.
    pub spinning: Vec<f64>,
    /// Coefficients of tangential restitution.
    pub tangential_restitution: Vec<f64>,
}

impl Frictions {
    /// Updates the lists after a change of spheres; those before `index` are unchanged.
    pub fn follow(&mut self, spheres: &Spheres, index: usize) {
        let frictions = spheres.frictions();
        let changed = |values: &mut Vec<f64>, said: fn(&Friction) -> Option<f64>| {
            let unchanged = index.min(values.len()).min(frictions.len());
            values.truncate(unchanged);
            values.extend(frictions[unchanged..].iter().map(|it| said(it).unwrap_or(f64::NAN)));
        };
        changed(&mut self.sliding, |it| it.sliding);
        changed(&mut self.rolling, |it| it.rolling);
        changed(&mut self.spinning, |it| it.spinning);
        changed(&mut self.tangential_restitution, |it| it.tangential_restitution);
    }
}
