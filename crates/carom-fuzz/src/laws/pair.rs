//! Checks that two worlds run alike, as a law demands.
//!
//! Some laws hold to the bit. Where two worlds round otherwise, they separate, as any two runs of colliding spheres do:
//! each impact multiplies their distance by some path length over a radius. Two more runs of the same world, with its
//! spheres 10⁻¹² elsewhere ([`perturbed`]), measure this growth; 10⁻¹² is thousands of roundings. So the first rule is:
//! **at each frame, the pair of a world is no farther from it than the farther of the perturbed worlds was so far**.
//!
//! These do not show the rounding on the way. The bounces with which a ball comes to rest shift alike when it starts
//! elsewhere, while the rounding ε L of a gap shifts a bounce by ε L over its speed, which falls from bounce to bounce.
//! Two runs of the same world moved a little, so that all its coordinates round otherwise ([`elsewhere`]), are two samples
//! of this. A third sample is sixteen times as far as both in fewer than one of 16² cases, of which a campaign of
//! thousands has some: where the pair is, four more samples are taken. So the second rule is: **the pair may be sixteen
//! times as far as the farthest of these was so far**.
//!
//! Where a bound has grown beyond 10⁻⁶, a million times the start, or where events have another order, the worlds show
//! nothing more, and the comparison ends.
//!
//! A distance is the largest of three: of positions as a part of the largest coordinate, of velocities as a part of the
//! largest speed, and of the energy that contacts took as a part of the kinetic energy.

use carom::DVec3;
use carom_scene::Scene;

use super::elsewhere::elsewhere;
use super::perturbed::{SIZE, perturbed};
use super::run::{law, step, world};
use super::trace::{Body, Frame, Trace};
use crate::fault::Fault;

/// Distance of a perturbed world at which the comparison ends.
const MOST: f64 = 1e-6;

/// Allowed distance of a pair, divided by that of the farthest of some worlds that round otherwise.
const OF_SAMPLES: f64 = 16.0;

/// How many worlds that round otherwise are run at first, and in all where a law does not hold beside these.
const SAMPLES: [usize; 2] = [2, 6];

/// Events and sweeps after which the comparison ends, because every law repeats this work.
const MOST_WORK: u64 = 10_000;

/// A law: a world and a changed copy, its pair, run alike.
pub struct Law {
    /// How the pair is changed, as findings name it.
    pub name: &'static str,
    /// Makes the pair of a scene with this run; `None` where the law does not apply.
    pub pair: fn(&Scene, &Trace) -> Option<Pair>,
}

/// A scene that must run as another one.
pub struct Pair {
    pub scene: Scene,
    /// Converts a frame of the pair to the coordinates of the other scene.
    pub back: Box<dyn Fn(&mut Frame)>,
    pub agreement: Agreement,
    /// Number of frames of the pair in a frame of the other scene.
    pub frames: usize,
    /// Whether the pair runs backwards, from the end of the other scene.
    pub is_backwards: bool,
    /// Whether the law ends at this frame of either world.
    pub ends: fn(&Frame) -> bool,
}

/// How closely a pair must follow its world.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Agreement {
    Bits,
    Rounding,
}

impl Pair {
    /// Creates a pair that begins with its world and has equal frames; its law never ends.
    pub fn new(scene: Scene, agreement: Agreement, back: impl Fn(&mut Frame) + 'static) -> Self {
        let back = Box::new(back);
        Self { scene, back, agreement, frames: 1, is_backwards: false, ends: |_| false }
    }

