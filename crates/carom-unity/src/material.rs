//! Imports materials: colours, finishes, restitution and friction.

use carom_scene::scene::{Color, CombineRule, Finish};

use crate::class;
use crate::document;
use crate::error::ImportError;
use crate::project::Project;
use crate::value::Value;

/// Appearance of an object.
#[derive(Debug, Clone)]
pub(crate) struct Appearance {
    /// Colour; `None` if its material states none.
    pub color: Option<Color>,
    /// How its surface reflects light.
    pub finish: Finish,
    /// Whether it is drawn.
    pub visible: bool,
}

/// Appearance stated by a material file, and its parts without a counterpart.
#[derive(Debug, Clone)]
pub(crate) struct MaterialFile {
    pub look: Appearance,
    pub left_out: Vec<&'static str>,
}

/// Reads the appearance from a material file; `None` if the reference leads to no material of the
/// project, or the material has no colour.
pub(crate) fn appearance(
    reference: &Value,
    project: &Project,
) -> Result<Option<MaterialFile>, ImportError> {
    let Some(fields) = asset(reference, class::MATERIAL, project)? else { return Ok(None) };
    let saved = fields.get("m_SavedProperties");
    // Each entry is a table with one name; in files of Unity 5 and earlier, with `first` and
    // `second`.
    let named = |list: &str, name: &str| {
        saved?.get(list)?.items().iter().find_map(|it| it.get(name)).cloned()
    };
    let color = |name: &str| named("m_Colors", name);
    let Some(base) = color("_Color").or_else(|| color("_BaseColor")) else { return Ok(None) };
    let [r, g, b, opacity] = base.numbers("the colour", ["r", "g", "b", "a"])?;
    let float = |name: &str| named("m_Floats", name).map(|it| it.number(name)).transpose();
    // Name in the standard shader, then in that of the Universal Render Pipeline.
    let smoothness = float("_Glossiness")?.or(float("_Smoothness")?);
    let is_transparent = float("_Mode")?.unwrap_or(0.0) >= 2.0 || float("_Surface")? == Some(1.0);
    let finish = match (float("_Metallic")?, smoothness) {
        _ if is_transparent && opacity < 1.0 => Finish::Glass,
        (None, None) => Finish::default(),
        (metallic, smoothness) => {
            let roughness = 1.0 - smoothness.unwrap_or(0.5);
            Finish::of_metallic_roughness([metallic.unwrap_or(0.0), roughness])
        }
    };
    let mut left_out = Vec::new();
    let textures = saved.and_then(|it| it.get("m_TexEnvs")).map(Value::items).unwrap_or_default();
    let is_there = |texture: &Value| {
        texture.values().any(|it| it.get("m_Texture").is_some_and(|it| it.reference().is_some()))
    };
    if textures.iter().any(is_there) {
        left_out.push("its textures have no counterpart; its plain colour is taken");
    }
    if let Some(glow) = color("_EmissionColor")
        && glow.numbers("the colour", ["r", "g", "b"])? != [0.0; 3]
    {
        left_out.push("its glow has no counterpart");
    }
    let color = Some([r, g, b].map(|part| part.clamp(0.0, 1.0)));
    let look = Appearance { color, finish, visible: opacity > 0.0 };
    Ok(Some(MaterialFile { look, left_out }))
}

/// Restitution and friction of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Surface {
    pub bounciness: f64,
    pub friction: f64,
    pub bounce_combine: CombineRule,
    pub friction_combine: CombineRule,
}

impl Surface {
    /// Unity's default for a collider without a material.
    pub const DEFAULT: Self = Self {
        bounciness: 0.0,
        friction: 0.6,
        bounce_combine: CombineRule::Average,
        friction_combine: CombineRule::Average,
    };

    /// Reads a surface from a file; `None` if the reference leads to no physic material of the
    /// project.
    pub fn of(reference: &Value, project: &Project) -> Result<Option<Self>, ImportError> {
        let Some(fields) = asset(reference, class::PHYSIC_MATERIAL, project)? else {
            return Ok(None);
        };
        let number = |names, missing| fields.number_at_either(names, missing);
        let combine = |names| -> Result<CombineRule, ImportError> {
            Ok(match number(names, 0.0)? as i64 {
                1 => CombineRule::Product,
                2 => CombineRule::Minimum,
                3 => CombineRule::Maximum,
                _ => CombineRule::Average,
            })
        };
        Ok(Some(Self {
            bounciness: number(["bounciness", "m_Bounciness"], 0.0)?,
            friction: number(["dynamicFriction", "m_DynamicFriction"], 0.6)?,
            bounce_combine: combine(["bounceCombine", "m_BounceCombine"])?,
            friction_combine: combine(["frictionCombine", "m_FrictionCombine"])?,
        }))
    }
}

/// Fields of the first object of a class in the file of a reference.
fn asset(reference: &Value, class: u32, project: &Project) -> Result<Option<Value>, ImportError> {
    let guid = reference.reference().and_then(|it| it.guid);
    let Some(file) = guid.and_then(|guid| project.file(&guid).map(ToOwned::to_owned)) else {
        return Ok(None);
    };
    let is_text = file.extension().is_some_and(|ending| {
        ["mat", "physicMaterial", "physicsMaterial", "asset"].iter().any(|it| ending == *it)
    });
    if !is_text {
        return Ok(None);
    }
    let of_class = document::read(&file)?.into_iter().find(|document| document.class == class);
    Ok(of_class.map(|document| document.fields))
}
