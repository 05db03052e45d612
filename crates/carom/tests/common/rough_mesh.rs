//! Random meshes, and how far points are from them by brute force.

use carom::{DVec3, Mesh};

use super::{Numbers, vec};

/// What a random mesh is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A height field with a wall around it, met from above.
    Pit,
    /// A height field as an open mesh with holes, met from both sides.
    Open,
    /// A star-shaped solid.
    Solid,
    /// The same, met from within.
    Room,
    /// A height field with sheets that stand on its edges.
    Fins,
}

impl Kind {
    pub const ALL: [Self; 5] = [Self::Pit, Self::Open, Self::Solid, Self::Room, Self::Fins];
}

/// A random mesh within some 2 m of the origin, with cells of some 0.7 m.
pub fn mesh(kind: Kind, numbers: &mut Numbers) -> Mesh {
    match kind {
        Kind::Pit => {
            let count = 4 + (numbers.next() * 3.0) as usize;
            Mesh::from_heights([4.0; 2], &heights(count, 2.5, numbers)).unwrap()
        }
        Kind::Open => {
            let (vertices, triangles) = field(numbers);
            let kept = triangles.into_iter().filter(|_| numbers.next() < 0.8);
            Mesh::new(vertices, kept.collect()).unwrap()
        }
        Kind::Solid => {
            let (vertices, triangles) = star(numbers, 0.35);
            Mesh::new(vertices, triangles).unwrap()
        }
        Kind::Room => {
            let (vertices, triangles) = star(numbers, 0.6);
            let turned = triangles.into_iter().map(|[a, b, c]| [a, c, b]);
            Mesh::new(vertices.into_iter().map(|it| 2.0 * it).collect(), turned.collect()).unwrap()
        }
        Kind::Fins => {
            let (mut vertices, mut triangles) = field(numbers);
            for [a, b, _] in triangles.clone() {
                if numbers.next() < 0.2 {
                    let middle = 0.5 * (vertices[a as usize] + vertices[b as usize]);
                    let lean = 0.4 * numbers.vector();
                    triangles.push([a, b, vertices.len() as u32]);
                    vertices.push(middle + vec(0.0, 0.6, 0.0) + lean);
                }
            }
            Mesh::new(vertices, triangles).unwrap()
        }
    }
}

fn heights(count: usize, rim: f64, numbers: &mut Numbers) -> Vec<Vec<f64>> {
    let is_rim = |number: usize| number == 0 || number + 1 == count;
    let mut height = |row: usize, column: usize| {
        let height = numbers.between(-0.3, 0.3);
        if is_rim(row) || is_rim(column) { rim + height } else { height }
    };
    (0..count).map(|row| (0..count).map(|column| height(row, column)).collect()).collect()
}

fn field(numbers: &mut Numbers) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mesh = Mesh::from_heights([4.0; 2], &heights(6, 0.3, numbers)).unwrap();
    (mesh.vertices().to_vec(), mesh.triangles().to_vec())
}

/// An octahedron, cut twice, whose vertices are anywhere between 1 m less `depth` and 1 m from its middle.
fn star(numbers: &mut Numbers, depth: f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut vertices: Vec<DVec3> =
        [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| [axis, -axis]).collect();
    let mut triangles = Vec::new();
    for [x, y, z] in [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4]] {
        triangles.extend([[x, y, z], [y, x, z + 1]]);
    }
    for _ in 0..2 {
        let mut middles = std::collections::BTreeMap::new();
        let mut next = Vec::new();
        for corners in triangles {
            let mut middle = |i: usize| {
                let [a, b]: [u32; 2] = [corners[i], corners[(i + 1) % 3]];
                *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                    vertices.push((vertices[a as usize] + vertices[b as usize]).normalize());
                    vertices.len() as u32 - 1
                })
            };
            let [ab, bc, ca] = [middle(0), middle(1), middle(2)];
            let [a, b, c] = corners;
            next.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        triangles = next;
    }
    let vertices = vertices.into_iter().map(|it| numbers.between(1.0 - depth, 1.0) * it);
    (vertices.collect(), triangles)
}

/// The triangles of a mesh \[m\].
pub fn triangles(mesh: &Mesh) -> Vec<[DVec3; 3]> {
    let place = |vertex: u32| mesh.vertices()[vertex as usize];
    mesh.triangles().iter().map(|corners| corners.map(place)).collect()
}

/// How far a point is from the nearest of some triangles \[m\].
pub fn distance(point: DVec3, triangles: &[[DVec3; 3]]) -> f64 {
    let to = |corners: &[DVec3; 3]| to_triangle(point, *corners);
    triangles.iter().map(to).fold(f64::INFINITY, f64::min)
}

/// The distance of a point from a triangle: that from its plane where the foot is inside, else that from the
/// nearest side.
fn to_triangle(point: DVec3, corners: [DVec3; 3]) -> f64 {
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a).normalize();
    let sides = [[a, b], [b, c], [c, a]];
    let is_inside = |[from, to]: &[DVec3; 2]| normal.dot((*to - *from).cross(point - *from)) >= 0.0;
    if sides.iter().all(is_inside) {
        return normal.dot(point - a).abs();
    }
    let to_side = |[from, to]: [DVec3; 2]| {
        let way = to - from;
        let part = ((point - from).dot(way) / way.length_squared()).clamp(0.0, 1.0);
        (point - from - part * way).length()
    };
    sides.map(to_side).into_iter().fold(f64::INFINITY, f64::min)
}
