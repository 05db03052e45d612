//! How fast a tessellated sphere becomes a sphere: places of contact by the square of the length of its edges, the
//! directions of bounces by that length, as the normals of facets do.

mod common;

use std::collections::BTreeMap;

use carom::{Collider, DVec3, Exact, Impact, Mesh, Pose, Rule, Settings, Shape, Sphere, World};
use common::Numbers;

const BALL: f64 = 0.3;
const SHOTS: usize = 500;

/// A unit sphere of 20 triangles, each cut into four as often as given.
fn icosphere(cuts: usize) -> Mesh {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let mut vertices = Vec::new();
    for (a, b) in [(1.0, golden), (-1.0, golden), (1.0, -golden), (-1.0, -golden)] {
        vertices.extend([[0.0, a, b], [a, b, 0.0], [b, 0.0, a]].map(DVec3::from_array));
    }
    let mut vertices: Vec<DVec3> = vertices.into_iter().map(DVec3::normalize).collect();
    let edge = 1.1;
    let mut triangles = Vec::new();
    for a in 0..12u32 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                let [p, q, s] = [a, b, c].map(|it| vertices[it as usize]);
                let is_face = [(p, q), (q, s), (s, p)].iter().all(|(p, q)| p.distance(*q) < edge);
                let is_outward = (q - p).cross(s - p).dot(p) > 0.0;
                if is_face {
                    triangles.push(if is_outward { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    for _ in 0..cuts {
        let mut middles = BTreeMap::new();
        let mut cut = Vec::new();
        for [a, b, c] in triangles {
            let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|[a, b]| {
                *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                    vertices.push((vertices[a as usize] + vertices[b as usize]).normalize());
                    vertices.len() as u32 - 1
                })
            });
            cut.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        triangles = cut;
    }
    Mesh::new(vertices, triangles).unwrap()
}

/// The first impacts of the same shots at a shape about the origin, by ball.
fn impacts(shape: Shape) -> Vec<Impact> {
    let mut settings = Settings::default().with_rule(Rule::Exact(Exact::default()));
    settings.spheres_collide = false;
    let mut world = World::new(settings).unwrap();
    world.add_collider(Collider::new(shape, Pose::at(DVec3::ZERO))).unwrap();
    let mut numbers = Numbers(7);
    for _ in 0..SHOTS {
        let from = 3.0 * numbers.unit_vector();
        let aim = 0.6 * numbers.vector();
        let shot = Sphere::new(from, BALL).with_velocity((aim - from).normalize());
        world.add_sphere(shot).unwrap();
    }
    let report = world.step(4.0).unwrap();
    let mut first = BTreeMap::new();
    for impact in &report.impacts {
        let carom::BodyPair::Collider { sphere, .. } = impact.between else { continue };
        first.entry(sphere).or_insert(*impact);
    }
    first.into_values().collect()
}

/// Exponent of the power of a length by which errors fall, by least squares.
fn order(errors: &[f64]) -> f64 {
    // Lengths are halved from one to the next.
    let logs: Vec<f64> = errors.iter().map(|it| -libm::log2(*it)).collect();
    let middle = 0.5 * (logs.len() - 1) as f64;
    let weights = || (0..logs.len()).map(|it| it as f64 - middle);
    let slope: f64 = weights().zip(&logs).map(|(weight, log)| weight * log).sum();
    slope / weights().map(|it| it * it).sum::<f64>()
}

#[test]
fn contacts_converge_with_the_square_of_the_edges_and_bounces_with_their_length() {
    let exact = impacts(Shape::Sphere { radius: 1.0 });
    assert_eq!(exact.len(), SHOTS);
    let (mut places, mut directions) = (Vec::new(), Vec::new());
    // 320 to 20,480 triangles.
    for cuts in 2..=5 {
        let found = impacts(Shape::Mesh(icosphere(cuts)));
        assert_eq!(found.len(), SHOTS);
        let mean = |of: &dyn Fn(&Impact, &Impact) -> f64| {
            let errors = exact.iter().zip(&found).map(|(one, other)| of(one, other));
            let squares = errors.map(|error| error * error);
            (squares.sum::<f64>() / SHOTS as f64).sqrt()
        };
        // At a speed of 1 m/s, times are ways.
        places.push(mean(&|one, other| one.time - other.time));
        directions.push(mean(&|one, other| one.normal.distance(other.normal)));
    }
    let orders = [&places, &directions].map(|it| order(it));
    // Rays that graze see more of the facets, and differ from level to level by a few per cent.
    assert!((1.9..2.2).contains(&orders[0]), "{orders:?} {places:?}");
    assert!((0.97..1.1).contains(&orders[1]), "{orders:?} {directions:?}");
}
