//! Summary of a run.

use std::io::{self, Write};
use std::time::{Duration, Instant};

use carom::{BodyPair, ColliderId, DVec3, EnergyAccount, StageCounts, World};
use carom_scene::scene::{ImpactLaw, Integrator, Rule, WindBack};
use carom_session::Replay;
use serde::Serialize;

use crate::advice::{Conduct, advice, unread};
use crate::breach::{Course, breaches};
use crate::contact_totals::ContactTotals;
use crate::energy_balance::{Energies, EnergyBalance, rest_of};
use crate::escapes::Escapes;
use crate::failure::Failure;
use crate::stage_work::StageWork;
use crate::stress::{MeanStress, StressGauge};
use crate::well_totals::WellTotals;
use crate::written::written;
use crate::zone_totals::ZoneTotals;

/// Largest number of spheres for which overlaps are searched after each frame. With more, and if
/// the rule prevents overlaps, they are searched every `FRAMES_PER_LOOK` frames and at the end: the
/// search can take longer than a frame.
const FEW: usize = 100;
const FRAMES_PER_LOOK: u64 = 16;

/// Overlap, as a fraction of the smallest radius, above which a ball was emitted into another one;
/// rounding errors are much smaller.
const INTO_ANOTHER: f64 = 1e-3;

/// Collects the figures of a run.
pub struct Observer {
    began: Instant,
    stepping: Duration,
    energies_at_start: Energies,
    momentum_at_start: DVec3,
    frames: u64,
    impacts: u64,
    wells: WellTotals,
    trigger_contacts: u64,
    emitted: u64,
    retired: u64,
    left_out: u64,
    unfinished_islands: u64,
    work: StageCounts,
    largest_overlap: f64,
    /// Largest overlap as a fraction of the smallest radius at that time.
    largest_relative_overlap: f64,
    /// Largest errors of a group of impacts, under rules that keep a ledger.
    largest_momentum_error: f64,
    largest_energy_error: f64,
    energy: EnergyAccount,
    /// Totals of the rule `contact` and of zones.
    contact: ContactTotals,
    zones: ZoneTotals,
    /// Whether a ball was emitted into another one.
    emitted_into_another: bool,
    escapes: Escapes,
    stress: Option<StressGauge>,
}

impl Observer {
    pub fn new(world: &World) -> Self {
        let mut escapes = Escapes::default();
        escapes.look(world);
        Self {
            began: Instant::now(),
            stepping: Duration::ZERO,
            energies_at_start: Energies::of(world),
            momentum_at_start: world.momentum(),
            frames: 0,
            impacts: 0,
            wells: WellTotals::default(),
            trigger_contacts: 0,
            emitted: 0,
            retired: 0,
            left_out: 0,
            unfinished_islands: 0,
            work: StageCounts::default(),
            largest_overlap: 0.0,
            largest_relative_overlap: 0.0,
            largest_momentum_error: 0.0,
            largest_energy_error: 0.0,
            energy: EnergyAccount::default(),
            contact: ContactTotals::default(),
            zones: ZoneTotals::default(),
            emitted_into_another: false,
            escapes,
            stress: None,
        }
    }

    /// Has the stress measured from here on, in a volume \[m³\] or that of the box around the spheres.
    pub fn measure_stress(&mut self, world: &World, volume: Option<f64>) -> Result<(), Failure> {
        self.stress = Some(StressGauge::new(world, volume)?);
        Ok(())
    }

    /// Steps a frame by a function and collects its figures.
    pub fn step(
        &mut self,
        replay: &mut Replay,
        step: impl FnOnce(&mut Replay) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let began = Instant::now();
        step(replay)?;
        self.stepping += began.elapsed();
        let (world, report) = (replay.world(), replay.world().report());
        self.frames += 1;
        self.impacts += report.impacts.len() as u64;
        self.wells.add(&report.well_events);
        self.trigger_contacts += report.triggers.len() as u64;
        self.emitted += report.emitted.len() as u64;
        self.retired += report.retired.len() as u64;
        self.left_out += report.left_out.len() as u64;
        self.unfinished_islands += u64::from(report.unfinished_islands);
        self.work += report.work;
        self.energy += report.energy_account;
        self.contact.add(report);
        self.zones.add(report);
        if let Some(stress) = &mut self.stress {
            stress.add_frame(world);
        }
        for group in &report.groups {
            self.largest_momentum_error = self.largest_momentum_error.max(group.momentum_error());
            self.largest_energy_error = self.largest_energy_error.max(group.energy_error());
        }
        let prevents_overlaps = matches!(replay.simulation().rule, Rule::Exact | Rule::Contact);
        let is_seldom = prevents_overlaps && world.spheres().len() > FEW;
        if !is_seldom || self.frames.is_multiple_of(FRAMES_PER_LOOK) {
            self.look_at_places(world);
        }
        Ok(())
    }

