//! Imports cameras and lights.

use carom_scene::import::{Omission, omit};
use carom_scene::scene::{Camera, Colors, Scene, Sun};

use crate::document::Document;
use crate::error::ImportError;
use crate::graph::Node;
use crate::pose::{mirrored, mirrored_rotation};
use crate::value::Value;

/// Imports a camera, if it is the first one or the main camera.
pub(crate) fn camera(
    document: &Document,
    node: &Node,
    scene: &mut Scene,
    report: &mut Vec<Omission>,
) -> Result<bool, ImportError> {
    let fields = &document.fields;
    if scene.camera.is_some() && node.tag != "MainCamera" {
        omit(report, &node.path, "Camera", "a scene has one camera");
        return Ok(false);
    }
    if fields.number_at("orthographic", 0.0)? != 0.0 {
        omit(report, &node.path, "Camera", "is orthographic; it is drawn in perspective");
    }
    scene.camera = Some(Camera {
        position: mirrored(node.pose.position),
        rotation: mirrored_rotation(node.pose.rotation),
        vertical_fov_degrees: fields.number_at("field of view", 60.0)?,
        near: fields.number_at("near clip plane", 0.3)?,
        far: fields.number_at("far clip plane", 1000.0)?,
    });
    // The background is a colour, not the sky.
    if fields.number_at("m_ClearFlags", 1.0)? == 2.0
        && let Some(color) = fields.get("m_BackGroundColor")
    {
        let background = rgb(color)?;
        scene.colors = Some(Colors { background: Some(background), ..Colors::default() });
    }
    Ok(true)
}

/// Imports a directional light.
pub(crate) fn light(
    document: &Document,
    node: &Node,
    scene: &mut Scene,
    report: &mut Vec<Omission>,
) -> Result<bool, ImportError> {
    let fields = &document.fields;
    if fields.number_at("m_Type", 1.0)? != 1.0 {
        omit(report, &node.path, "Light", "only a directional light has a counterpart");
        return Ok(false);
    }
    if scene.sun.is_some() {
        omit(report, &node.path, "Light", "a scene has one directional light");
        return Ok(false);
    }
    scene.sun = Some(Sun {
        rotation: mirrored_rotation(node.pose.rotation),
        color: fields.get("m_Color").map_or(Ok([1.0; 3]), rgb)?,
        intensity: fields.number_at("m_Intensity", 1.0)?,
    });
    Ok(true)
}

fn rgb(value: &Value) -> Result<[f64; 3], ImportError> {
    // Parts above 1 are for displays of high dynamic range.
    let color = value.numbers("the colour", ["r", "g", "b"])?;
    Ok(color.map(|part| part.clamp(0.0, 1.0)))
}
