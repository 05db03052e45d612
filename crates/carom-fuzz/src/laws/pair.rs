//! Two worlds that go the same way, as a law has it.
//!
//! Some laws hold to the bit. Where two worlds round otherwise, they come apart, as any two runs of colliding spheres
//! do: each impact makes what is between them larger by some way over radius. How much rounding has grown is seen of two
//! more runs, of the same world with its spheres 10⁻¹² elsewhere, drawn out and drawn together ([`perturbed`]). That is
//! thousands of roundings. So the rule is: **at each frame, the pair of a world is no farther from it than the farther
//! of the perturbed worlds was so far**. Where one of these is more than 10⁻⁶ away, having grown a million times or
//! having taken another order of events, nothing more can be told of the world, and the comparison ends.
//!
//! Distances are those of positions and velocities, as parts of the largest coordinate and the largest speed, and
//! of what contacts took, as a part of the kinetic energy; the largest of all counts.

use carom::DVec3;
use carom_scene::Scene;

use super::perturbed::{SIZE, perturbed};
use super::trace::{Body, Frame, Trace};
use super::{law, step, world};
use crate::fault::Fault;

/// Distance of a perturbed world from which on nothing is compared.
const MOST: f64 = 1e-6;

/// Events after which nothing is compared: that much work is not done again for every law.
const MOST_EVENTS: u64 = 20_000;

/// That a world and a pair of it go the same way.
pub struct Law {
    /// What the pair is, as it is told.
    pub name: &'static str,
    /// The pair of a scene of which this is the run; `None` where the law says nothing.
    pub pair: fn(&Scene, &Trace) -> Option<Pair>,
}

/// A scene that goes the way of another one.
pub struct Pair {
    pub scene: Scene,
    /// Takes its state to that of the other one.
    pub back: Box<dyn Fn(&mut Frame)>,
    pub agreement: Agreement,
    /// Its frames in a frame of the other one.
    pub frames: usize,
    /// Whether it goes back, from the end of the other one.
    pub is_backwards: bool,
    /// From which frame on the law says no more: one of either world.
    pub ends: fn(&Frame) -> bool,
}

/// How near a pair is to its world.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Agreement {
    Bits,
    Rounding,
}

impl Pair {
    /// A pair that begins with its world, of equal frames, of which the law never ends.
    pub fn new(scene: Scene, agreement: Agreement, back: impl Fn(&mut Frame) + 'static) -> Self {
        let back = Box::new(back);
        Self { scene, back, agreement, frames: 1, is_backwards: false, ends: |_| false }
    }

    /// Runs this scene, its own or one perturbed, along another trace, as long as `goes_on` with the distance from that.
    fn follow(
        &self,
        scene: &Scene,
        expected: &Trace,
        mut goes_on: impl FnMut(usize, &Frame) -> Result<bool, Fault>,
    ) -> Result<(), Fault> {
        let mut world = world(scene)?;
        for number in 1..expected.frames.len() {
            let mut frame = Frame::default();
            for _ in 0..self.frames {
                step(scene, &mut world)?;
                let before = std::mem::replace(&mut frame, Frame::after_step(&world));
                frame.add_before(&before);
            }
            (self.back)(&mut frame);
            frame.bodies.sort_by_key(|body| body.id);
            if !goes_on(number, &frame)? {
                break;
            }
        }
        Ok(())
    }
}

