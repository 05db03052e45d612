//! Imports Unity's own physics: rigid bodies, colliders, and their materials.

use std::collections::BTreeMap;

use carom_scene::import::omit;
use carom_scene::scene::{Collider, CombineRule, Force, Sphere};

use crate::build::Building;
use crate::document::Document;
use crate::error::ImportError;
use crate::graph::Node;
use crate::material::Surface;
use crate::parts::{Parts, is_set, is_trigger};
use crate::placed::Placed;
use crate::pose::mirrored;
use crate::shape::of_collider;
use crate::value::Value;

/// Unity's own physics in a scene.
#[derive(Default)]
pub(crate) struct Physics {
    /// Surfaces by the guids of their files; the first one is for colliders without a material.
    surfaces: BTreeMap<String, Option<Surface>>,
    /// Combine rules of restitution and friction of all added colliders.
    combine: Vec<(CombineRule, CombineRule)>,
    /// Different drag coefficients of the bodies \[kg/s\].
    drags: Vec<f64>,
    /// Whether gravity acts on a body.
    gravity: bool,
}

impl Physics {
    /// Adds a moving sphere, or fixed colliders.
    ///
    /// # Errors
    /// [`ImportError`] with the line of an invalid value.
    pub fn add(
        &mut self,
        node: &Node,
        parts: &Parts<'_>,
        building: &mut Building<'_>,
    ) -> Result<(), ImportError> {
        if parts.is_moving_otherwise() {
            omit(&mut building.report, &node.path, "Rigidbody", "only spheres move");
            return Ok(());
        }
        let mut body = parts.rigid_body.filter(|_| parts.is_moving_sphere());
        for collider in &parts.colliders {
            let placed = match of_collider(collider, &node.pose, building.project)? {
                Ok(placed) => placed,
                Err(reason) => {
                    omit(&mut building.report, &node.path, &collider.class_name, reason);
                    continue;
                }
            };
            let surface = self.surface(collider, node, building)?;
            let is_ball = collider.class == crate::class::SPHERE_COLLIDER && !is_trigger(collider);
            match body {
                Some(_) if !is_ball => {
                    let reason = "a body of several colliders moves as its first sphere";
                    omit(&mut building.report, &node.path, &collider.class_name, reason);
                }
                Some(it) => {
                    self.add_body(it, placed, surface, (node, parts), building)?;
                    // Further colliders of the body are reported, too.
                    body = None;
                }
                None if parts.is_moving_sphere() => {
                    let reason = "a body of several colliders moves as its first sphere";
                    omit(&mut building.report, &node.path, &collider.class_name, reason);
                }
                None => add_collider(collider, placed, surface, (node, parts), building)?,
            }
        }
        Ok(())
    }