    /// Searches for overlaps, and for balls that left closed containers.
    fn look_at_places(&mut self, world: &World) {
        self.escapes.look(world);
        let overlaps = world.overlaps(0.0);
        if overlaps.is_empty() {
            return;
        }
        let deepest = overlaps.iter().map(|overlap| overlap.depth).fold(0.0, f64::max);
        let smallest = world.spheres().radii().iter().copied().fold(f64::INFINITY, f64::min);
        let is_new = |id| world.report().emitted.binary_search(id).is_ok();
        self.emitted_into_another |= overlaps.iter().any(|overlap| match &overlap.between {
            BodyPair::Spheres(first, second) => {
                overlap.depth > INTO_ANOTHER * smallest && (is_new(first) || is_new(second))
            }
            BodyPair::Collider { .. } => false,
        });
        self.largest_overlap = self.largest_overlap.max(deepest);
        self.largest_relative_overlap = self.largest_relative_overlap.max(deepest / smallest);
    }
}

/// Figures of a run.
#[derive(Debug, Serialize)]
pub struct Summary {
    scene: String,
    rule: Rule,
    /// Only for the rule `bisect`.
    wind_back: Option<WindBack>,
    /// Only for the rules that use one.
    integrator: Option<Integrator>,
    /// Only for the rule `exact`.
    impact_law: Option<ImpactLaw>,
    /// Only for the rule `contact`: sub-steps per frame, and sweeps per sub-step.
    sub_steps: Option<u32>,
    sweeps: Option<u32>,
    frame_time: f64,
    frames: u64,
    /// Number of edits during the run, from a link.
    edits: usize,
    simulated_time: f64,
    spheres: usize,
    emitted: u64,
    retired: u64,
    /// Number of spheres that emitters left out because they would have overlapped others.
    left_out: u64,
    impacts: u64,
    /// Only with square wells.
    #[serde(skip_serializing_if = "Option::is_none")]
    wells: Option<WellTotals>,
    /// Number of spheres in triggers, summed over frames.
    trigger_contacts: u64,
    unfinished_islands: u64,
    /// Totals over all frames.
    work: StageWork<u64>,
    energy_at_start: f64,
    energy_at_end: f64,
    energy_balance: EnergyBalance,
    momentum_at_start: [f64; 3],
    momentum_at_end: [f64; 3],
    /// Largest overlap at the end of a frame.
    largest_overlap: f64,
    /// Largest error of momentum of a group of impacts, relative to the momenta involved; only for
    /// the rule `exact`.
    largest_momentum_error: Option<f64>,
    /// Largest deviation of the energy of a group of impacts from what restitution requires,
    /// relative to the energy involved; only for the rule `exact`.
    largest_energy_error: Option<f64>,
    /// Only for the rule `contact`, and if `exact` had stepped zones.
    contact: Option<ContactTotals>,
    /// Only if `exact` had stepped zones.
    zones: Option<ZoneTotals>,
    /// Only with `--stress`, and after at least one frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    stress: Option<MeanStress>,
    wall_time: f64,
    stepping_time: f64,
    state_hash: String,
    /// Parts of the scene that its rule ignores.
    unread: Option<String>,
    /// Advice on rule or settings.
    advice: Option<String>,
    /// Violated guarantees of the rule.
    broken: Vec<String>,
}

impl Course {
    fn of(replay: &Replay, observer: &Observer) -> Self {
        Self {
            rule: replay.simulation().rule,
            overlap: observer.largest_relative_overlap,
            may_overlap: replay.simulation().allow_overlap || observer.zones.are_any(),
            momentum_error: observer.largest_momentum_error,
            energy_error: observer.largest_energy_error,
            unfinished_islands: observer.unfinished_islands,
            squeezed: if replay.simulation().allow_overlap { 0 } else { observer.contact.squeezed },
        }
    }
}

impl Conduct {
    fn of(replay: &Replay, observer: &Observer) -> Self {
        let world = replay.world();
        let (spheres, radii) = (world.spheres().len().max(1) as f64, world.spheres().radii());
        let radius = radii.iter().sum::<f64>() / spheres;
        Self {
            rule: replay.simulation().rule,
            has_spheres: !world.spheres().is_empty()
                || observer.retired > 0
                || world.emitters().len() > 0,
            has_forces: !replay.scene().forces.is_empty(),
            overlap: if radius > 0.0 { observer.largest_overlap / radius } else { 0.0 },
            impact_rate: observer.impacts as f64 / (spheres * world.time().max(f64::MIN_POSITIVE)),
            emitted_into_another: observer.emitted_into_another,
        }
    }
}

