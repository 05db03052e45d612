//! Materials: colours, and how surfaces bounce and rub.

use carom_scene::scene::{Color, CombineRule};

use crate::class;
use crate::document;
use crate::error::ImportError;
use crate::project::Project;
use crate::value::Value;

/// The colour of a material file, and whether it is seen at all; `None` where the reference leads to
/// no material of the project.
pub(crate) fn color(
    reference: &Value,
    project: &Project,
) -> Result<Option<(Color, bool)>, ImportError> {
    let Some(fields) = asset(reference, class::MATERIAL, project)? else { return Ok(None) };
    let colors = fields.get("m_SavedProperties").and_then(|it| it.get("m_Colors"));
    // Each is a table of one name; in files of Unity 5 and before, `first` and `second`.
    let named = |name: &str| colors.and_then(|it| it.items().iter().find_map(|it| it.get(name)));
    let Some(color) = named("_Color").or_else(|| named("_BaseColor")) else { return Ok(None) };
    let [r, g, b, a] = color.numbers("the colour", ["r", "g", "b", "a"])?;
    Ok(Some(([r, g, b].map(|part| part.clamp(0.0, 1.0)), a > 0.0)))
}

/// How a surface bounces and rubs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Surface {
    pub bounciness: f64,
    pub friction: f64,
    pub bounce_combine: CombineRule,
    pub friction_combine: CombineRule,
}

impl Surface {
    /// What Unity takes for a collider without a material.
    pub const DEFAULT: Self = Self {
        bounciness: 0.0,
        friction: 0.6,
        bounce_combine: CombineRule::Average,
        friction_combine: CombineRule::Average,
    };

    /// The surface of a file; `None` where the reference leads to no physic material of the project.
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

/// The fields of the first object of a class in the file of a reference.
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
