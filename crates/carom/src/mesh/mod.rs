//! Triangle meshes, and the features that spheres meet.
//!
//! A mesh is welded (`weld`), its coplanar neighbours are merged into faces (`topology`), and their faces, edges
//! and corners are computed (`build`). Each of these counts only where it is the nearest part of the mesh (`facet`,
//! `edge`, `corner`), so a sphere meets nothing twice and no edge inside a flat floor.

mod build;
mod closed;
mod corner;
mod edge;
mod error;
mod facet;
mod faults;
mod heights;
mod interior;
mod outline;
mod place;
mod topology;
mod weld;

use std::sync::{Arc, OnceLock};

use glam::DVec3;

pub(crate) use build::Features;
pub(crate) use closed::ClosedMesh;
pub(crate) use corner::Corner;
pub(crate) use edge::Edge;
pub use error::MeshError;
pub(crate) use facet::Facet;
pub use faults::MeshFaults;
pub(crate) use interior::Depth;
pub(crate) use place::Placement;

use interior::Interior;
use topology::Topology;

/// A surface of triangles, for [`Shape::Mesh`](crate::Shape::Mesh). Clones share their memory.
///
/// Vertices within a billionth of the size of the mesh are merged, triangles with zero area are left out, and
/// neighbours in one plane, within 1e-9 rad, form one face: a floor of many triangles is as smooth as one
/// rectangle. The front of a triangle is the side from which its vertices go round counter-clockwise.
///
/// A mesh is closed if each edge belongs to two triangles with the same orientation. A closed mesh is met from the
/// front of its triangles only: a solid, or a room. Where its triangles face outward it encloses a volume, and a
/// sphere whose centre is inside overlaps it. An open mesh has no inside and is met from both sides, unless it is
/// [one-sided].
///
/// [one-sided]: Mesh::one_sided
///
/// ```
/// use carom::{Collider, DVec3, Mesh, Pose, Shape, Sphere, World};
///
/// let vertices = [[-1.0, 0.0, -1.0], [-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0]];
/// let floor = Mesh::new(vertices.map(DVec3::from_array).to_vec(), vec![[0, 1, 2], [0, 2, 3]])?;
/// let mut world = World::default();
/// world.add_collider(Collider::new(Shape::Mesh(floor), Pose::at(DVec3::ZERO)))?;
/// let falling = Sphere::new(DVec3::new(0.3, 1.0, 0.3), 0.1).with_velocity(DVec3::NEG_Y);
/// let id = world.add_sphere(falling)?;
/// world.step(1.5)?;
/// // After 0.9 s it is sent back.
/// assert!((world.sphere(id)?.position.y - 0.7).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Mesh(Arc<Given>);

/// What a mesh was made from, and quantities that are computed at first use.
#[derive(Debug)]
struct Given {
    vertices: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    is_one_sided: bool,
    bounds: [DVec3; 2],
    topology: Topology,
    features: OnceLock<Features>,
    interior: OnceLock<Interior>,
}

impl Mesh {
    /// Creates a mesh from vertices \[m\] in its own coordinates, and triangles of three indices of vertices each.
    ///
    /// # Errors
    /// [`MeshError`] if a coordinate is not finite, a triangle names a vertex that is not there, or no triangle
    /// has an area.
    pub fn new(vertices: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        Self::with_sides(vertices, triangles, false)
    }

    /// Creates a surface over a rectangle of the xz plane about the origin from `rows` of heights \[m\] along x,
    /// the first at the lowest z. Spheres meet it from above only.
    ///
    /// Each rectangle of four neighbouring heights is split from its corner at the lowest x and z to the opposite
    /// corner.
    ///
    /// - `size` along x and z \[m\], > 0
    ///
    /// # Errors
    /// [`MeshError`] if there are fewer than two rows or columns, rows differ in length, or a number is not
    /// finite or a size not positive.
    pub fn from_heights(size: [f64; 2], rows: &[Vec<f64>]) -> Result<Self, MeshError> {
        let (vertices, triangles) = heights::grid(size, rows)?;
        Self::with_sides(vertices, triangles, true)
    }

