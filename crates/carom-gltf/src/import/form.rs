//! Recognizes meshes of spheres, boxes and rectangles.

use carom::{DQuat, DVec3};
use glam::DMat3;

use super::vertices::Triangle;

/// Shape of a mesh, in its coordinate system \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Form {
    /// A sphere.
    Sphere { center: DVec3, radius: f64 },
    /// A box, rotated by `rotation`.
    Box { center: DVec3, rotation: DQuat, size: DVec3 },
    /// A rectangle, rotated by `rotation`; before that it lies in the xz plane and faces +y.
    Rectangle { center: DVec3, rotation: DQuat, size: [f64; 2] },
    /// Everything below the xz plane; no mesh has this form.
    HalfSpace,
}

/// Largest difference between the distances of a sphere's vertices from its centre, relative to the
/// radius.
const ROUND: f64 = 0.05;
/// Smallest fraction of its bounding sphere that the mesh of a sphere fills. The vertices of
/// cylinders and cubes may have equal distances, too; the best cylinder fills 1/sqrt(3) = 0.577, a
/// cube 0.37. An icosahedron, the coarsest mesh of a sphere in use, fills 0.605.
const FILLED: f64 = 0.59;
/// Largest difference of equal lengths, relative to the size of the mesh: vertices have 32 bits,
/// and programs often round them again.
const EQUAL: f64 = 1e-5;

/// Recognizes the form of a mesh; the error is the reason for the report.
pub(super) fn of(triangles: &[Triangle]) -> Result<Form, &'static str> {
    let size = Bounds::of(triangles, DMat3::IDENTITY).ok_or("its mesh has no triangles")?.size();
    if size.max_element() == 0.0 {
        return Err("its mesh has no size");
    }
    // First along the axes of the mesh, then along the edges of its first right angle.
    let frames = std::iter::once(DMat3::IDENTITY).chain(edge_frame(triangles));
    let angular = frames.filter_map(|frame| box_or_rectangle(triangles, frame)).next();
    angular.or_else(|| sphere(triangles)).ok_or("its mesh is neither sphere, box nor rectangle")
}

/// Bounding box of a mesh along three axes.
struct Bounds {
    least: DVec3,
    most: DVec3,
}

impl Bounds {
    /// Computes the bounds along the columns of a rotation.
    fn of(triangles: &[Triangle], frame: DMat3) -> Option<Self> {
        let local = frame.transpose();
        let mut corners = triangles.as_flattened().iter().map(|corner| local * *corner);
        let first = corners.next()?;
        let start = Self { least: first, most: first };
        Some(corners.fold(start, |Self { least, most }, it| Self {
            least: least.min(it),
            most: most.max(it),
        }))
    }

    fn size(&self) -> DVec3 {
        self.most - self.least
    }

    fn center(&self) -> DVec3 {
        0.5 * (self.least + self.most)
    }
}

fn sphere(triangles: &[Triangle]) -> Option<Form> {
    let center = Bounds::of(triangles, DMat3::IDENTITY)?.center();
    let distances = || triangles.as_flattened().iter().map(|corner| corner.distance(center));
    let radius = distances().fold(0.0, f64::max);
    let is_round = distances().all(|it| it >= (1.0 - ROUND) * radius);
    let volume = 4.0 / 3.0 * std::f64::consts::PI * radius * radius * radius;
    let is_filled = enclosed_volume(triangles, center) >= FILLED * volume;
    // Vertices have 24 bits; digits after the seventh are rounding errors.
    let radius = format!("{radius:.6e}").parse().unwrap_or(radius);
    (is_round && is_filled).then_some(Form::Sphere { center, radius })
}

/// Volume between triangles and a centre inside.
fn enclosed_volume(triangles: &[Triangle], center: DVec3) -> f64 {
    let part = |corners: &Triangle| {
        let [a, b, c] = corners.map(|corner| corner - center);
        a.dot(b.cross(c)) / 6.0
    };
    triangles.iter().map(part).sum::<f64>().abs()
}

/// Recognizes a box or rectangle whose faces are aligned with the columns of a rotation.
fn box_or_rectangle(triangles: &[Triangle], frame: DMat3) -> Option<Form> {
    let bounds = Bounds::of(triangles, frame)?;
    let size = bounds.size();
    let flat = size.to_array().map(|it| it <= EQUAL * size.max_element());
    let center = frame * bounds.center();
    match flat.iter().filter(|it| **it).count() {
        0 => {
            let volume = size.x * size.y * size.z;
            // A mesh that fills its bounds is a box, whatever its triangles are.
            let fills = (enclosed_volume(triangles, center) - volume).abs() <= EQUAL * volume;
            let rotation = DQuat::from_mat3(&frame);
            fills.then_some(Form::Box { center, rotation, size })
        }
        1 => {
            let axis = flat.iter().position(|it| *it)?;
            let [z, x] = [(axis + 1) % 3, (axis + 2) % 3];
            let area_vectors = triangles.iter().map(|[a, b, c]| 0.5 * (*b - *a).cross(*c - *a));
            let (whole, area) = area_vectors
                .fold((DVec3::ZERO, 0.0), |(sum, area), it| (sum + it, area + it.length()));
            let bounds = size[x] * size[z];
            let equals = |area: f64| (area - bounds).abs() <= EQUAL * bounds;
            // A rectangle visible from both sides has each triangle twice.
            if !equals(area) || !equals(whole.length()) {
                return None;
            }
            let faces_back = whole.dot(frame.col(axis)) < 0.0;
            let sign = if faces_back { -1.0 } else { 1.0 };
            // The directions z, x and axis are right-handed, and so are x, axis and z.
            let columns = [sign * frame.col(x), sign * frame.col(axis), frame.col(z)];
            let rotation = DQuat::from_mat3(&DMat3::from_cols(columns[0], columns[1], columns[2]));
            Some(Form::Rectangle { center, rotation, size: [size[x], size[z]] })
        }
        _ => None,
    }
}

/// Axes along the edges of the first triangle with a right angle.
fn edge_frame(triangles: &[Triangle]) -> Option<DMat3> {
    let rectangular = |corners: &Triangle| {
        (0..3).find_map(|i| {
            let [corner, next, last] = [corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]];
            let x = (next - corner).try_normalize()?;
            let y = (last - corner).try_normalize()?;
            if x.dot(y).abs() > EQUAL {
                return None;
            }
            let z = x.cross(y).try_normalize()?;
            Some(DMat3::from_cols(x, z.cross(x), z))
        })
    };
    triangles.iter().find_map(rectangular)
}
