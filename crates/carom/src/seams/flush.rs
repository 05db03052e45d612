//! Finding faces of colliders that are flush with each other.

use std::collections::BTreeMap;
use std::ops::Range;

use glam::DVec3;

use super::faces::Faces;
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
    /// Faces of the collider, with their normals.
    faces: Vec<(u32, DVec3)>,
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
    faces: &mut Faces,
    is_asked: impl Fn(ColliderId, &Collider) -> bool,
) -> Vec<[u32; 2]> {
    let flats = flats(colliders, faces.surfaces);
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
            add_pairs(faces, &flats, [number, other], &mut trees, &mut pairs);
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
        let faces = range.clone().filter_map(|it| Some((it as u32, normal_of(&surfaces[it])?)));
        let faces = faces.collect();
        flats.push(Flat { id, collider, surfaces: range, faces, bounds });
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
    faces: &mut Faces,
    flats: &[Flat],
    numbers: [usize; 2],
    trees: &mut BTreeMap<usize, SurfaceTree>,
    pairs: &mut Vec<[u32; 2]>,
) {
    let surfaces = faces.surfaces;
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
    let (few, many) = (&flats[few], &flats[many]);
    let mut near: Vec<u32> = Vec::new();
    for &(own, normal) in &few.faces {
        let bounds = surface_tree::bounds(&surfaces[own as usize].form);
        near.clear();
        if let (Some(bounds), true) = (bounds, many.surfaces.len() > MANY_FACES) {
            let numbers = many.surfaces.clone().map(|it| it as u32);
            let tree = trees
                .entry(many.surfaces.start)
                .or_insert_with(|| SurfaceTree::of(surfaces, numbers));
            let margin = MARGIN * (bounds.min.abs().max(bounds.max.abs())).max_element();
            tree.near(&bounds.widened(margin), &mut near);
            near.retain(|&it| {
                normal_of(&surfaces[it as usize]).is_some_and(|it| faces_alike(it, normal))
            });
        } else {
            let alike = many.faces.iter().filter(|(_, it)| faces_alike(*it, normal));
            near.extend(alike.map(|(number, _)| number));
        }
        for &other in &near {
            if faces.are_flush([own, other]) {
                pairs.push([own.min(other), own.max(other)]);
            }
        }
    }
}

/// Returns whether two normals may be those of flush faces. Most pairs differ in them.
fn faces_alike(normal: DVec3, other: DVec3) -> bool {
    normal.dot(other) >= 0.5
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

/// Normal of a flat face that deflects spheres; `None` of another surface.
fn normal_of(surface: &Surface) -> Option<DVec3> {
    if surface.role != Role::Deflects {
        return None;
    }
    match &surface.form {
        Form::Rectangle(it) => Some(it.normal),
        Form::Facet(it) => Some(it.frame.normal),
        Form::HalfSpace { normal, .. } => Some(*normal),
        _ => None,
    }
}
