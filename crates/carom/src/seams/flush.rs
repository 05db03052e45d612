//! Finding faces of colliders that are flush with each other.

use std::collections::BTreeMap;
use std::ops::Range;

use glam::DVec3;

use super::face::FlushFace;
use super::motions;
use crate::bounds::Bounds;
use crate::bounds_tree::{Bounded, BoundsTree};
use crate::collider::{Collider, Shape};
use crate::detect::surface_tree::{self, SurfaceTree};
use crate::id::ColliderId;
use crate::numbered::Numbered;
use crate::surface::{Form, Role, Surface};

/// Number of surfaces of a collider above which a tree finds the faces near another one.
const MANY_FACES: usize = 64;
/// Margin about bounds as a part of their coordinates: more than the distance between flush faces.
const MARGIN: f64 = 4e-9;

/// A collider with flat faces.
struct Flat<'a> {
    id: ColliderId,
    collider: &'a Collider,
    /// Range of its surfaces.
    surfaces: Range<usize>,
    /// `None` for a half-space.
    bounds: Option<Bounds>,
}

/// A bounded collider in the tree.
struct Leaf {
    bounds: Bounds,
    number: usize,
}

impl Bounded for Leaf {
    type Order = usize;

    fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    fn order(&self) -> usize {
        self.number
    }
}

/// Pairs of flush surfaces of different colliders, ascending. At least one collider of each pair satisfies `is_asked`.
pub(super) fn pairs(
    colliders: &Numbered<Collider>,
    surfaces: &[Surface],
    is_asked: impl Fn(ColliderId, &Collider) -> bool,
) -> Vec<[u32; 2]> {
    let flats = flats(colliders, surfaces);
    let asked: Vec<bool> = flats.iter().map(|it| is_asked(it.id, it.collider)).collect();
    let mut pairs = Vec::new();
    if flats.len() < 2 || !asked.contains(&true) {
        return pairs;
    }
    let leaf = |(number, flat): (usize, &Flat)| flat.bounds.map(|bounds| Leaf { bounds, number });
    let leaves = flats.iter().enumerate().filter_map(leaf).collect();
    let tree = BoundsTree::of(leaves, Vec::new(), true);
    let unbounded: Vec<usize> = (0..flats.len()).filter(|&it| flats[it].bounds.is_none()).collect();
    let mut trees = BTreeMap::new();
    for (number, flat) in flats.iter().enumerate() {
        let mut near: Vec<usize> = unbounded.iter().copied().filter(|&it| it > number).collect();
        if let Some(bounds) = &flat.bounds {
            let miss = |other: &Bounds| if other.overlap(bounds) { 0.0 } else { 1.0 };
            tree.search(&miss, &mut 0.5, &mut |leaf: &Leaf, _: &mut f64| {
                if leaf.number > number {
                    near.push(leaf.number);
                }
            });
        } else {
            near.extend((number + 1..flats.len()).filter(|&it| flats[it].bounds.is_some()));
        }
        for other in near.into_iter().filter(|&it| asked[number] || asked[it]) {
            add_pairs(surfaces, &flats, [number, other], &mut trees, &mut pairs);
        }
    }
    pairs.sort_unstable();
    pairs
}

/// Colliders with flat faces that deflect spheres.
fn flats<'a>(colliders: &'a Numbered<Collider>, surfaces: &[Surface]) -> Vec<Flat<'a>> {
    let mut flats = Vec::new();
    let mut start = 0;
    for own in surfaces.chunk_by(|first, second| first.collider == second.collider) {
        let range = start..start + own.len();
        start = range.end;
        let id = own[0].collider;
        let Some(collider) = colliders.get(id.0).filter(|it| has_faces(it)) else { continue };
        let bounds = own.iter().filter_map(|it| surface_tree::bounds(&it.form));
        let bounds = bounds.reduce(Bounds::union).map(|it| {
            let margin = MARGIN * (it.min.abs().max(it.max.abs())).max_element();
            it.widened(margin)
        });
        flats.push(Flat { id, collider, surfaces: range, bounds });
    }
    flats
}

