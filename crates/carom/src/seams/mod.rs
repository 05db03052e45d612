//! Seams: where flat faces of colliders lie side by side in one plane, as tiles do.
//!
//! Such faces are one surface, without edges and corners between them. `flush` finds the faces, `polyhedron` makes
//! meshes of their colliders, and `edges` and `corners` cut away the parts that other faces cover.

mod corners;
mod edges;
mod face;
mod faces;
mod flush;
mod motions;
mod polyhedron;

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use crate::collider::Collider;
use crate::collider_motion::Motion;
use crate::connected::Connected;
use crate::detect::surface_tree;
use crate::id::ColliderId;
use crate::mesh::Placement;
use crate::numbered::Numbered;
use crate::pose::Pose;
use crate::surface::{self, Form, Role, Surface};

use face::FlushFace;
use faces::Faces;
use polyhedron::Polyhedra;

/// The colliders that have faces flush with those of others.
#[derive(Debug, Clone, Default)]
pub(crate) struct Seams {
    /// Faces joined to others, by the numbers of the colliders.
    joined: BTreeMap<u64, Joined>,
    /// Whether one of them moves steadily, so that the seams depend on its present pose.
    pub are_of_now: bool,
}

/// A collider with faces that are flush with those of others.
#[derive(Debug, Clone)]
struct Joined {
    /// Lowest-numbered collider of all that are joined to each other.
    whole: ColliderId,
    /// Pose of the collider without its motion.
    rest: Pose,
    /// Forms that deflect spheres, in that pose; `None` if the seams change none.
    forms: Option<Vec<Form>>,
}

impl Seams {
    /// Finds the seams between colliders; `plain` are their surfaces without seams.
    pub fn of(colliders: &Numbered<Collider>, plain: &[Surface]) -> Self {
        let surfaces = &*at_rest(colliders, plain);
        let mut faces = Faces::of(surfaces);
        let pairs = flush::pairs(colliders, &mut faces, |_, _| true);
        let mut flush_with: BTreeMap<u64, Vec<u32>> = BTreeMap::new();
        for [first, second] in &pairs {
            for (own, other) in [(first, second), (second, first)] {
                let number = surfaces[*own as usize].collider.0;
                flush_with.entry(number).or_default().push(*other);
            }
        }
        let numbers: Vec<u64> = flush_with.keys().copied().collect();
        let whole = wholes(&numbers, &pairs, surfaces);
        let mut polyhedra = Polyhedra::default();
        let mut joined = BTreeMap::new();
        let mut are_of_now = false;
        for ((number, mut others), whole) in flush_with.into_iter().zip(whole) {
            let Some(collider) = colliders.get(number) else { continue };
            others.sort_unstable();
            others.dedup();
            let rest = motions::rest_pose(collider);
            let beside =
                others.iter().filter_map(|&it| Some(faces.face(it)?.beside(rest.position)));
            let beside: Vec<FlushFace> = beside.collect();
            let first = surfaces.partition_point(|it| it.collider.0 < number);
            let own = surfaces[first..].iter().take_while(|it| it.collider.0 == number);
            let deflecting = own.filter(|it| it.role == Role::Deflects).map(|it| &it.form);
            let forms = polyhedra.forms(&collider.shape, rest, deflecting);
            let forms = forms.map(|forms| without_covered(forms, &beside));
            are_of_now |= motions::is_steady(collider);
            joined.insert(number, Joined { whole, rest, forms });
        }
        Self { joined, are_of_now }
    }

    /// Returns whether the seams are the same after changes of colliders, which have these numbers; `plain` are the
    /// surfaces without seams. A change of colliders that are flush with no others, before and after it, leaves them.
    pub fn remain(
        &self,
        colliders: &Numbered<Collider>,
        plain: &[Surface],
        changed: &BTreeSet<u64>,
    ) -> bool {
        if self.are_of_now || changed.iter().any(|number| self.joined.contains_key(number)) {
            return false;
        }
        // Steady motion may have brought a face beside another one.
        let is_asked = |id: ColliderId, collider: &Collider| {
            changed.contains(&id.0) || motions::is_steady(collider)
        };
        let has_faces = |(number, it)| is_asked(ColliderId(number), it) && flush::has_faces(it);
        !colliders.iter().any(has_faces)
            || flush::pairs(colliders, &mut Faces::of(&at_rest(colliders, plain)), is_asked)
                .is_empty()
    }