/// Checks the laws of a scene of which this is the run.
///
/// # Errors
/// The law that does not hold.
pub fn check(laws: &[Law], scene: &Scene, trace: &Trace) -> Result<(), Fault> {
    let mut trace = trace.clone();
    trace.frames.truncate(trace.until_events(MOST_EVENTS).max(1));
    // The perturbed worlds are run once for all laws that begin with the world.
    let mut grown = None;
    for law in laws {
        let Some(pair) = (law.pair)(scene, &trace) else { continue };
        let named = |fault| match fault {
            Fault::Law(said) => Fault::Law(format!("{}: {said}", law.name)),
            fault => fault,
        };
        match pair.agreement {
            Agreement::Bits => check_bits(&pair, &trace),
            Agreement::Rounding if pair.is_backwards => {
                let mut reversed = trace.clone();
                reversed.frames.reverse();
                let grown = growth(&pair, &pair.scene, &reversed);
                check_rounding(&pair, &reversed, &grown)
            }
            Agreement::Rounding => {
                let same = || Pair::new(scene.clone(), Agreement::Rounding, |_| ());
                let grown = grown.get_or_insert_with(|| growth(&same(), scene, &trace));
                check_rounding(&pair, &trace, grown)
            }
        }
        .map_err(named)?;
    }
    Ok(())
}

fn check_bits(pair: &Pair, trace: &Trace) -> Result<(), Fault> {
    pair.follow(&pair.scene, trace, |number, frame| {
        let expected = &trace.frames[number];
        if (pair.ends)(expected) || (pair.ends)(frame) {
            return Ok(false);
        }
        law(frame.is_same(expected), || {
            let away = distance(trace, number, frame);
            format!("is {away:e} away, and not the same to the bit, at {} s", expected.time)
        })?;
        Ok(true)
    })
}

fn check_rounding(pair: &Pair, trace: &Trace, grown: &[f64]) -> Result<(), Fault> {
    let is_over = |number: usize| grown[number] > MOST || (pair.ends)(&trace.frames[number]);
    if trace.frames.len() < 2 || is_over(1) {
        return Ok(());
    }
    pair.follow(&pair.scene, trace, |number, frame| {
        if is_over(number) || (pair.ends)(frame) {
            return Ok(false);
        }
        let (away, most) = (distance(trace, number, frame), grown[number]);
        let time = trace.frames[number].time;
        law(away <= most, || {
            format!("is {away:e} away, rounding having grown to {most:e}, at {time} s")
        })?;
        Ok(true)
    })
}

/// By frame, how far the farther of two perturbed worlds was so far.
fn growth(pair: &Pair, scene: &Scene, trace: &Trace) -> Vec<f64> {
    let mut grown = vec![f64::INFINITY; trace.frames.len()];
    for is_opposite in [false, true] {
        let mut so_far: f64 = SIZE;
        let known = std::mem::replace(&mut grown, vec![f64::INFINITY; trace.frames.len()]);
        // One that stops has grown out of it.
        let _ = pair.follow(&perturbed(scene, is_opposite), trace, |number, frame| {
            so_far = so_far.max(distance(trace, number, frame));
            grown[number] = if is_opposite { so_far.max(known[number]) } else { so_far };
            Ok(so_far <= MOST)
        });
    }
    grown
}

/// How far a frame is from that with this number; infinite where there are other spheres.
fn distance(trace: &Trace, number: usize, frame: &Frame) -> f64 {
    let expected = &trace.frames[number];
    let so_far = &trace.frames[..=number];
    let most = |of: fn(&Frame) -> f64| so_far.iter().map(of).fold(of(frame), f64::max);
    let (extent, speed, energy) = (most(Frame::extent), most(Frame::speed), most(|it| it.energy));
    let part = |away: f64, whole: f64| if away == 0.0 { 0.0 } else { away / whole };
    if frame.bodies.len() != expected.bodies.len() {
        return f64::INFINITY;
    }
    let of_body = |(one, other): (&Body, &Body)| {
        if one.id != other.id {
            return f64::INFINITY;
        }
        let way = trace.boundary.nearest_image(one.position - other.position);
        let slower = |one: DVec3, other: DVec3| (one - other).length();
        let slip = one.radius * slower(one.spin, other.spin);
        part(way.length(), extent).max(part(slower(one.velocity, other.velocity).max(slip), speed))
    };
    let bodies = frame.bodies.iter().zip(&expected.bodies).map(of_body);
    bodies.fold(part((frame.lost - expected.lost).abs(), energy), f64::max)
}
