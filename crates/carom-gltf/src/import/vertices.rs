//! Reads triangles of meshes from buffers.

use carom::DVec3;

use super::error::Malformed;
use super::file::File;
use crate::document::{Accessor, Primitive};

/// Corners of a triangle \[m\], in the mesh's coordinate system.
pub(super) type Triangle = [DVec3; 3];

/// Most triangles of one mesh.
const MOST: usize = 10_000_000;

/// Reads the triangles of a mesh.
///
/// # Errors
/// The inner error is the reason for the report; [`Malformed`] if the file is invalid.
pub(super) fn triangles(
    file: &File,
    mesh: usize,
) -> Result<Result<Vec<Triangle>, &'static str>, Malformed> {
    let place = format!("meshes[{mesh}]");
    let Some(mesh) = file.document.meshes.get(mesh) else {
        return Err(Malformed::at(place, "is not there"));
    };
    let mut all = Vec::new();
    for (i, primitive) in mesh.primitives.iter().enumerate() {
        let place = format!("{place}.primitives[{i}]");
        match of_primitive(file, primitive, &place)? {
            Ok(triangles) if all.len() + triangles.len() <= MOST => all.extend(triangles),
            Ok(_) => return Ok(Err("its mesh has more than 10,000,000 triangles")),
            Err(reason) => return Ok(Err(reason)),
        }
    }
    Ok(Ok(all))
}

fn of_primitive(
    file: &File,
    primitive: &Primitive,
    place: &str,
) -> Result<Result<Vec<Triangle>, &'static str>, Malformed> {
    if !(4..=6).contains(&primitive.mode) {
        return Ok(Err("its mesh has lines or points"));
    }
    let Some(position) = primitive.attributes.position else {
        return Ok(Err("its mesh has no vertices"));
    };
    let vertices = match elements::<3>(file, position, "VEC3")? {
        Ok(vertices) => vertices,
        Err(reason) => return Ok(Err(reason)),
    };
    let corners: Vec<DVec3> = match primitive.indices {
        None => vertices.all().map(DVec3::from_array).collect(),
        Some(accessor) => {
            let indices = match elements::<1>(file, accessor, "SCALAR")? {
                Ok(indices) => indices,
                Err(reason) => return Ok(Err(reason)),
            };
            // Many meshes may share vertices and use only some of them.
            let corner = |[index]: [f64; 1]| vertices.get(index as usize).map(DVec3::from_array);
            let corners: Option<Vec<DVec3>> = indices.all().map(corner).collect();
            corners.ok_or_else(|| Malformed::at(place, "an index is beyond its vertices"))?
        }
    };
    if !corners.iter().all(|it| it.is_finite()) {
        return Err(Malformed::at(place, "a vertex is no finite number"));
    }
    Ok(Ok(assembled(&corners, primitive.mode)))
}

/// Converts corners of a list, strip or fan to triangles.
fn assembled(corners: &[DVec3], mode: u32) -> Vec<Triangle> {
    let triple = |a: usize, b: usize, c: usize| [corners[a], corners[b], corners[c]];
    let after = corners.len().saturating_sub(2);
    match mode {
        4 => corners.chunks_exact(3).map(|it| [it[0], it[1], it[2]]).collect(),
        5 => (0..after).map(|i| triple(i, i + 1 + i % 2, i + 2 - i % 2)).collect(),
        _ => (0..after).map(|i| triple(i + 1, i + 2, 0)).collect(),
    }
}

/// Elements of an accessor with `WIDTH` numbers each, decoded on access.
struct Elements<'a, const WIDTH: usize> {
    bytes: &'a [u8],
    count: usize,
    /// Distance from one element to the next \[bytes\].
    stride: usize,
    component: Component,
}

impl<const WIDTH: usize> Elements<'_, WIDTH> {
    /// Returns an element, or `None` beyond the last one.
    fn get(&self, index: usize) -> Option<[f64; WIDTH]> {
        if index >= self.count {
            return None;
        }
        let Component { size, read } = self.component;
        let element = &self.bytes[index * self.stride..];
        Some(std::array::from_fn(|i| read(&element[i * size..(i + 1) * size])))
    }

    /// Returns every element, in order.
    fn all(&self) -> impl Iterator<Item = [f64; WIDTH]> {
        (0..self.count).filter_map(|index| self.get(index))
    }
}

