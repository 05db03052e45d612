//! How a surface takes light.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a surface reflects light. It changes no motion.
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
    /// As wood: grain along the longer side of a face; spheres are satin.
    Wood,
    /// As felt: no highlight, and a weave on faces.
    Cloth,
}

impl Finish {
    /// Metalness and roughness, each in \[0, 1\], of a physically based material that looks like it; of
    /// glass, those of its surface.
    pub fn metallic_roughness(self) -> [f64; 2] {
        match self {
            Self::Matte | Self::Cloth => [0.0, 1.0],
            Self::Satin | Self::Wood => [0.0, 0.5],
            Self::Glossy => [0.0, 0.1],
            Self::Metal => [1.0, 0.15],
            Self::Glass => [0.0, 0.0],
        }
    }

    /// The opaque finish that looks most like a physically based material of this metalness and roughness, each in
    /// \[0, 1\].
    pub fn of_metallic_roughness([metallic, roughness]: [f64; 2]) -> Self {
        match (metallic, roughness) {
            (0.5.., _) => Self::Metal,
            (_, 0.8..) => Self::Matte,
            (_, ..0.3) => Self::Glossy,
            _ => Self::Satin,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Finish;

    #[test]
    fn an_opaque_finish_is_found_again_from_its_metalness_and_roughness() {
        for finish in [Finish::Matte, Finish::Satin, Finish::Glossy, Finish::Metal] {
            assert_eq!(Finish::of_metallic_roughness(finish.metallic_roughness()), finish);
        }
    }
}
