//! Which spheres pass surfaces from behind now.

use crate::detect::Separation;
use crate::detect::contact::Bodies;
use crate::detect::instant::Instant;
use crate::rule::contact;
use crate::settings::Rule;
use crate::state::State;

/// Passages under the rules `exact` and `contact`, which let no sphere sink in from the front. The other rules have
/// none: each overlap counts.
pub(super) struct Passages<'a> {
    now: Instant<'a>,
    /// Passages of spheres that are moved by sub-steps: sphere and surface, ascending.
    of_stepped: Vec<(u32, u32)>,
    /// The spheres in zones, ascending.
    in_zones: Vec<u32>,
}

impl<'a> Passages<'a> {
    pub fn of(state: &'a State) -> Self {
        let now = state.now();
        let ids = &now.system.spheres.id;
        let zone = state.timeline.as_ref().map(|timeline| &timeline.zone);
        let mut in_zones = zone.map(|zone| zone.indices(ids)).unwrap_or_default();
        in_zones.sort_unstable();
        let solver = match state.settings.rule {
            Rule::Contact(_) => Some(&state.solver),
            _ => zone.map(|zone| zone.solver()),
        };
        let index_of = |(id, surface)| Some((ids.binary_search(&id).ok()? as u32, surface));
        let passages = solver.map(contact::passages).unwrap_or_default();
        let mut of_stepped: Vec<(u32, u32)> = passages.into_iter().filter_map(index_of).collect();
        of_stepped.sort_unstable();
        Self { now, of_stepped, in_zones }
    }

    /// Whether the sphere of an overlap passes the surface.
    pub fn has(&self, bodies: Bodies, separation: &Separation) -> bool {
        let Bodies::Surface { sphere, surface } = bodies else { return false };
        let is_stepped = match self.now.system.settings.rule {
            Rule::Exact(_) => self.in_zones.binary_search(&sphere).is_ok(),
            Rule::Contact(_) => true,
            Rule::Discrete(_) | Rule::Bisect(_) => return false,
        };
        let passes = match is_stepped {
            true => self.of_stepped.binary_search(&(sphere, surface)).is_ok(),
            false => self.now.came_from_behind(bodies, separation),
        };
        passes || self.now.leaves_open_mesh(bodies, separation)
    }
}