/// Finds the elements of an accessor.
fn elements<'a, const WIDTH: usize>(
    file: &'a File,
    index: usize,
    kind: &str,
) -> Result<Result<Elements<'a, WIDTH>, &'static str>, Malformed> {
    let place = format!("accessors[{index}]");
    let at = |problem: &str| Malformed::at(place.clone(), problem);
    let accessor = file.document.accessors.get(index).ok_or_else(|| at("is not there"))?;
    if accessor.kind != kind {
        return Err(at(&format!("is no {kind}")));
    }
    if accessor.sparse.is_some() {
        return Ok(Err("its mesh has sparse accessors"));
    }
    let Some(view_index) = accessor.buffer_view else {
        return Ok(Err("its mesh has no vertices"));
    };
    let view = file.document.buffer_views.get(view_index);
    let view = view.ok_or_else(|| at("its bufferView is not there"))?;
    let component = component(accessor).ok_or_else(|| at("has an unknown componentType"))?;
    let size = WIDTH * component.size;
    let stride = view.byte_stride.map_or(Some(size), |it| usize::try_from(it).ok());
    let stride = stride.filter(|it| *it >= size);
    let stride = stride.ok_or_else(|| at("its byteStride is too small"))?;
    let whole = file.buffer(view.buffer)?;
    let part = |bytes: &'_ [u8], offset: u64, len: Option<u64>| -> Option<std::ops::Range<usize>> {
        let start = usize::try_from(offset).ok()?;
        let end = match len {
            Some(len) => start.checked_add(usize::try_from(len).ok()?)?,
            None => bytes.len(),
        };
        (start <= end && end <= bytes.len()).then_some(start..end)
    };
    let bytes = part(whole, view.byte_offset, Some(view.byte_length));
    let bytes = bytes.ok_or_else(|| at("its bufferView is beyond its buffer"))?;
    let bytes = &whole[bytes];
    let bytes = &bytes
        [part(bytes, accessor.byte_offset, None).ok_or_else(|| at("is beyond its bufferView"))?];
    let count = usize::try_from(accessor.count).ok();
    let fits = |count: usize| match count {
        0 => Some(0),
        _ => (count - 1).checked_mul(stride)?.checked_add(size).filter(|it| *it <= bytes.len()),
    };
    let count = count.filter(|&it| fits(it).is_some());
    let count = count.ok_or_else(|| at("is beyond its bufferView"))?;
    if !file.take_numbers(count * WIDTH) {
        return Ok(Err("the meshes of the file have more than 100,000,000 numbers"));
    }
    Ok(Ok(Elements { bytes, count, stride, component }))
}

/// Format of a number in a buffer.
struct Component {
    /// Length \[bytes\].
    size: usize,
    read: fn(&[u8]) -> f64,
}

fn component(accessor: &Accessor) -> Option<Component> {
    fn bytes<const N: usize>(bytes: &[u8]) -> [u8; N] {
        bytes.try_into().unwrap_or([0; N])
    }
    let byte = |it: &[u8]| f64::from(i8::from_le_bytes(bytes(it)));
    let short = |it: &[u8]| f64::from(i16::from_le_bytes(bytes(it)));
    let of = |size, read| Some(Component { size, read });
    match (accessor.component_type, accessor.normalized) {
        (5120, false) => of(1, byte),
        (5121, false) => of(1, |it| f64::from(it[0])),
        (5122, false) => of(2, short),
        (5123, false) => of(2, |it| f64::from(u16::from_le_bytes(bytes(it)))),
        (5125, false) => of(4, |it| f64::from(u32::from_le_bytes(bytes(it)))),
        (5126, false) => of(4, |it| f64::from(f32::from_le_bytes(bytes(it)))),
        // Normalized integers of KHR_mesh_quantization.
        (5120, true) => of(1, |it| (f64::from(i8::from_le_bytes(bytes(it))) / 127.0).max(-1.0)),
        (5121, true) => of(1, |it| f64::from(it[0]) / 255.0),
        (5122, true) => of(2, |it| (f64::from(i16::from_le_bytes(bytes(it))) / 32767.0).max(-1.0)),
        (5123, true) => of(2, |it| f64::from(u16::from_le_bytes(bytes(it))) / 65535.0),
        _ => None,
    }
}
