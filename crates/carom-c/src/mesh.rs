//! Colliders of triangles and of heights, from arrays.

use carom::{DVec3, Mesh, MeshError, Shape};
use carom_scene::scene;

use crate::collider::{CaromCollider, add};
use crate::pointer::{Plain, Rows, Strided, read, tell};
use crate::status::{CaromStatus, Failure, call};
use crate::world::CaromWorld;

/// A surface of triangles, in the coordinates of its collider.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CaromMesh {
    /// Vertices [m]: three numbers each, without gaps in memory.
    pub vertices: *const f64,
    /// Number of vertices.
    pub vertex_count: usize,
    /// Triangles: the indices of three vertices each, counter-clockwise as seen from the front,
    /// without gaps in memory.
    pub triangles: *const u32,
    /// Number of triangles.
    pub triangle_count: usize,
    /// 1 if spheres pass an open mesh from behind, 0 if both sides deflect them. A closed mesh is
    /// always met from its front.
    pub one_sided: u32,
    /// Must be 0.
    pub reserved: u32,
}

// SAFETY: a structure of numbers and addresses.
unsafe impl Plain for CaromMesh {}

impl CaromMesh {
    /// Reads the arrays.
    ///
    /// # Safety
    /// Each pointer is null, or leads to its number of rows.
    unsafe fn described(&self) -> Result<scene::Mesh, Failure> {
        if self.one_sided > 1 || self.reserved != 0 {
            let problem = "`one_sided` must be 0 or 1, and `reserved` 0";
            return Err(Failure::new(CaromStatus::Invalid, problem));
        }
        let array = |count| Strided { stride: 0, count };
        // SAFETY: the caller promises this many vertices.
        let vertices =
            unsafe { Rows::new(self.vertices, array(self.vertex_count), 3, "vertices") }?;
        let triangles = array(self.triangle_count);
        // SAFETY: the caller promises this many triangles.
        let triangles = unsafe { Rows::new(self.triangles, triangles, 3, "triangles") }?;
        let vertices = (0..vertices.count()).map(|row| vertices.row(row)).collect();
        let triangles = (0..triangles.count()).map(|row| triangles.row(row)).collect();
        let mut mesh = scene::Mesh::listed(vertices, triangles);
        mesh.one_sided = self.one_sided == 1;
        Ok(mesh)
    }
}

/// Adds a collider of triangles. The `shape` of `collider` must be CAROM_SHAPE_OTHER. Writes its id to
/// `id`, which may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_add_mesh(
    world: CaromWorld,
    collider: *const CaromCollider,
    mesh: *const CaromMesh,
    id: *mut u64,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let collider = unsafe { read(collider, "collider") }?;
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mesh = unsafe { read(mesh, "mesh") }?;
        // SAFETY: the caller's arrays are null or have these rows, as the header demands.
        let described = unsafe { mesh.described() }?;
        let vertices = described.vertices.iter().copied().map(DVec3::from_array).collect();
        let surface = Mesh::new(vertices, described.triangles.clone()).map_err(invalid)?;
        let surface = if described.one_sided { surface.one_sided() } else { surface };
        let collider = collider.of_shape(Shape::Mesh(surface))?;
        let number = add(world, collider, scene::Shape::Mesh(described))?;
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        unsafe { tell(id, number) };
        Ok(())
    })
}

/// Adds ground over a rectangle of size[0] by size[2] of `collider` in the local xz plane about its
/// origin; spheres pass it from below. Heights [m] are `rows` of `columns` numbers along x, without
/// gaps in memory, the first row at the lowest z. Each cell is split from its corner at the lowest x
/// and z to the opposite corner. The `shape` of `collider` must be CAROM_SHAPE_OTHER. Writes its id
/// to `id`, which may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_add_height_field(
    world: CaromWorld,
    collider: *const CaromCollider,
    heights: *const f64,
    rows: usize,
    columns: usize,
    id: *mut u64,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let collider = unsafe { read(collider, "collider") }?;
        let too_many = || Failure::new(CaromStatus::Length, "heights: more than memory holds");
        let count = rows.checked_mul(columns).ok_or_else(too_many)?;
        let array = Strided { stride: 0, count };
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let heights = unsafe { Rows::new(heights, array, 1, "heights") }?;
        let heights: Vec<f64> = heights.values().collect();
        let heights: Vec<_> = heights.chunks(columns.max(1)).map(<[f64]>::to_vec).collect();
        let size = [collider.size[0], collider.size[2]];
        let surface = Mesh::from_heights(size, &heights).map_err(invalid)?;
        let collider = collider.of_shape(Shape::Mesh(surface))?;
        let described = scene::HeightField::new(size, heights);
        let number = add(world, collider, scene::Shape::HeightField(described))?;
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        unsafe { tell(id, number) };
        Ok(())
    })
}

fn invalid(error: MeshError) -> Failure {
    Failure::new(CaromStatus::Invalid, error.to_string())
}
