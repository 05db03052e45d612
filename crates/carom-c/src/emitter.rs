//! Emitters, which texts describe.

use std::ffi::c_char;

use carom::{Emitter, EmitterId};
use carom_scene::part;

use crate::pointer::text;
use crate::status::{CaromStatus, Failure, call};
use crate::world::{CaromWorld, Inner};

/// Replaces an emitter, which keeps its id, by the one of a text in the format of scene files (TOML):
/// "emitters = [{ sphere = { radius = 0.1 }, period = 0.5 }]". With another period it starts again now.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_set_emitter(
    world: CaromWorld,
    id: u64,
    toml: *const c_char,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's text is null or ends in a zero, as the header demands.
        let toml = unsafe { text(toml, "toml") }?;
        world.with(|inner| {
            let place = place_of(inner, id)?;
            let part = part::read_for(toml, inner.described.scene())?;
            let described = part::only(&part.emitters)?;
            let emitters: Vec<Emitter> = part.world()?.emitters().map(|(_, it)| *it).collect();
            inner.world.set_emitter(EmitterId::from_number(id), *part::only(&emitters)?)?;
            let time = inner.world.time();
            inner.described.palette_mut().set_emitter(place, described, time);
            inner.described.scene_mut().emitters[place].clone_from(described);
            Ok(())
        })
    })
}

/// Removes an emitter; its spheres stay.
#[unsafe(no_mangle)]
pub extern "C" fn carom_world_remove_emitter(world: CaromWorld, id: u64) -> CaromStatus {
    call(|| {
        world.with(|inner| {
            let place = place_of(inner, id)?;
            inner.world.remove_emitter(EmitterId::from_number(id))?;
            let time = inner.world.time();
            inner.described.palette_mut().remove_emitter(place, time);
            inner.described.scene_mut().emitters.remove(place);
            Ok(())
        })
    })
}

/// Returns the position of an emitter in the order.
fn place_of(inner: &Inner, id: u64) -> Result<usize, Failure> {
    let place = inner.world.emitters().position(|(own, _)| own.number() == id);
    place.ok_or_else(|| Failure::unknown("emitter", id))
}
