//! How a surface takes light.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a surface takes light; it changes no motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Finish {
    /// As chalk and felt: no highlight.
    Matte,
    /// A soft highlight on spheres, none on surfaces.
    #[default]
    Satin,
    /// As lacquer: a sharp highlight, and the sky mirrored.
    Glossy,
    /// Polished: the sky mirrored in its colour.
    Metal,
    /// Clear, in a tint of its colour.
    Glass,
}
