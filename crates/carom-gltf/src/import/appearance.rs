//! Imports cameras, lights and colours.

use carom_scene::import::{omit, shortened};
use carom_scene::scene::{Camera, Color, Finish, Sun};

use super::building::Building;
use super::error::Malformed;
use super::graph::Placed;
use super::pose::written;
use crate::color::srgb;
use crate::document::{Document, Material, MetallicRoughness};

/// Largest illuminance \[lx\] in units where pi is daylight. Larger values are photometric; there
/// the sun has up to 100,000.
const MOST_FOR_THE_EYE: f64 = 32.0;

/// Imports the camera and the light of a node, unless the scene already has one.
///
/// # Errors
/// [`Malformed`] if the camera or light does not exist.
pub(super) fn add(
    document: &Document,
    node: &Placed,
    building: &mut Building,
) -> Result<(), Malformed> {
    let extensions = &document.nodes[node.index].extensions;
    if let Some(index) = document.nodes[node.index].camera {
        let place = || format!("cameras[{index}]");
        let camera = document.cameras.get(index);
        let camera = camera.ok_or_else(|| Malformed::at(place(), "is not there"))?;
        let mut list = |reason: &str| omit(&mut building.report, &node.path, "camera", reason);
        match &camera.perspective {
            None => list("is orthographic, for which there is no counterpart"),
            Some(_) if building.scene.camera.is_some() => list("a scene has one camera"),
            Some(perspective) => {
                building.scene.camera = Some(Camera {
                    position: node.pose.written_position(),
                    rotation: node.pose.rotation.to_array(),
                    vertical_fov_degrees: shortened([perspective.yfov.to_degrees()])[0],
                    near: written(perspective.znear),
                    far: perspective.zfar.map_or(1e4 * perspective.znear.max(0.1), written),
                });
                building.places.insert("camera".to_owned(), place());
            }
        }
    }
    let Some(reference) = &extensions.light else { return Ok(()) };
    let place = || format!("extensions.KHR_lights_punctual.lights[{}]", reference.light);
    let lights = document.extensions.lights.as_ref();
    let light = lights.and_then(|it| it.lights.get(reference.light));
    let light = light.ok_or_else(|| Malformed::at(place(), "is not there"))?;
    let mut list = |reason: &str| omit(&mut building.report, &node.path, "light", reason);
    if light.kind != "directional" {
        list("only a directional light has a counterpart");
    } else if building.scene.sun.is_some() {
        list("a scene has one directional light");
    } else {
        let is_for_the_eye = light.intensity <= MOST_FOR_THE_EYE;
        if !is_for_the_eye {
            list("its illuminance is that of photometry; it is taken for plain daylight");
        }
        let intensity = if is_for_the_eye { light.intensity / std::f64::consts::PI } else { 1.0 };
        building.scene.sun = Some(Sun {
            rotation: node.pose.rotation.to_array(),
            color: shortened(light.color.map(srgb)),
            intensity: shortened([intensity])[0],
        });
        building.places.insert("sun".to_owned(), place());
    }
    Ok(())
}

/// Appearance of a mesh.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Appearance {
    pub color: Option<Color>,
    pub finish: Finish,
    /// Whether both sides are visible.
    pub double_sided: bool,
}

impl Appearance {
    /// Reads the first material of a mesh.
    ///
    /// # Errors
    /// [`Malformed`] if the mesh or material does not exist.
    pub fn of(document: &Document, mesh: usize) -> Result<Self, Malformed> {
        let missing = |place: String| Malformed::at(place, "is not there");
        let found = document.meshes.get(mesh).ok_or_else(|| missing(format!("meshes[{mesh}]")))?;
        let Some(index) = found.primitives.first().and_then(|it| it.material) else {
            return Ok(Self::default());
        };
        let material = document.materials.get(index);
        let material = material.ok_or_else(|| missing(format!("materials[{index}]")))?;
        let MetallicRoughness { base_color_factor, .. } = &material.pbr_metallic_roughness;
        let color = base_color_factor.map(|[red, green, blue, _]| {
            shortened([red, green, blue].map(|part| srgb(written(part))))
        });
        Ok(Self { color, finish: finish(material), double_sided: material.double_sided })
    }
}

fn finish(material: &Material) -> Finish {
    let MetallicRoughness { base_color_factor, metallic_factor, roughness_factor } =
        &material.pbr_metallic_roughness;
    let opacity = base_color_factor.map_or(1.0, |it| it[3]);
    let transmission = &material.extensions.transmission;
    let passes = transmission.as_ref().is_some_and(|it| it.transmission_factor > 0.5);
    if passes || (material.alpha_mode == "BLEND" && opacity < 0.5) {
        return Finish::Glass;
    }
    match (*metallic_factor, *roughness_factor) {
        // The file states neither.
        (None, None) => Finish::default(),
        (metallic, roughness) => {
            Finish::of_metallic_roughness([metallic.unwrap_or(1.0), roughness.unwrap_or(1.0)])
        }
    }
}