    /// Returns the same mesh, met only from the front of its triangles: spheres pass it from behind.
    #[must_use]
    pub fn one_sided(self) -> Self {
        if self.0.is_one_sided {
            return self;
        }
        let Given { vertices, triangles, bounds, topology, .. } = match Arc::try_unwrap(self.0) {
            Ok(own) => own,
            Err(shared) => Given {
                vertices: shared.vertices.clone(),
                triangles: shared.triangles.clone(),
                topology: shared.topology.clone(),
                features: OnceLock::new(),
                interior: OnceLock::new(),
                ..*shared
            },
        };
        Self::made_of(vertices, triangles, true, (bounds, topology))
    }

    fn with_sides(
        vertices: Vec<DVec3>,
        triangles: Vec<[u32; 3]>,
        is_one_sided: bool,
    ) -> Result<Self, MeshError> {
        error::check(&vertices, &triangles)?;
        let topology = Topology::of(&vertices, &triangles);
        if topology.triangles.is_empty() {
            return Err(MeshError::NoArea);
        }
        let first = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let bounds = vertices.iter().fold(first, |[min, max], &it| [min.min(it), max.max(it)]);
        Ok(Self::made_of(vertices, triangles, is_one_sided, (bounds, topology)))
    }

    fn made_of(
        vertices: Vec<DVec3>,
        triangles: Vec<[u32; 3]>,
        is_one_sided: bool,
        (bounds, topology): ([DVec3; 2], Topology),
    ) -> Self {
        Self(Arc::new(Given {
            vertices,
            triangles,
            is_one_sided,
            bounds,
            topology,
            features: OnceLock::new(),
            interior: OnceLock::new(),
        }))
    }

    /// Returns the vertices as given \[m\].
    pub fn vertices(&self) -> &[DVec3] {
        &self.0.vertices
    }

    /// Returns the triangles as given, by the indices of their vertices.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.0.triangles
    }

    /// Returns whether [`Self::one_sided`] made it one-sided.
    pub fn is_one_sided(&self) -> bool {
        self.0.is_one_sided
    }

    /// Returns whether the mesh is closed: each edge belongs to two triangles with the same orientation.
    pub fn is_closed(&self) -> bool {
        self.0.topology.is_closed
    }

    /// Returns the lowest and the highest coordinates of the vertices \[m\].
    pub fn bounds(&self) -> [DVec3; 2] {
        self.0.bounds
    }

    /// Returns probable mistakes, such as holes and triangles with zero area.
    pub fn faults(&self) -> MeshFaults {
        MeshFaults::of(&self.0.topology)
    }

    /// Returns the faces, edges and corners in the coordinates of the mesh.
    pub(crate) fn features(&self) -> &Features {
        let Given { topology, is_one_sided, features, .. } = &*self.0;
        features.get_or_init(|| Features::of(topology, *is_one_sided))
    }

    /// Returns the depth of a point \[m\] in the coordinates of the mesh; `None` outside, and for an open mesh.
    pub(crate) fn depth_at(&self, point: DVec3) -> Option<Depth> {
        let Given { topology, bounds: [min, max], interior, .. } = &*self.0;
        let may_be_inside = topology.is_closed && (point.cmpge(*min) & point.cmple(*max)).all();
        may_be_inside.then(|| interior.get_or_init(|| Interior::of(topology)).depth_at(point))?
    }
}

impl PartialEq for Mesh {
    fn eq(&self, other: &Self) -> bool {
        let is_same = |a: &Given, b: &Given| {
            a.is_one_sided == b.is_one_sided
                && a.triangles == b.triangles
                && a.vertices == b.vertices
        };
        Arc::ptr_eq(&self.0, &other.0) || is_same(&self.0, &other.0)
    }
}

/// Meshes in the form in which they are serialized.
#[cfg(feature = "serde")]
mod written {
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    use super::{DVec3, Mesh};

    #[derive(Serialize, Deserialize)]
    struct Written<V, T> {
        vertices: V,
        triangles: T,
        is_one_sided: bool,
    }

    impl Serialize for Mesh {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            let written = Written {
                vertices: self.vertices(),
                triangles: self.triangles(),
                is_one_sided: self.is_one_sided(),
            };
            written.serialize(serializer)
        }
    }

    impl<'de> Deserialize<'de> for Mesh {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            let written = Written::<Vec<DVec3>, Vec<[u32; 3]>>::deserialize(deserializer)?;
            Self::with_sides(written.vertices, written.triangles, written.is_one_sided)
                .map_err(D::Error::custom)
        }
    }
}
