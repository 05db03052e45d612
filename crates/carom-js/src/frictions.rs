//! What spheres say of friction.

use carom::{Friction, Spheres};

/// Coefficients of all spheres, as JavaScript reads them: `NaN` where a sphere says nothing. All are
/// empty while none says anything.
#[derive(Debug, Clone, Default)]
pub struct Frictions {
    /// Of sliding friction.
    pub sliding: Vec<f64>,
    /// Of rolling friction.
    pub rolling: Vec<f64>,
    /// Of spinning friction.
    pub spinning: Vec<f64>,
    /// Of tangential restitution.
    pub tangential_restitution: Vec<f64>,
}

impl Frictions {
    /// Follows a change of spheres: those before `index` are as they were.
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
