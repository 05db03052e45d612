//! Materials, camera and light.

use carom_scene::Coat;
use carom_scene::scene::{Camera, Color, Finish, Scene, Sun};

use crate::color::linear;
use crate::document::{
    self, Light, Material, MaterialExtensions, MetallicRoughness, Perspective, Transmission,
};

/// Second tone of balls.
const LIGHT_TONE: Color = [0.92, 0.92, 0.90];
/// Fraction of the second tone in bands and caps; the rest is the colour of the ball.
const LIGHT_PART: f64 = 0.85;

/// Creates the material of a coat; `is_mark` for the band and caps of a ball.
pub(super) fn material(coat: Coat, double_sided: bool, is_mark: bool) -> Material {
    let toned = |i: usize| coat.color[i] + LIGHT_PART * (LIGHT_TONE[i] - coat.color[i]);
    let color = if is_mark { [0, 1, 2].map(toned) } else { coat.color };
    let [red, green, blue] = color.map(linear);
    let [metallic, roughness] = coat.finish.metallic_roughness();
    let transmission =
        (coat.finish == Finish::Glass).then_some(Transmission { transmission_factor: 1.0 });
    Material {
        pbr_metallic_roughness: MetallicRoughness {
            base_color_factor: Some([red, green, blue, 1.0]),
            metallic_factor: Some(metallic),
            roughness_factor: Some(roughness),
        },
        double_sided,
        extensions: MaterialExtensions { transmission },
        ..Material::default()
    }
}

/// Converts the camera of a scene.
pub(super) fn camera(camera: &Camera) -> document::Camera {
    let perspective = Perspective {
        yfov: camera.vertical_fov_degrees.to_radians(),
        znear: camera.near,
        zfar: Some(camera.far),
    };
    document::Camera { kind: "perspective".to_owned(), perspective: Some(perspective) }
}

/// Converts the light of a scene. A white, matte surface that faces a light of intensity 1 should
/// look white. Such a surface reflects 1/pi of the illuminance in each direction, so the
/// illuminance is pi.
pub(super) fn light(sun: &Sun) -> Light {
    let intensity = std::f64::consts::PI * sun.intensity;
    Light { kind: "directional".to_owned(), color: sun.color.map(linear), intensity }
}

/// Light of the scene; the default is that of a clear morning.
pub(super) fn sun(scene: &Scene) -> Sun {
    scene.sun.clone().unwrap_or_else(|| {
        let to_sun = carom::DVec3::new(0.35, 0.8, 0.48).normalize();
        let rotation = carom::DQuat::from_rotation_arc(carom::DVec3::Z, to_sun);
        Sun { rotation: rotation.to_array(), color: [1.0, 0.957, 0.839], intensity: 1.0 }
    })
}
