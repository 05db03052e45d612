//! The first contact with a feature of a mesh while nothing of the mesh is nearer.
//!
//! A sphere that comes to a mesh from outside meets what is nearest first. One that begins in an overlap is already
//! within a radius of a feature when that becomes the nearest: that is where they meet. One that comes from behind an
//! open mesh passes the feature there, until they are apart.

use glam::DVec3;

use super::obstacle::Obstacle;
use super::path::{Path, State};
use super::roundoff::Magnitudes;
use super::search;
use crate::detect::passage;
use crate::mesh::Edge;
use crate::norm::Norm;
use crate::surface::Form;

/// Steps towards the places nearest to a feature, at most. Each step takes a fixed part of what is left of the way;
/// only a path along a border needs more, which comes to lie beyond it by no more than rounding.
const MOST_STEPS: u32 = 4096;

/// Passages of a feature in one flight, at most: a sphere that turns back in an open mesh passes once or twice.
const MOST_PASSAGES: usize = 64;

/// A face, an edge or a corner of a mesh, for spheres of this radius.
#[derive(Debug, Clone, Copy)]
pub(super) struct Feature<'a> {
    pub form: &'a Form,
    /// Place from which paths count \[m\].
    pub origin: DVec3,
    /// Radius \[m\].
    pub radius: f64,
    /// Magnitudes of the numbers that define paths and feature.
    pub size: Magnitudes,
}

impl Feature<'_> {
    /// The time \[s\] up to a horizon of the first contact at which nothing of the mesh is nearer, from the
    /// `first` of all on, which is a contact with the whole plane, line or point. A sphere that is then as deep within
    /// an open mesh as only one from behind passes until they are apart.
    pub fn first_nearest(&self, path: &impl Path, first: f64, horizon: f64) -> Option<f64> {
        let mut met = self.nearest_from(path, first, horizon)?;
        if !(self.form.is_feature() && self.form.is_open()) {
            return Some(met);
        }
        let obstacle = self.obstacle()?;
        for _ in 0..MOST_PASSAGES {
            let grown = obstacle.widened(path.growth_speed() * met);
            let local = grown.local_distance(path.state_at(met).position, DVec3::ZERO);
            if !passage::is_deep(local.distance, grown.radius()) {
                return Some(met);
            }
            let later = Later { path, from: met };
            let left = horizon - met;
            let wait = search::first_contact_after_overlap(&later, &grown, self.size, left)?;
            met = self.nearest_from(path, met + wait, horizon)?;
        }
        None
    }

    /// The first contact at which nothing of the mesh is nearer, as deep as it may be.
    ///
    /// Between contacts where something else is nearer, the way to the places where nothing is gives a time in
    /// which the sphere cannot be there.
    fn nearest_from(&self, path: &impl Path, first: f64, horizon: f64) -> Option<f64> {
        let center = |t: f64| self.origin + path.state_at(t).position;
        if is_nearest(self.form, center(first)) {
            return Some(first);
        }
        let obstacle = self.obstacle()?;
        let mut t = first;
        for _ in 0..MOST_STEPS {
            let step = least_time(path, self.beside(center(t)), t, horizon);
            let from = (t + step).max(t.next_up());
            if !(from <= horizon && from.is_finite()) {
                return None;
            }
            let later = Later { path, from };
            let grown = obstacle.widened(path.growth_speed() * from);
            let wait = search::first_contact(&later, &grown, self.size, horizon - from)?;
            t = from + wait;
            if wait > 0.0 && is_nearest(self.form, center(t)) {
                return Some(t);
            }
            // The border itself: how far rounding blurs it depends on where the origin is.
            if wait == 0.0 && self.beside(center(t)) == 0.0 {
                // What touches by rounding alone touched what was nearest before.
                return self.is_deep(&grown, &path.state_at(t)).then_some(t);
            }
        }
        None
    }

    /// The whole plane, line or point.
    pub fn obstacle(&self) -> Option<Obstacle> {
        let Self { origin, radius, .. } = *self;
        match self.form {
            Form::Facet(facet) => {
                let (point, normal) = (facet.frame.center - origin, facet.frame.normal);
                Some(Obstacle::Plane { point, normal, radius })
            }
            Form::Edge(edge) => Some(segment(edge, origin, radius)),
            Form::Corner(corner) => {
                Some(Obstacle::Segment { ends: [corner.point - origin; 2], radius })
            }
            _ => None,
        }
    }

    /// Returns a lower bound of the distance of a centre \[m\] from where the feature is the
    /// nearest.
    fn beside(&self, center: DVec3) -> f64 {
        match self.form {
            Form::Facet(facet) => facet.distance_beside(center),
            Form::Edge(edge) => edge.distance_beside(center),
            Form::Corner(corner) => corner.distance_beside(center),
            _ => 0.0,
        }
    }

    /// Whether it is overlapped by more than a search may leave unseen.
    fn is_deep(&self, obstacle: &Obstacle, state: &State) -> bool {
        let local = obstacle.local_distance(state.position, state.velocity);
        local.distance < -search::CLOSE * (self.size + state.size).length
    }
}

/// The time \[s\] that a centre takes for a way \[m\] from `t` \[s\] on, at least, or the time for which that is known.
fn least_time(path: &impl Path, way: f64, t: f64, horizon: f64) -> f64 {
    let known = path.window().min(horizon - t);
    let speed = path.state_at(t).velocity.norm();
    let pull = path.max_acceleration_anywhere(t, t + known).max(0.0);
    // The way is v τ + a τ²/2 at most.
    let time = 2.0 * way / (speed + (speed * speed + 2.0 * pull * way).sqrt());
    time.min(known)
}

/// A path from some time \[s\] on.
struct Later<'a, P> {
    path: &'a P,
    from: f64,
}

impl<P: Path> Path for Later<'_, P> {
    fn state_at(&self, t: f64) -> State {
        self.path.state_at(self.from + t)
    }

    fn max_acceleration(&self, direction: DVec3, from: f64, to: f64) -> f64 {
        self.path.max_acceleration(direction, self.from + from, self.from + to)
    }

    fn max_acceleration_anywhere(&self, from: f64, to: f64) -> f64 {
        self.path.max_acceleration_anywhere(self.from + from, self.from + to)
    }

    fn growth(&self, to: f64) -> f64 {
        self.path.growth(self.from + to)
    }

    fn decay_rate(&self) -> f64 {
        self.path.decay_rate()
    }

    fn window(&self) -> f64 {
        self.path.window()
    }

    fn growth_speed(&self) -> f64 {
        self.path.growth_speed()
    }
}

/// An edge for spheres of this radius \[m\], its place from an origin \[m\].
pub(super) fn segment(edge: &Edge, origin: DVec3, radius: f64) -> Obstacle {
    let (center, half) = (edge.center - origin, edge.half * edge.axis);
    Obstacle::Segment { ends: [center - half, center + half], radius }
}

/// Whether a feature is what of its mesh is nearest to a centre \[m\], but for rounding.
fn is_nearest(form: &Form, center: DVec3) -> bool {
    match form {
        Form::Facet(facet) => facet.is_under(center),
        Form::Edge(edge) => edge.is_nearest(center),
        Form::Corner(corner) => corner.is_nearest(center),
        _ => true,
    }
}
