//! Winding back: which spheres go through the pieces of a frame, and that all of them is the rule of the tutorial.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use carom::{DVec3, Force, Gravity, Sphere, SphereState, World};

use crate::common::{Numbers, assert_close_vec, bisect, bisect_all, vec, world};

/// Counts how often forces are evaluated: once for each sphere that is moved. It is conservative, since the work of
/// other forces is measured, too.
#[derive(Debug, Clone, Default)]
struct Counter(Arc<AtomicU64>);

impl Force for Counter {
    fn on(&self, _sphere: &SphereState, _time: f64) -> DVec3 {
        self.0.fetch_add(1, Ordering::Relaxed);
        DVec3::ZERO
    }

    fn is_conservative(&self) -> bool {
        true
    }
}

#[test]
fn of_a_hundred_spheres_only_the_four_that_meet_are_wound_back() {
    let mut world = world(bisect());
    let counter = Counter::default();
    world.add_force(counter.clone()).unwrap();
    for i in 0..98 {
        world.add_sphere(Sphere::new(vec(0.0, 2.0 * f64::from(i), 0.0), 0.5)).unwrap();
    }
    for y in [0.0, 20.0] {
        let left = Sphere::new(vec(-2.3, y, 0.0), 0.5).with_velocity(vec(2.0, 0.0, 0.0));
        world.add_sphere(left).unwrap();
    }
    world.step(1.0).unwrap();
    assert_eq!(world.report().impacts.len(), 2);
    let repeated = counter.0.load(Ordering::Relaxed) - 100;
    // Four spheres: the frame again, 8 halvings, to the contact, and the rest of the frame.
    assert_eq!(repeated, 4 * (1 + 8 + 1 + 1));
}

#[test]
fn winding_back_all_or_only_those_touched_agrees_without_forces() {
    let mut numbers = Numbers(7);
    let mut spheres = Vec::new();
    for i in 0..64u32 {
        let cell = vec((i % 4).into(), (i / 4 % 4).into(), (i / 16).into());
        let sphere = Sphere::new(1.2 * cell + 0.05 * numbers.vector(), 0.5);
        spheres.push(sphere.with_velocity(3.0 * numbers.vector()));
    }
    // One frame with many contacts: the same pairs, at times that differ by the halvings only.
    let h = 0.05;
    let run = |rule| {
        let mut world = world(rule);
        for sphere in &spheres {
            world.add_sphere(*sphere).unwrap();
        }
        world.step(h).unwrap();
        world
    };
    let (touched, all) = (run(bisect()), run(bisect_all()));
    let pairs = |world: &World| {
        let mut pairs: Vec<_> = world.report().impacts.iter().map(|i| i.between).collect();
        pairs.sort();
        pairs
    };
    assert!(pairs(&touched).len() > 5);
    assert_eq!(pairs(&touched), pairs(&all));
    for (a, b) in touched.spheres().positions().iter().zip(all.spheres().positions()) {
        // A contact time off by h/256 moves a sphere by that times a relative speed of up to 10,
        // some more where contacts follow each other.
        assert_close_vec(*a, *b, 4.0 * 10.0 * h / 256.0);
    }
}

/// The tutorial's rule in its plainest form - no islands, no broad phase - for spheres under
/// gravity: the oracle for `wind_back: All`.
fn plain_rule(x: &mut [DVec3], v: &mut [DVec3], g: DVec3, h: f64) {
    let advance = |x: &[DVec3], v: &[DVec3], t: f64| -> (Vec<DVec3>, Vec<DVec3>) {
        let v: Vec<_> = v.iter().map(|v| v + t * g).collect();
        (x.iter().zip(&v).map(|(x, v)| x + t * v).collect(), v)
    };
    let pairs = |members: &[usize], x: &[DVec3], v: &[DVec3]| {
        let (mut intersecting, mut colliding) = (Vec::new(), Vec::new());
        for (k, &i) in members.iter().enumerate() {
            for &j in &members[k + 1..] {
                let gap = (x[j] - x[i]).length() - 1.0;
                let closes = (v[j] - v[i]).dot(x[j] - x[i]) < 0.0;
                if closes && gap < -1e-9 {
                    intersecting.push((i, j));
                } else if closes && gap <= 1e-9 {
                    colliding.push((i, j));
                }
            }
        }
        (intersecting, colliding)
    };
    let respond = |pairs: &[(usize, usize)], x: &[DVec3], v: &mut [DVec3]| {
        for &(i, j) in pairs {
            let n = (x[j] - x[i]).normalize();
            let change = (v[j] - v[i]).dot(n);
            if change < 0.0 {
                v[i] += change * n;
                v[j] -= change * n;
            }
        }
    };
    let everyone: Vec<usize> = (0..x.len()).collect();
    let mut rest = h;
    loop {
        let (end_x, mut end_v) = advance(x, v, rest);
        let (mut late, colliding) = pairs(&everyone, &end_x, &end_v);
        if late.is_empty() {
            respond(&colliding, &end_x, &mut end_v);
            x.copy_from_slice(&end_x);
            v.copy_from_slice(&end_v);
            return;
        }
        let mut involved: Vec<usize> = late.iter().flat_map(|&(i, j)| [i, j]).collect();
        involved.sort();
        involved.dedup();
        let (mut floor, mut ceiling, mut t) = (0.0, rest, 0.0);
        let mut answered = Vec::new();
        for _ in 0..8 {
            t = 0.5 * (floor + ceiling);
            let (trial_x, trial_v) = advance(x, v, t);
            let (intersecting, colliding) = pairs(&involved, &trial_x, &trial_v);
            if !intersecting.is_empty() {
                ceiling = t;
                answered = intersecting.clone();
                answered.extend(&colliding);
                answered.sort();
                late = intersecting;
            } else if colliding.is_empty() {
                floor = t;
                answered = late.clone();
            } else {
                answered = colliding;
                break;
            }
        }
        let (new_x, mut new_v) = advance(x, v, t);
        respond(&answered, &new_x, &mut new_v);
        x.copy_from_slice(&new_x);
        v.copy_from_slice(&new_v);
        rest -= t;
    }
}

#[test]
fn winding_back_all_is_the_tutorials_rule() {
    let mut numbers = Numbers(8);
    let g = vec(0.0, -9.81, 0.0);
    let mut world = world(bisect_all());
    world.add_force(Gravity::new(g)).unwrap();
    let (mut x, mut v) = (Vec::new(), Vec::new());
    for i in 0..27u32 {
        let cell = vec((i % 3).into(), (i / 3 % 3).into(), (i / 9).into());
        x.push(1.1 * cell + 0.04 * numbers.vector());
        v.push(4.0 * numbers.vector());
        world.add_sphere(Sphere::new(x[i as usize], 0.5).with_velocity(v[i as usize])).unwrap();
    }
    let mut impacts = 0;
    for _ in 0..10 {
        world.step(0.02).unwrap();
        plain_rule(&mut x, &mut v, g, 0.02);
        impacts += world.report().impacts.len();
    }
    assert!(impacts > 20, "{impacts}");
    for i in 0..x.len() {
        // Rounding (the order of operations differs), doubled by each of a few impacts.
        assert_close_vec(world.spheres().positions()[i], x[i], 1e-11);
        assert_close_vec(world.spheres().velocities()[i], v[i], 1e-10);
    }
}
