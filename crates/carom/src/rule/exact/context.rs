//! The step context: what every part of the rule reads in a step, and the report it writes.

use glam::DVec3;

use super::contacts::contact_scale::ContactScale;
use super::pair_times::PairSearch;
use super::predict::moving::{self, Around};
use super::span::Span;
use super::timeline::Timeline;
use crate::detect::sphere_surface;
use crate::id::SphereId;
use crate::norm::Norm;
use crate::report::{Impact, ImpactGroup, StageCounts, StepReport};
use crate::restitution::Coefficient;
use crate::settings::{CombineRule, Exact, Zones};
use crate::surface::{Form, LastCarriage, SurfaceMotion};
use crate::system::System;
use crate::work::Work;

/// The world during one step, and the report of the step.
pub(super) struct StepContext<'a> {
    pub system: &'a System<'a>,
    pub parameters: Exact,
    pub report: &'a mut StepReport,
    /// The work of the stages.
    pub counts: StageCounts,
    /// The count of work and its bound.
    pub work: &'a Work<'a>,
    /// Start of the step, on the world's clock \[s\]: impacts count their time from there, and there
    /// surfaces are where the system says.
    pub start: f64,
    /// Length of the step \[s\].
    pub length: f64,
    /// Edges of the periodic box \[m\]; infinite along an open axis.
    pub period: DVec3,
    /// Flights that restarted at force ticks.
    pub renewed: u64,
    /// The slot of a sphere on which friction acts in a way that has no closed form, where nothing is
    /// stepped.
    pub unanswered: Option<u32>,
    /// Working memory: the neighbours of the spheres at work, and when they meet.
    pub searches: [PairSearch; 2],
    /// Motion since the start of the step of the collider that was asked for last.
    carriage: LastCarriage,
}

impl<'a> StepContext<'a> {
    pub fn new(
        system: &'a System<'a>,
        parameters: Exact,
        Span { start, length, .. }: Span,
        work: &'a Work<'a>,
        report: &'a mut StepReport,
    ) -> Self {
        let period = system.settings.boundary.period();
        let (searches, counts, renewed, unanswered, carriage) = Default::default();
        Self {
            system,
            parameters,
            report,
            counts,
            work,
            start,
            length,
            period,
            renewed,
            unanswered,
            searches,
            carriage,
        }
    }

    /// Whether spheres that take too much work are stepped in zones.
    pub fn has_zones(&self) -> bool {
        self.parameters.zones == Zones::Automatic
    }

    pub fn combine_rule(&self) -> CombineRule {
        self.system.settings.combine_rule
    }

    /// A time on the world's clock \[s\] as impacts report it, from the start of the step. A time that rounding
    /// puts before the start or beyond the end counts as the start or the end.
    pub fn since_start(&self, time: f64) -> f64 {
        (time - self.start).clamp(0.0, self.length)
    }

    pub fn id_of(&self, timeline: &Timeline, slot: u32) -> SphereId {
        self.system.spheres.id[timeline.flights.index_of[slot as usize] as usize]
    }

    /// Restitution of an impact of bodies with this relative velocity \[m/s\]. It is 0 where all spheres of the impact
    /// were hit less than a contact's duration ago, unless the impact is elastic. So the shorter and shorter flights of
    /// an inelastic collapse end (McNamara and Young, Phys. Fluids A 4, 496 (1992)). The TC model of Luding and
    /// McNamara, Granular Matter 1, 113 (1998), has the same condition and takes the restitution 1 there, which leaves
    /// wedged spheres bouncing without end.
    pub fn restitution_at<const N: usize>(
        &self,
        timeline: &Timeline,
        slots: [u32; N],
        velocity: DVec3,
        Coefficient { value, is_elastic }: Coefficient,
        time: f64,
    ) -> Coefficient {
        let bodies = slots.map(|slot| &timeline.flights.bodies[slot as usize]);
        if is_elastic || !bodies.iter().all(|body| body.is_struck()) {
            return Coefficient { value, is_elastic };
        }
        let scale = ContactScale::from_spheres(&timeline.flights, &slots, time);
        let resolved = scale.resolved_time(velocity.norm());
        let least = self.parameters.contact_duration;
        let duration = self.duration_of(&scale, time).min(resolved).max(least);
        let is_over = bodies.iter().any(|body| time - body.time >= duration);
        Coefficient { value: if is_over { value } else { 0.0 }, is_elastic }
    }

    /// How long a contact of this scale lasts \[s\], at `time` \[s\].
    pub fn duration_of(&self, scale: &ContactScale, time: f64) -> f64 {
        scale.duration(self.parameters.contact_duration, time)
    }

    /// Records impacts that were answered together.
    #[inline(always)]
    pub fn record(&mut self, impacts: impl IntoIterator<Item = Impact>, account: ImpactGroup) {
        let first = self.report.impacts.len();
        self.report.impacts.extend(impacts);
        let count = self.report.impacts.len() - first;
        let law = self.parameters.impact_law;
        self.report.groups.push(ImpactGroup { first, count, law, ..account });
    }

    /// Geometry and motion of a surface at `time` \[s\].
    pub fn surface_at(&self, surface: u32, time: f64) -> (Form, SurfaceMotion) {
        self.carriage.after(&self.system.surfaces[surface as usize], time - self.start)
    }

    /// Surfaces that a sphere may meet: those at rest of its neighbour region, and moving ones around a place. With
    /// each comes the shift \[m\] that brings it to where the sphere's position counts.
    pub fn surfaces_near<'t>(
        &self,
        timeline: &'t Timeline,
        slot: u32,
        around: Around,
    ) -> impl Iterator<Item = (u32, DVec3)> + use<'t> {
        let moving = if timeline.moving_surfaces.is_empty() {
            Vec::new()
        } else {
            moving::near(timeline, self.system, slot, around, &self.carriage)
        };
        timeline.surfaces_with(slot, moving)
    }

    /// Whether no surface is within `margin` \[m\] of a sphere at `place` \[m\] at `time` \[s\].
    pub fn touches_no_surface(
        &self,
        timeline: &Timeline,
        slot: u32,
        place: DVec3,
        margin: f64,
        time: f64,
    ) -> bool {
        let radius = timeline.flights.species_of(slot).radius;
        let around = Around::touching(place, radius, time).farther(margin);
        self.surfaces_near(timeline, slot, around).all(|(surface, shift)| {
            let (form, _) = self.surface_at(surface, time);
            let separation = sphere_surface(&form, place - shift, radius);
            separation.is_none_or(|separation| separation.distance > margin)
        })
    }
}