/// Returns whether a collider has flat faces that deflect spheres.
pub(super) fn has_faces(collider: &Collider) -> bool {
    let is_flat = matches!(
        collider.shape,
        Shape::Rectangle { .. }
            | Shape::HalfSpace
            | Shape::Box { .. }
            | Shape::Container { .. }
            | Shape::Mesh(_)
    );
    is_flat && !collider.trigger
}

/// Adds the flush faces of two colliders.
fn add_pairs(
    surfaces: &[Surface],
    flats: &[Flat],
    numbers: [usize; 2],
    trees: &mut BTreeMap<usize, SurfaceTree>,
    pairs: &mut Vec<[u32; 2]>,
) {
    let [first, second] = numbers.map(|number| &flats[number]);
    let is_one = first.collider.groups == second.collider.groups
        && motions::are_one(first.collider, second.collider);
    if !is_one || is_apart(surfaces, first, second) || is_apart(surfaces, second, first) {
        return;
    }
    let (few, many) = if first.surfaces.len() <= second.surfaces.len() {
        (numbers[0], numbers[1])
    } else {
        (numbers[1], numbers[0])
    };
    let mut near: Vec<u32> = Vec::new();
    for own in faces(surfaces, flats[few].surfaces.clone()) {
        let form = &surfaces[own as usize].form;
        let all = flats[many].surfaces.clone();
        if let (Some(bounds), true) = (surface_tree::bounds(form), all.len() > MANY_FACES) {
            let numbers = all.clone().map(|it| it as u32);
            let tree = trees.entry(many).or_insert_with(|| SurfaceTree::of(surfaces, numbers));
            let margin = MARGIN * (bounds.min.abs().max(bounds.max.abs())).max_element();
            tree.near(&bounds.widened(margin), &mut near);
            near.retain(|&it| is_face(&surfaces[it as usize]));
        } else {
            near.clear();
            near.extend(faces(surfaces, all));
        }
        for &other in &near {
            if are_flush([form, &surfaces[other as usize].form]) {
                pairs.push([own.min(other), own.max(other)]);
            }
        }
    }
}

/// Returns whether a collider is a half-space whose plane does not cut the bounds of another one.
fn is_apart(surfaces: &[Surface], half_space: &Flat, other: &Flat) -> bool {
    let form = &surfaces[half_space.surfaces.start].form;
    let (Form::HalfSpace { point, normal }, Some(bounds)) = (form, &other.bounds) else {
        return false;
    };
    let (center, half) = (bounds.center(), bounds.half());
    let reach = half.dot(normal.abs());
    ((center - *point).dot(*normal)).abs() > reach + MARGIN * point.abs().max_element()
}

/// Faces among the surfaces of a range.
fn faces(surfaces: &[Surface], range: Range<usize>) -> impl Iterator<Item = u32> {
    range.filter(|&it| is_face(&surfaces[it])).map(|it| it as u32)
}

/// Returns whether a surface is a flat face that deflects spheres.
fn is_face(surface: &Surface) -> bool {
    let is_flat =
        matches!(surface.form, Form::Rectangle(_) | Form::HalfSpace { .. } | Form::Facet(_));
    is_flat && surface.role == Role::Deflects
}

/// Returns whether two flat forms are flush.
fn are_flush(forms: [&Form; 2]) -> bool {
    let normal = |form: &Form| match form {
        Form::Rectangle(it) => it.normal,
        Form::Facet(it) => it.frame.normal,
        Form::HalfSpace { normal, .. } => *normal,
        _ => DVec3::ZERO,
    };
    // Most pairs differ in their normals.
    if normal(forms[0]).dot(normal(forms[1])) < 0.5 {
        return false;
    }
    let [first, second] = forms.map(|form| FlushFace::of(form, DVec3::ZERO));
    first.zip(second).is_some_and(|(first, second)| first.is_flush_with(&second))
}