impl Summary {
    pub fn new(replay: &Replay, mut observer: Observer) -> Self {
        let (world, simulation) = (replay.world(), replay.simulation());
        observer.look_at_places(world);
        let is_bisect = simulation.rule == Rule::Bisect;
        let is_exact = simulation.rule == Rule::Exact;
        let is_contact = simulation.rule == Rule::Contact;
        let energies = [observer.energies_at_start, Energies::of(world)];
        let advice = advice(Conduct::of(replay, &observer));
        let mut broken = breaches(Course::of(replay, &observer));
        let name_of = |id: ColliderId| match replay.scene().colliders.get(id.number() as usize) {
            Some(collider) if !collider.name.is_empty() => collider.name.clone(),
            _ => id.to_string(),
        };
        // Edits may move balls anywhere.
        let has_edits = replay.edits() > 0;
        broken.extend(observer.escapes.breach(name_of).filter(|_| !has_edits));
        Self {
            scene: replay.scene().name.clone(),
            rule: simulation.rule,
            wind_back: is_bisect.then_some(simulation.bisect.wind_back),
            integrator: match simulation.rule {
                Rule::Discrete => Some(simulation.discrete.integrator),
                Rule::Bisect => Some(simulation.bisect.integrator),
                Rule::Exact | Rule::Contact => None,
            },
            impact_law: is_exact.then_some(simulation.exact.impact_law),
            sub_steps: is_contact.then_some(simulation.contact.sub_steps),
            sweeps: is_contact.then_some(simulation.contact.sweeps),
            frame_time: simulation.frame_time,
            frames: observer.frames,
            edits: replay.edits(),
            simulated_time: world.time(),
            spheres: world.spheres().len(),
            emitted: observer.emitted,
            retired: observer.retired,
            left_out: observer.left_out,
            impacts: observer.impacts,
            wells: simulation.pair_potential.map(|_| observer.wells),
            trigger_contacts: observer.trigger_contacts,
            unfinished_islands: observer.unfinished_islands,
            work: observer.work.into(),
            energy_at_start: energies[0].total,
            energy_at_end: energies[1].total,
            energy_balance: EnergyBalance::new(
                observer.energy,
                energies,
                rest_of(replay.scene(), world, replay.edits()),
            ),
            momentum_at_start: observer.momentum_at_start.to_array(),
            momentum_at_end: world.momentum().to_array(),
            largest_overlap: observer.largest_overlap,
            largest_momentum_error: is_exact.then_some(observer.largest_momentum_error),
            largest_energy_error: is_exact.then_some(observer.largest_energy_error),
            contact: (is_contact || observer.zones.are_any()).then_some(observer.contact),
            zones: observer.zones.are_any().then_some(observer.zones),
            stress: observer.stress.and_then(|gauge| gauge.mean()),
            wall_time: observer.began.elapsed().as_secs_f64(),
            stepping_time: observer.stepping.as_secs_f64(),
            state_hash: world.state_hash().to_string(),
            unread: unread(simulation, world),
            advice,
            broken,
        }
    }

    /// Violated guarantees of the rule, a line each.
    pub fn broken(&self) -> &[String] {
        &self.broken
    }

    /// Prints the figures as a table, or as JSON.
    pub fn print(&self, mut out: &mut dyn Write, json: bool) -> io::Result<()> {
        if json {
            serde_json::to_writer_pretty(&mut out, self)?;
            return writeln!(out);
        }
        for (name, value) in self.rows() {
            writeln!(out, "{name:<16} {value}")?;
        }
        Ok(())
    }

    /// Describes the rule and its method.
    fn rule(&self) -> String {
        let rule = match self.wind_back {
            Some(wind_back) => {
                format!("{}, winding back {}", written(self.rule), written(wind_back))
            }
            None => written(self.rule),
        };
        let method = match (self.impact_law, self.sub_steps, self.sweeps) {
            (Some(law), ..) => format!("impact law {}", written(law)),
            (_, Some(sub_steps), Some(sweeps)) => format!("sub-steps {sub_steps}, sweeps {sweeps}"),
            _ => written(self.integrator),
        };
        format!("{rule}, {method}, frames of {:.6} s", self.frame_time)
    }

