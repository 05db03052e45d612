//! What to try in a scene.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Something to try: a number of the scene that its viewers change with a slider. A path at which the scene has no
/// number shows no slider.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Try {
    /// What to try, as an invitation: "Make the floor bouncier".
    pub text: String,
    /// Path of the number, as in `colliders.0.restitution` or `forces.0.gravity.acceleration.1`.
    pub path: String,
    /// Ends of the slider, in the unit of the number.
    pub range: [f64; 2],
}