    /// Returns the surfaces of colliders with their seams; `plain` are those without.
    pub fn applied(&self, colliders: &Numbered<Collider>, plain: Vec<Surface>) -> Vec<Surface> {
        if self.joined.is_empty() {
            return plain;
        }
        let forms = self.joined.values().filter_map(|it| it.forms.as_ref());
        let most = plain.len() + forms.map(Vec::len).sum::<usize>();
        let mut surfaces = Vec::with_capacity(most);
        for own in plain.chunk_by(|first, second| first.collider == second.collider) {
            let number = own[0].collider.0;
            match (self.joined.get(&number), colliders.get(number)) {
                (Some(joined), Some(collider)) => joined.place(collider, own, &mut surfaces),
                _ => surfaces.extend_from_slice(own),
            }
        }
        surfaces
    }
}

impl Joined {
    /// Appends the surfaces of the collider; `own` are those without seams.
    fn place(&self, collider: &Collider, own: &[Surface], surfaces: &mut Vec<Surface>) {
        let whole = self.whole;
        let as_whole = |surface: &Surface| Surface { whole, ..surface.clone() };
        let Some(forms) = &self.forms else { return surfaces.extend(own.iter().map(as_whole)) };
        surfaces.extend(own.iter().filter(|it| it.role != Role::Deflects).map(as_whole));
        let Some(deflecting) = own.iter().find(|it| it.role == Role::Deflects) else { return };
        let Pose { position: to, rotation } = collider.pose;
        let placement = (collider.pose != self.rest).then(|| Placement {
            rotation: rotation.normalize() * self.rest.rotation.normalize().conjugate(),
            from: self.rest.position,
            to,
        });
        surfaces.extend(forms.iter().map(|form| {
            let form = placement.map_or_else(|| form.clone(), |it| form.placed(&it));
            Surface { form, whole, ..deflecting.clone() }
        }));
    }
}

/// Lowest-numbered collider joined to each of these colliders, whose numbers ascend.
fn wholes(numbers: &[u64], pairs: &[[u32; 2]], surfaces: &[Surface]) -> Vec<ColliderId> {
    let mut connected = Connected::new(numbers.len());
    let place = |surface: u32| {
        let number = surfaces[surface as usize].collider.0;
        numbers.partition_point(|&it| it < number)
    };
    for [first, second] in pairs {
        connected.join(place(*first), place(*second));
    }
    (0..numbers.len()).map(|it| ColliderId(numbers[connected.root_of(it)])).collect()
}

/// Returns the surfaces of colliders in their poses at rest; `plain` are those in their present poses.
fn at_rest<'a>(colliders: &Numbered<Collider>, plain: &'a [Surface]) -> Cow<'a, [Surface]> {
    if colliders.iter().all(|(_, it)| it.motion.is_empty()) {
        return Cow::Borrowed(plain);
    }
    let mut surfaces = Vec::new();
    for (number, collider) in colliders.iter() {
        let pose = motions::rest_pose(collider);
        let still = Collider { pose, motion: Motion::default(), ..collider.clone() };
        surface::place(ColliderId(number), &still, 0.0, &mut surfaces);
    }
    Cow::Owned(surfaces)
}

/// Forms of a collider without the parts that flush faces of others cover.
fn without_covered(forms: Vec<Form>, faces: &[FlushFace]) -> Vec<Form> {
    let least = faces.iter().map(|face| 4.0 * face.gap).fold(0.0, f64::max);
    let mut kept = Vec::with_capacity(forms.len());
    let mut near = Vec::new();
    for form in forms {
        if let (Form::Edge(_) | Form::Corner(_), Some(bounds)) =
            (&form, surface_tree::bounds(&form))
        {
            near.clear();
            near.extend(faces.iter().filter(|face| face.may_cover(&bounds)));
        }
        match form {
            Form::Edge(edge) => {
                kept.extend(edges::uncovered(&edge, &near, least).into_iter().map(Form::Edge));
            }
            Form::Corner(corner) => {
                kept.extend(corners::uncovered(&corner, &near).into_iter().map(Form::Corner));
            }
            form => kept.push(form),
        }
    }
    // Most edges and corners between tiles are gone.
    kept.shrink_to_fit();
    kept
}