    fn add_body(
        &mut self,
        body: &Document,
        placed: Placed,
        surface: Surface,
        (node, parts): (&Node, &Parts<'_>),
        building: &mut Building<'_>,
    ) -> Result<(), ImportError> {
        let fields = &body.fields;
        let carom_scene::scene::Shape::Sphere { radius } = placed.shape else { return Ok(()) };
        let mut sphere = Sphere::at(mirrored(placed.position), radius);
        let mass = fields.number_at("m_Mass", 1.0)?;
        sphere.mass = Some(mass);
        sphere.restitution = surface.bounciness;
        sphere.friction = Some(surface.friction);
        let look = building.look(node, parts)?;
        (sphere.color, sphere.finish) = (look.color, look.finish);
        building.push_sphere(sphere, body);
        // Unity's drag is a rate: the force is the rate times mass and velocity.
        let drag = mass * fields.number_at_either(["m_Drag", "m_LinearDamping"], 0.0)?;
        if !self.drags.contains(&drag) {
            self.drags.push(drag);
        }
        let mut list = |component: &str, reason: &str| {
            omit(&mut building.report, &node.path, component, reason);
        };
        match is_set(body, "m_UseGravity") {
            true => self.gravity = true,
            false => {
                list("Rigidbody", "has no gravity in Unity; here gravity acts on every sphere")
            }
        }
        if fields.number_at_either(["m_AngularDrag", "m_AngularDamping"], 0.0)? != 0.0 {
            list("Rigidbody", "its angular drag has no counterpart");
        }
        if is_set(body, "m_Constraints") {
            list("Rigidbody", "its constraints have no counterpart");
        }
        if let Some(reason) = placed.inexact {
            list("SphereCollider", reason);
        }
        Ok(())
    }

    fn surface(
        &mut self,
        collider: &Document,
        node: &Node,
        building: &mut Building<'_>,
    ) -> Result<Surface, ImportError> {
        let material = collider.fields.get("m_Material");
        let guid = material.and_then(Value::reference).and_then(|it| it.guid);
        let surface = match (material, guid) {
            (Some(material), Some(guid)) => {
                let known = self.surfaces.get(&guid).copied();
                let surface = known.map_or_else(|| Surface::of(material, building.project), Ok)?;
                self.surfaces.insert(guid, surface);
                if surface.is_none() {
                    let reason =
                        "its physic material is not in the project; Unity's default is taken";
                    omit(&mut building.report, &node.path, &collider.class_name, reason);
                }
                surface.unwrap_or(Surface::DEFAULT)
            }
            _ => Surface::DEFAULT,
        };
        let combine = (surface.bounce_combine, surface.friction_combine);
        if !self.combine.contains(&combine) {
            self.combine.push(combine);
        }
        Ok(surface)
    }

    /// Sets gravity, drag and combine rules, which hold for the whole scene.
    ///
    /// # Errors
    /// [`ImportError`] if the gravity of the project is no vector.
    pub fn finish(self, building: &mut Building<'_>) -> Result<(), ImportError> {
        let file = building.scene.name.clone();
        if self.gravity {
            let setting = building.project.setting("DynamicsManager.asset", "m_Gravity")?;
            let gravity = setting.map_or(Ok([0.0, -9.81, 0.0]), |it| it.vector("m_Gravity"))?;
            let acceleration = mirrored(gravity.into());
            building.scene.forces.push(Force::Gravity { acceleration });
        }
        match self.drags[..] {
            [] | [0.0] => {}
            [coefficient] => building.scene.forces.push(Force::ViscousDrag { coefficient }),
            _ => {
                let reason = "bodies of different drag times mass; they move without drag";
                omit(&mut building.report, &file, "Rigidbody", reason);
            }
        }
        // Unity's order of precedence if the materials of a contact differ.
        const FIRST: [CombineRule; 4] = [
            CombineRule::Maximum,
            CombineRule::Product,
            CombineRule::Minimum,
            CombineRule::Average,
        ];
        let chosen = |has: &dyn Fn(CombineRule) -> bool| FIRST.into_iter().find(|&rule| has(rule));
        let simulation = &mut building.scene.simulation;
        if let Some(rule) = chosen(&|rule| self.combine.iter().any(|it| it.0 == rule)) {
            simulation.combine_rule = rule;
        }
        if let Some(rule) = chosen(&|rule| self.combine.iter().any(|it| it.1 == rule)) {
            simulation.friction_combine_rule = rule;
        }
        if self.combine.len() > 1 {
            let reason = "materials combine in several ways; the scene takes the first of maximum, \
                          multiply, minimum, average for all";
            omit(&mut building.report, &file, "physic materials", reason);
        }
        Ok(())
    }
}

fn add_collider(
    document: &Document,
    placed: Placed,
    surface: Surface,
    (node, parts): (&Node, &Parts<'_>),
    building: &mut Building<'_>,
) -> Result<(), ImportError> {
    let mut collider = Collider::new(placed.shape.clone());
    collider.trigger = is_trigger(document);
    collider.restitution = surface.bounciness;
    collider.friction = Some(surface.friction);
    let look = building.look(node, parts)?;
    (collider.color, collider.finish, collider.visible) = (look.color, look.finish, look.visible);
    building.push_collider(collider, placed, node, document);
    Ok(())
}