    fn rows(&self) -> Vec<(&'static str, String)> {
        let start = DVec3::from_array(self.momentum_at_start);
        let end = DVec3::from_array(self.momentum_at_end);
        let came_and_went = match (self.emitted, self.retired, self.left_out) {
            (0, 0, 0) => String::new(),
            (emitted, retired, 0) => format!(" ({emitted} emitted, {retired} retired)"),
            (emitted, retired, left_out) => format!(
                " ({emitted} emitted, {retired} retired, {left_out} left out: no room at the emitter)"
            ),
        };
        let energy = energy_change(self.energy_at_start, self.energy_at_end);
        let mut rows = vec![
            ("scene", self.scene.clone()),
            ("rule", self.rule()),
            ("simulated time", format!("{:.3} s in {} frames", self.simulated_time, self.frames)),
            ("spheres", format!("{}{came_and_went}", self.spheres)),
            ("impacts", self.impacts.to_string()),
            ("energy", energy),
            ("momentum", momentum_change(start, end)),
            ("largest overlap", format!("{:.3e} m at the end of a frame", self.largest_overlap)),
            (
                "wall time",
                format!("{:.3} s, {:.3} s of it physics", self.wall_time, self.stepping_time),
            ),
            ("state hash", self.state_hash.clone()),
        ];
        if let Some(stress) = &self.stress {
            rows.splice(7..7, stress.rows());
        }
        if let Some(zones) = &self.zones {
            let time = self.simulated_time;
            rows.splice(6..6, [("stepped zones", zones.row(time))]);
        }
        if let Some(contact) = &self.contact {
            // Insert before the momentum.
            rows.splice(6..6, contact.rows());
        }
        rows.splice(6..6, self.energy_balance.rows());
        if let (Some(momentum), Some(energy)) =
            (self.largest_momentum_error, self.largest_energy_error)
        {
            let text = format!(
                "largest error of an impact: momentum {momentum:.1e}, energy {energy:.1e} (relative)"
            );
            rows.insert(5, ("ledger", text));
        }
        rows.splice(5..5, self.wells.map(|wells| ("wells", wells.row())));
        if self.trigger_contacts > 0 {
            let text = format!("{} times a sphere in a frame", self.trigger_contacts);
            rows.insert(5, ("in triggers", text));
        }
        if self.edits > 0 {
            rows.insert(3, ("edits", format!("{} made on the way", self.edits)));
        }
        if self.unfinished_islands > 0 {
            let text = format!(
                "{} times bodies came to rest on each other: their group took the rest of the frame \
                 in one piece",
                self.unfinished_islands
            );
            rows.push(("note", text));
        }
        rows.extend(self.unread.iter().map(|unread| ("not read", unread.clone())));
        rows.extend(self.broken.iter().map(|broken| ("not kept", broken.clone())));
        rows.extend(self.advice.iter().map(|advice| ("advice", advice.clone())));
        rows
    }
}

fn energy_change(start: f64, end: f64) -> String {
    let relative = if start == 0.0 {
        String::new()
    } else {
        format!(", {:+.3e} of the start", (end - start) / start.abs())
    };
    format!("{} J ({:+.3e}{relative})", from_to(start, end), end - start)
}

/// Formats the magnitudes of the momentum, and that of its change.
fn momentum_change(start: DVec3, end: DVec3) -> String {
    let change = (end - start).length();
    format!("{} kg m/s (change {change:.3e})", from_to(start.length(), end.length()))
}

/// Formats two numbers with six digits; in scientific notation if they are very large or both very
/// small.
fn from_to(start: f64, end: f64) -> String {
    /// Numbers that are readable with six digits after the point.
    const PLAIN: std::ops::Range<f64> = 1e-3..1e9;
    let largest = start.abs().max(end.abs());
    if largest == 0.0 || PLAIN.contains(&largest) {
        format!("{start:.6} -> {end:.6}")
    } else {
        format!("{start:.6e} -> {end:.6e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_powers_of_ten_where_zeros_would_hide_them() {
        assert_eq!(from_to(0.0, 0.0), "0.000000 -> 0.000000");
        assert_eq!(from_to(12.5, 0.0), "12.500000 -> 0.000000");
        assert_eq!(from_to(1.5e-6, -2e-7), "1.500000e-6 -> -2.000000e-7");
        assert_eq!(from_to(1.0, 1e33), "1.000000e0 -> 1.000000e33");
        assert_eq!(
            energy_change(2.0, 1.0),
            "2.000000 -> 1.000000 J (-1.000e0, -5.000e-1 of the start)"
        );
    }
}
