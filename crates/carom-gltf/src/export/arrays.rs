//! Arrays in the binary part of a file.

use crate::document::{Accessor, BufferView, FLOAT, UNSIGNED_SHORT};

/// Target of views with vertices.
const ARRAY_BUFFER: u32 = 34_962;
/// Target of views with indices of vertices.
const ELEMENT_ARRAY_BUFFER: u32 = 34_963;

/// The binary part of a file without the keys of tracks, which come last.
#[derive(Debug, Default)]
pub(super) struct Arrays {
    pub bytes: Vec<u8>,
    pub views: Vec<BufferView>,
    pub accessors: Vec<Accessor>,
}

impl Arrays {
    /// Adds positions or normals of vertices; returns their accessor.
    pub fn push_vertices(&mut self, vertices: &[[f32; 3]]) -> usize {
        let view = self.push_view(vertices.as_flattened().iter().flat_map(|it| it.to_le_bytes()));
        self.views[view].target = Some(ARRAY_BUFFER);
        let extreme = |choose: fn(f32, f32) -> f32| -> Vec<f64> {
            let first = vertices.first().copied().unwrap_or_default();
            let all =
                vertices.iter().fold(first, |all, it| [0, 1, 2].map(|i| choose(all[i], it[i])));
            all.map(f64::from).to_vec()
        };
        let (min, max) = (extreme(f32::min), extreme(f32::max));
        self.push(Accessor { min, max, ..accessor(view, "VEC3", vertices.len()) })
    }

    /// Adds indices of vertices; returns their accessor.
    pub fn push_indices(&mut self, indices: &[u16]) -> usize {
        let view = self.push_view(indices.iter().flat_map(|it| it.to_le_bytes()));
        self.views[view].target = Some(ELEMENT_ARRAY_BUFFER);
        let component_type = UNSIGNED_SHORT;
        self.push(Accessor { component_type, ..accessor(view, "SCALAR", indices.len()) })
    }

    /// Adds times \[s\], ascending; returns their accessor.
    pub fn push_times(&mut self, times: &[f32]) -> usize {
        let view = self.push_times_view(times);
        self.push_times_in(view, 0, times)
    }

    /// Adds times \[s\], ascending; returns their view.
    pub fn push_times_view(&mut self, times: &[f32]) -> usize {
        self.push_view(times.iter().flat_map(|it| it.to_le_bytes()))
    }

    /// Adds an accessor to the times of a view from index `start` on.
    pub fn push_times_in(&mut self, view: usize, start: usize, times: &[f32]) -> usize {
        let end = |time: Option<&f32>| time.map(|it| f64::from(*it)).into_iter().collect();
        let (min, max, byte_offset) = (end(times.first()), end(times.last()), 4 * start as u64);
        self.push(Accessor { min, max, byte_offset, ..accessor(view, "SCALAR", times.len()) })
    }

    /// Adds scales; returns their accessor.
    pub fn push_scales(&mut self, scales: &[[f32; 3]]) -> usize {
        let view = self.push_view(scales.as_flattened().iter().flat_map(|it| it.to_le_bytes()));
        self.push(accessor(view, "VEC3", scales.len()))
    }

    /// Adds an accessor to keys that start `byte_offset` bytes after the start of a view.
    pub fn push_keys_in(
        &mut self,
        view: usize,
        byte_offset: u64,
        kind: &str,
        count: usize,
    ) -> usize {
        self.push(Accessor { byte_offset, ..accessor(view, kind, count) })
    }

    /// Adds a view of bytes that follow all bytes in this list.
    pub fn push_later(&mut self, byte_length: u64) -> usize {
        self.views.push(view(self.bytes.len() as u64, byte_length));
        self.views.len() - 1
    }

    fn push_view(&mut self, bytes: impl Iterator<Item = u8>) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        self.views.push(view(start as u64, (self.bytes.len() - start) as u64));
        // Numbers of 32 bits are aligned to 4 bytes.
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.len() - 1
    }

    fn push(&mut self, accessor: Accessor) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }
}

fn view(byte_offset: u64, byte_length: u64) -> BufferView {
    BufferView { buffer: 0, byte_offset, byte_length, byte_stride: None, target: None }
}

fn accessor(view: usize, kind: &str, count: usize) -> Accessor {
    Accessor {
        buffer_view: Some(view),
        byte_offset: 0,
        component_type: FLOAT,
        normalized: false,
        count: count as u64,
        kind: kind.to_owned(),
        min: Vec::new(),
        max: Vec::new(),
        sparse: None,
    }
}