    /// Runs `scene`, that of the pair or a perturbed one, beside the expected trace while `goes_on` returns true for each
    /// frame.
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

/// Checks the laws of a scene against its run.
///
/// # Errors
/// The law that does not hold.
pub fn check(laws: &[Law], scene: &Scene, trace: &Trace) -> Result<(), Fault> {
    let mut trace = trace.clone();
    trace.frames.truncate(trace.until_work(MOST_WORK).max(1));
    // The other worlds are run once for all laws that begin with the world.
    let mut grown = Grown::default();
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
                Grown::default().check(&pair, &pair, &reversed)
            }
            Agreement::Rounding => {
                let own = Pair::new(scene.clone(), pair.agreement, |_| ());
                grown.check(&pair, &own, &trace)
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
        // What is not seen in a square has underflowed.
        let away = motion_distance(trace, number, frame);
        law(away == 0.0 && frame.time == expected.time, || {
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

/// Distances of perturbed worlds from the world, by frame; empty where they were not run.
#[derive(Debug, Default)]
struct Grown {
    /// The larger distance of two that begin a little otherwise.
    of_start: Vec<f64>,
    /// The largest distance of these, and of some that round otherwise times [`OF_SAMPLES`].
    of_all: Vec<f64>,
    /// How many of the latter were run.
    samples: usize,
}

impl Grown {
    /// Checks a pair against the trace of its world; `own` is the world itself as a pair.
    fn check(&mut self, pair: &Pair, own: &Pair, trace: &Trace) -> Result<(), Fault> {
        if self.of_start.is_empty() {
            let both = [false, true].map(|is_opposite| {
                let scene = perturbed(&own.scene, is_opposite);
                growth(own, (&scene, DVec3::ZERO), trace, SIZE)
            });
            self.of_start = larger(&both);
        }
        match check_rounding(pair, trace, &self.of_start) {
            Err(Fault::Law(_)) => {}
            other => return other,
        }
        if self.of_all.is_empty() {
            self.of_all.clone_from(&self.of_start);
        }
        let mut found = Ok(());
        for samples in SAMPLES {
            self.run_elsewhere(own, trace, samples);
            found = check_rounding(pair, trace, &self.of_all);
            if !matches!(found, Err(Fault::Law(_))) {
                break;
            }
        }
        found
    }

    /// Runs as many worlds that round otherwise as are missing.
    fn run_elsewhere(&mut self, own: &Pair, trace: &Trace, samples: usize) {
        let extent = trace.frames.iter().map(|frame| frame.extent).fold(0.0, f64::max);
        let missing = elsewhere(&own.scene, extent).take(samples).skip(self.samples);
        for (scene, way) in missing {
            let grown = growth(own, (&scene, way), trace, 0.0);
            let of_sample: Vec<f64> = grown.into_iter().map(|it| OF_SAMPLES * it).collect();
            self.of_all = larger(&[std::mem::take(&mut self.of_all), of_sample]);
        }
        self.samples = self.samples.max(samples);
    }
}

/// Returns the larger of two distances, by frame.
fn larger([first, second]: &[Vec<f64>; 2]) -> Vec<f64> {
    first.iter().zip(second).map(|(first, second)| first.max(*second)).collect()
}

/// Returns the largest distance so far between the run of a scene and the trace, by frame, at least `least`. The scene
/// was moved along `way` \[m\].
fn growth(pair: &Pair, (scene, way): (&Scene, DVec3), trace: &Trace, least: f64) -> Vec<f64> {
    let mut grown = vec![f64::INFINITY; trace.frames.len()];
    let mut so_far = least;
    // One that stops has grown out of it.
    let _ = pair.follow(scene, trace, |number, frame| {
        let mut frame = frame.clone();
        frame.bodies.iter_mut().for_each(|body| body.position -= way);
        so_far = so_far.max(distance(trace, number, &frame));
        grown[number] = so_far;
        Ok(so_far <= MOST)
    });
    grown
}

/// Returns the distance of a frame from the frame `number` of the trace.
fn distance(trace: &Trace, number: usize, frame: &Frame) -> f64 {
    let lost = (frame.lost - trace.frames[number].lost).abs();
    ratio(lost, largest_so_far(trace, number, frame, |it| it.energy))
        .max(motion_distance(trace, number, frame))
}

/// Returns the distance of the motion of the spheres from that in the frame `number` of the trace; infinite if the
/// spheres differ.
fn motion_distance(trace: &Trace, number: usize, frame: &Frame) -> f64 {
    let expected = &trace.frames[number];
    let is_same = |(one, other): (&Body, &Body)| one.id == other.id;
    let pairs = || frame.bodies.iter().zip(&expected.bodies);
    if frame.bodies.len() != expected.bodies.len() || !pairs().all(is_same) {
        return f64::INFINITY;
    }
    let extent = largest_so_far(trace, number, frame, |it| it.extent);
    let speed = largest_so_far(trace, number, frame, |it| it.speed);
    let of_body = |(one, other): (&Body, &Body)| {
        let way = trace.boundary.nearest_image(one.position - other.position);
        let change = (one.velocity - other.velocity).length();
        let slip = one.radius * (one.spin - other.spin).length();
        ratio(way.length(), extent).max(ratio(change.max(slip), speed))
    };
    pairs().map(of_body).fold(0.0, f64::max)
}

/// Returns the largest value of a quantity in a frame and in a trace up to that frame.
fn largest_so_far(trace: &Trace, number: usize, frame: &Frame, of: fn(&Frame) -> f64) -> f64 {
    trace.frames[..=number].iter().map(of).fold(of(frame), f64::max)
}

fn ratio(away: f64, whole: f64) -> f64 {
    if away == 0.0 { 0.0 } else { away / whole }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::keeps::Keeps;
    use crate::laws::run::{FRAMES, run};

    /// Three balls that fall and meet in a box.
    fn scene() -> Scene {
        let text = "
            [simulation]
            frame_time = 0.015625
            [[forces]]
            gravity = { acceleration = [0.0, -9.81, 0.0] }
            [[spheres]]
            position = [-0.5, 0.1, 0.0]
            velocity = [3.0, 0.5, 0.2]
            radius = 0.1
            [[spheres]]
            position = [0.5, 0.2, 0.1]
            velocity = [-2.0, 1.0, 0.0]
            radius = 0.2
            [[spheres]]
            position = [0.0, -0.5, -0.3]
            radius = 0.1
            [[colliders]]
            shape = { container = { size = [2.0, 2.0, 2.0] } }
        ";
        Scene::from_toml(text, "scene.toml").unwrap()
    }

    /// The scene with this speed added to that of a sphere \[m/s\].
    fn faster(scene: &Scene, by: f64, agreement: Agreement) -> Option<Pair> {
        let mut other = scene.clone();
        other.spheres[0].velocity[0] += by;
        Some(Pair::new(other, agreement, |_| ()))
    }

    fn holds(pair: fn(&Scene, &Trace) -> Option<Pair>) -> bool {
        let scene = scene();
        let mut world = world(&scene).unwrap();
        let (mut trace, mut keeps) = (Trace::new(&world), Keeps::of(&scene, &world));
        run(&scene, &mut world, FRAMES, &mut keeps, &mut trace).unwrap();
        check(&[Law { name: "faster", pair }], &scene, &trace).is_ok()
    }

    #[test]
    fn a_pair_that_rounding_takes_apart_is_let_through_and_one_that_differs_by_more_is_not() {
        assert!(holds(|scene, _| faster(scene, 0.0, Agreement::Bits)));
        assert!(!holds(|scene, _| faster(scene, 1e-15, Agreement::Bits)));
        assert!(holds(|scene, _| faster(scene, 1e-15, Agreement::Rounding)));
        assert!(!holds(|scene, _| faster(scene, 1e-10, Agreement::Rounding)));
    }

    #[test]
    fn a_law_ends_where_it_says_no_more() {
        let ends_at_once = |scene: &Scene, _: &Trace| {
            let pair = faster(scene, 1e-10, Agreement::Rounding)?;
            Some(Pair { ends: |_| true, ..pair })
        };
        assert!(holds(ends_at_once));
    }
}
