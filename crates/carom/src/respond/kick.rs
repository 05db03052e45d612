/// A kick acts if it lifts the sphere by more than this part of its radius against what presses it to the
/// surface. A smaller one would only make a ball at rest hop, too low to be seen and without end.
const LEAST_LIFT: f64 = 1e-6;

/// Speed that a surface adds along its normal in an impact \[m/s\]: its `kick`, or nothing where that hardly lifts the
/// sphere.
///
/// - `pressing`: acceleration of the sphere against the normal \[m/s²\]; `radius` \[m\]
pub(crate) fn kick(kick: f64, pressing: f64, radius: f64) -> f64 {
    if kick * kick > 2.0 * LEAST_LIFT * radius * pressing { kick } else { 0.0 }
}
