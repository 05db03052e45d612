//! Texts and bytes that are none of what a function reads.

use std::ffi::c_char;
use std::ptr::{null, null_mut};

use carom_c::*;
use rand_core::Rng;

use crate::{ARGUMENT, Bench, SCENE};

pub fn no_text(bench: &mut Bench) -> (CaromStatus, &'static [CaromStatus]) {
    let (text, mut made) = (c"name = \"\xff\"".as_ptr(), CaromWorld::default());
    let function = bench.below(5);
    // SAFETY: texts that end in a zero.
    let status = unsafe {
        match function {
            0 => carom_world_from_toml(text, null(), 0, &raw mut made),
            1 => carom_world_from_scene(text, null(), 0, &raw mut made),
            2 => carom_world_from_scene(c"cradle".as_ptr(), &raw const text, 1, &raw mut made),
            3 => carom_world_set_material_pairs(bench.world, text),
            _ => carom_world_set_simulation(bench.world, text),
        }
    };
    (status, ARGUMENT)
}

pub fn no_scene(bench: &mut Bench) -> (CaromStatus, &'static [CaromStatus]) {
    let texts: [*const c_char; 4] = [
        c"name = ".as_ptr(),
        c"spheres = [{ radius = nan }]".as_ptr(),
        c"colliders = [{ shape = \"cube\" }]".as_ptr(),
        c"simulation = { frame_time = -1 }".as_ptr(),
    ];
    let (text, mut made, function) = (bench.pick(&texts), CaromWorld::default(), bench.below(3));
    let bad = c"simulation.rule".as_ptr();
    // SAFETY: texts that end in a zero.
    let status = unsafe {
        match function {
            0 => carom_world_from_toml(text, null(), 0, &raw mut made),
            1 => carom_world_add_toml(bench.world, text, null_mut()),
            _ => carom_world_from_scene(c"cradle".as_ptr(), &raw const bad, 1, &raw mut made),
        }
    };
    (status, SCENE)
}

pub fn no_bytes(bench: &mut Bench) -> (CaromStatus, &'static [CaromStatus]) {
    let mut bytes = vec![0; bench.below(200) as usize + 1];
    bench.random.fill_bytes(&mut bytes);
    if bench.below(2) == 0 {
        bytes.splice(0..0, *b"carom\x1a\r\n");
    }
    let mut snapshot = CaromSnapshot::default();
    // SAFETY: as many bytes as stated, and a place for a snapshot.
    let status =
        unsafe { carom_snapshot_from_bytes(bytes.as_ptr(), bytes.len(), &raw mut snapshot) };
    (status, &[CaromStatus::Snapshot])
}
