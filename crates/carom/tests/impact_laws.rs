//! Impact laws and contact forces for groups of bodies that touch at one instant, against closed
//! forms and against the properties that Smith et al. (2012) ask of an impact operator.
//!
//! Geometry is made here, so these say nothing about detection.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

mod common;

use carom::DVec3;
use carom::respond::{
    GroupResponse, ImpactLaw, TouchingContact, contact_forces, line_of_centres, resolve,
};
use common::{Numbers, assert_close, assert_close_vec, vec};

const LAWS: [ImpactLaw; 3] =
    [ImpactLaw::Sequential, ImpactLaw::Simultaneous, ImpactLaw::Reflection];
const SYMMETRIC: [ImpactLaw; 2] = [ImpactLaw::Simultaneous, ImpactLaw::Reflection];

/// Roundings: results of a handful of operations on numbers of order 1.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

const STRESS: usize = 5000;

#[derive(Clone)]
struct Group {
    contacts: Vec<TouchingContact>,
    masses: Vec<f64>,
    velocities: Vec<DVec3>,
}

fn pair(first: usize, second: usize, normal: DVec3, restitution: f64) -> TouchingContact {
    let surface_velocity = DVec3::ZERO;
    TouchingContact { first: Some(first), second, normal, surface_velocity, restitution }
}

fn surface(second: usize, normal: DVec3, restitution: f64) -> TouchingContact {
    let surface_velocity = DVec3::ZERO;
    TouchingContact { first: None, second, normal, surface_velocity, restitution }
}

impl Group {
    /// Balls in a row along x, each touching the next.
    fn row(masses: &[f64], speeds: &[f64], e: f64) -> Self {
        let contacts = (1..masses.len()).map(|i| pair(i - 1, i, DVec3::X, e)).collect();
        let velocities = speeds.iter().map(|speed| vec(*speed, 0.0, 0.0)).collect();
        Self { contacts, masses: masses.to_vec(), velocities }
    }

    /// Spheres whose centres are nearly two radii apart touch; those near the floor touch it.
    fn touching(centres: &[DVec3], floor: bool, slack: f64, e: impl Fn(usize) -> f64) -> Self {
        let mut contacts = Vec::new();
        for (j, b) in centres.iter().enumerate() {
            if floor && b.y < 0.5 + slack {
                contacts.push(surface(j, DVec3::Y, e(contacts.len())));
            }
            for (i, a) in centres[..j].iter().enumerate() {
                if (*b - *a).length() < 1.0 + slack {
                    contacts.push(pair(i, j, (*b - *a).normalize(), e(contacts.len())));
                }
            }
        }
        let (masses, velocities) = (vec![1.0; centres.len()], vec![DVec3::ZERO; centres.len()]);
        Self { contacts, masses, velocities }
    }

    /// A random heap: each sphere falls onto what is there already, roughly.
    fn heap(count: usize, numbers: &mut Numbers, e: impl Fn(usize) -> f64) -> Self {
        let width = (count as f64 / 4.0).cbrt() * 1.5;
        let mut centres: Vec<DVec3> = Vec::new();
        while centres.len() < count {
            let (x, z) = (numbers.between(0.0, width), numbers.between(0.0, width));
            let height = |below: &DVec3| {
                let (dx, dz) = (x - below.x, z - below.z);
                let room = 1.0 - dx * dx - dz * dz;
                if room > 0.0 { below.y + room.sqrt() } else { 0.5 }
            };
            let y = centres.iter().map(height).fold(0.5, f64::max);
            centres.push(vec(x, y, z));
        }
        let mut group = Self::touching(&centres, true, 0.05, e);
        for velocity in &mut group.velocities {
            *velocity = numbers.vector() - 0.5 * DVec3::Y;
        }
        group
    }

    fn energy(&self) -> f64 {
        self.masses.iter().zip(&self.velocities).map(|(m, v)| 0.5 * m * v.dot(*v)).sum()
    }

    fn momentum(&self) -> DVec3 {
        self.masses.iter().zip(&self.velocities).map(|(m, v)| *m * *v).sum()
    }

    fn opening(&self, contact: &TouchingContact) -> f64 {
        let first = contact.first.map_or(contact.surface_velocity, |i| self.velocities[i]);
        (self.velocities[contact.second] - first).dot(contact.normal)
    }

    fn worst_closing(&self) -> f64 {
        self.contacts.iter().map(|contact| -self.opening(contact)).fold(0.0, f64::max)
    }

    fn resolve(&mut self, law: ImpactLaw) -> GroupResponse {
        resolve(law, &self.contacts, &self.masses, &mut self.velocities)
    }

    fn speeds(&self) -> Vec<f64> {
        self.velocities.iter().map(|v| v.x).collect()
    }
}

/// What every law promises of every group.
#[track_caller]
fn assert_lawful(before: &Group, after: &Group, response: &GroupResponse, what: &str) {
    assert_lawful_within(1e-13, before, after, response, what);
}

/// `rounding` of energy and momentum, relative.
#[track_caller]
fn assert_lawful_within(
    rounding: f64,
    before: &Group,
    after: &Group,
    response: &GroupResponse,
    what: &str,
) {
    let scale = before.momentum().length()
        + before.masses.iter().zip(&before.velocities).map(|(m, v)| m * v.length()).sum::<f64>();
    let from_surfaces: DVec3 = before
        .contacts
        .iter()
        .zip(&response.impulses)
        .filter(|(contact, _)| contact.first.is_none())
        .map(|(contact, impulse)| *impulse * contact.normal)
        .sum();
    let gained = after.momentum() - before.momentum() - from_surfaces;
    assert!(gained.length() <= rounding * scale, "{what}: momentum off by {gained}");
    assert!(response.impulses.iter().all(|p| *p >= 0.0), "{what}: pulled");
    assert!(
        after.worst_closing() <= response.resolution,
        "{what}: closing at {:e}, resolution {:e}, cut short: {}",
        after.worst_closing(),
        response.resolution,
        response.cut_short
    );
    let change = after.energy() - before.energy();
    assert!(change <= rounding * before.energy(), "{what}: gained {change} of {}", before.energy());
    let asked = response.restitution_energy + response.surface_work;
    assert!(
        (change - asked).abs() <= 10.0 * rounding * before.energy(),
        "{what}: energy changed by {change}, asked for {asked}"
    );
}

#[test]
fn cradle_sends_out_as_many_balls_as_come_in_and_leaves_the_rest_exactly_still() {
    for mass in [1.0, 0.3, 7.7e-3] {
        for speed in [1.0, 0.1, 3.7] {
            for k in 1..=4 {
                let speeds: Vec<f64> = (0..5).map(|i| if i < k { speed } else { 0.0 }).collect();
                let mut group = Group::row(&[mass; 5], &speeds, 1.0);
                let response = group.resolve(ImpactLaw::Reflection);
                let expected: Vec<f64> = speeds.iter().rev().copied().collect();
                assert_eq!(group.speeds(), expected);
                assert_eq!(response.restitution_energy, 0.0);
                assert!(!response.cut_short);
            }
        }
    }
}

#[test]
fn one_ball_into_two_follows_the_closed_form_and_its_mirror_image() {
    let (s, c) = (0.5, 0.75f64.sqrt());
    for v in [1.0, 0.37] {
        let mut group = Group {
            contacts: vec![
                pair(0, 1, vec(c, s, 0.0), 1.0),
                pair(0, 2, vec(c, -s, 0.0), 1.0),
                pair(1, 2, vec(0.0, -1.0, 0.0), 1.0),
            ],
            masses: vec![1.0; 3],
            velocities: vec![vec(v, 0.0, 0.0), DVec3::ZERO, DVec3::ZERO],
        };
        let response = group.resolve(ImpactLaw::Reflection);
        let [hit, up, down] = group.velocities[..] else { unreachable!() };
        // Two roundings each.
        assert_close(hit.x, -v / 5.0, 2.0 * f64::EPSILON * v);
        let out = 2.0 * 3f64.sqrt() / 5.0 * v;
        assert_close_vec(up, out * vec(c, s, 0.0), 3.0 * f64::EPSILON * v);
        assert_eq!([hit.y, hit.z], [0.0, 0.0]);
        assert_eq!(up, vec(down.x, -down.y, down.z));
        assert_eq!(response.impulses[0], response.impulses[1]);
    }
}

#[test]
fn single_contact_is_answered_as_by_line_of_centres() {
    let mut numbers = Numbers(1);
    for law in LAWS {
        for _ in 0..300 {
            let (normal, e) = (numbers.unit_vector(), numbers.next());
            let masses = [numbers.between(0.1, 10.0), numbers.between(0.1, 10.0)];
            let velocities = [numbers.vector(), numbers.vector()];
            let mut after = velocities;
            let response = resolve(law, &[pair(0, 1, normal, e)], &masses, &mut after);
            match line_of_centres(velocities, masses, normal, e) {
                Some((expected, impulse)) => {
                    assert_close_vec(after[0], expected[0], ROUNDING);
                    assert_close_vec(after[1], expected[1], ROUNDING);
                    assert_close(response.impulses[0], impulse, ROUNDING * impulse);
                }
                None => assert_eq!(after, velocities),
            }
        }
    }
}

#[test]
fn contacts_far_apart_each_follow_their_own_restitution() {
    // Light balls fall on a floor that is one body for all of them: nearly so is a heavy sphere.
    let heavy = 1e9;
    let normals = [DVec3::X, DVec3::Y, DVec3::Z];
    let restitutions = [0.0, 0.3, 1.0];
    for law in LAWS {
        let contacts =
            (0..3).map(|i| pair(0, i + 1, normals[i], restitutions[i])).collect::<Vec<_>>();
        let mut velocities = vec![DVec3::ZERO];
        velocities.extend(normals.iter().map(|n| -*n));
        resolve(law, &contacts, &[heavy, 1.0, 1.0, 1.0], &mut velocities);
        for i in 0..3 {
            // The heavy one moves by about the ratio of masses.
            assert_close_vec(velocities[i + 1], restitutions[i] * normals[i], 4.0 / heavy);
        }
    }
}

#[test]
fn heaps_obey_every_law() {
    let mut numbers = Numbers(2);
    let restitutions: [(&str, fn(usize) -> f64); 5] = [
        ("plastic", |_| 0.0),
        ("half", |_| 0.5),
        ("elastic", |_| 1.0),
        ("mixed", |i| [0.0, 0.5, 1.0][i % 3]),
        ("all different", |i| (i % 101) as f64 / 100.0),
    ];
    for (name, e) in restitutions {
        let before = Group::heap(200, &mut numbers, e);
        for law in LAWS {
            let mut after = before.clone();
            let clock = std::time::Instant::now();
            let response = after.resolve(law);
            let what = format!("{name}, {law:?}, {} contacts", before.contacts.len());
            println!(
                "{what}: {:?} dE {:e}/{:e} off {:e} closing {:e} cut {}",
                clock.elapsed(),
                after.energy() - before.energy(),
                before.energy(),
                after.energy() - before.energy() - response.restitution_energy,
                after.worst_closing(),
                response.cut_short
            );
            assert_lawful(&before, &after, &response, &what);
        }
    }
}

#[test]
fn small_random_groups_obey_every_law() {
    let mut numbers = Numbers(3);
    for round in 0..300 {
        let count = 2 + (8.0 * numbers.next()) as usize;
        let choice = round % 4;
        let shift = numbers.0 as usize;
        let e = move |i: usize| match choice {
            0 => 1.0,
            1 => 0.6,
            2 => [0.0, 1.0][(i + shift) % 2],
            _ => ((7 * i + shift) % 11) as f64 / 10.0,
        };
        let mut before = Group::heap(count, &mut numbers, e);
        for mass in &mut before.masses {
            *mass = 10f64.powf(numbers.between(-1.5, 1.5));
        }
        for law in LAWS {
            let mut after = before.clone();
            let response = after.resolve(law);
            assert_lawful(&before, &after, &response, &format!("{law:?}, round {round}"));
        }
    }
}

#[test]
fn renumbering_and_mirroring_change_no_bit() {
    let mut numbers = Numbers(4);
    for round in 0..60 {
        let e = move |i: usize| if round % 2 == 0 { 1.0 } else { [0.2, 0.8, 1.0][i % 3] };
        let group = Group::heap(12, &mut numbers, e);
        let n = group.masses.len();
        // A permutation of the spheres, another of the contacts, and z mirrored.
        let mut new_of_old: Vec<usize> = (0..n).collect();
        for i in (1..n).rev() {
            new_of_old.swap(i, (numbers.next() * (i + 1) as f64) as usize);
        }
        let mut other = group.clone();
        let mirrored = |v: DVec3| vec(v.x, v.y, -v.z);
        for old in 0..n {
            other.velocities[new_of_old[old]] = mirrored(group.velocities[old]);
            other.masses[new_of_old[old]] = group.masses[old];
        }
        for contact in &mut other.contacts {
            contact.normal = mirrored(contact.normal);
            contact.first = contact.first.map(|old| new_of_old[old]);
            contact.second = new_of_old[contact.second];
            // Body 1 is the one of the smaller number.
            if contact.first.is_some_and(|first| first > contact.second) {
                let first = contact.first.replace(contact.second).unwrap();
                contact.second = first;
                contact.normal = -contact.normal;
            }
        }
        other.contacts.sort_by_key(|contact| (contact.first, contact.second));
        for law in SYMMETRIC {
            let (mut a, mut b) = (group.clone(), other.clone());
            a.resolve(law);
            b.resolve(law);
            for old in 0..n {
                assert_eq!(mirrored(a.velocities[old]), b.velocities[new_of_old[old]], "{law:?}");
            }
        }
    }
}

/// Centres of a triangular rack of unit balls in the xz plane, rows along x, symmetric in z.
fn rack(rows: usize) -> Vec<DVec3> {
    let mut centres = Vec::new();
    for row in 0..rows {
        for k in 0..=row {
            let z = k as f64 - 0.5 * row as f64;
            centres.push(vec(0.75f64.sqrt() * row as f64, 0.0, z));
        }
    }
    centres
}

#[test]
fn pool_break_is_symmetric_to_the_last_bit() {
    let mut centres = vec![vec(-1.0, 0.0, 0.0)];
    centres.extend(rack(5));
    for (law, e) in [(ImpactLaw::Reflection, 1.0), (ImpactLaw::Reflection, 0.93)]
        .into_iter()
        .chain([(ImpactLaw::Simultaneous, 1.0), (ImpactLaw::Simultaneous, 0.93)])
    {
        let mut before = Group::touching(&centres, false, 1e-9, |_| e);
        before.velocities[0] = vec(10.0, 0.0, 0.0);
        let mut after = before.clone();
        let response = after.resolve(law);
        assert_lawful(&before, &after, &response, &format!("{law:?}"));
        let mirror = |i: usize| {
            let c = centres[i];
            centres.iter().position(|d| *d == vec(c.x, c.y, -c.z)).unwrap()
        };
        for i in 0..centres.len() {
            let (a, b) = (after.velocities[i], after.velocities[mirror(i)]);
            assert_eq!(a, vec(b.x, b.y, -b.z), "{law:?}, ball {i}");
        }
        assert!(after.velocities.iter().any(|v| v.z != 0.0));
    }
}

#[test]
fn lattice_with_redundant_contacts_is_hit_symmetrically() {
    // 3 x 3 x 3 balls; one hits the middle of a face from outside.
    let mut centres = vec![vec(-2.0, 0.0, 0.0)];
    for x in -1..=1 {
        for y in -1..=1 {
            for z in -1..=1 {
                centres.push(vec(x as f64, y as f64, z as f64));
            }
        }
    }
    for law in SYMMETRIC {
        for e in [0.0, 0.5, 1.0] {
            let mut before = Group::touching(&centres, false, 1e-9, |_| e);
            before.velocities[0] = vec(1.0, 0.01, 0.0);
            let mut after = before.clone();
            let response = after.resolve(law);
            assert_lawful(&before, &after, &response, &format!("{law:?}, e = {e}"));
            assert!(after.velocities.iter().all(|v| v.z == 0.0));
        }
    }
    // Pressed together from all sides: as redundant as can be.
    let mut before = Group::touching(&centres[1..], false, 1e-9, |_| 1.0);
    for (velocity, centre) in before.velocities.iter_mut().zip(&centres[1..]) {
        *velocity = -*centre;
    }
    for law in LAWS {
        let mut after = before.clone();
        let response = after.resolve(law);
        assert_lawful(&before, &after, &response, &format!("pressed, {law:?}"));
    }
}

#[test]
fn rows_of_unequal_masses_conserve_energy_and_momentum() {
    let mut numbers = Numbers(5);
    for round in 0..200 {
        let count = 3 + round % 8;
        let masses: Vec<f64> = (0..count).map(|_| 10f64.powf(numbers.between(-1.0, 1.0))).collect();
        let speeds: Vec<f64> = (0..count).map(|_| numbers.between(-1.0, 1.0)).collect();
        let before = Group::row(&masses, &speeds, 1.0);
        let mut after = before.clone();
        let response = after.resolve(ImpactLaw::Reflection);
        assert_lawful(&before, &after, &response, &format!("round {round}"));
        assert!(!response.cut_short);
        assert_close(after.energy(), before.energy(), 1e-13 * before.energy());
    }
}

#[test]
fn mass_ratios_of_a_trillion_are_survived() {
    let mut numbers = Numbers(6);
    for e in [0.0, 0.5, 1.0] {
        for round in 0..STRESS {
            let masses: Vec<f64> = (0..5).map(|_| 10f64.powf(numbers.between(-6.0, 6.0))).collect();
            let speeds: Vec<f64> = (0..5).map(|_| numbers.between(-1.0, 1.0)).collect();
            let mut before = Group::row(&masses, &speeds, e);
            before.contacts.push(surface(0, DVec3::X, e));
            for law in LAWS {
                let mut after = before.clone();
                let response = after.resolve(law);
                let what = format!("{law:?}, e = {e}, round {round}, {masses:?} {speeds:?}");
                // A thousand impacts that reverse everything add up their roundings.
                assert_lawful_within(2e-12, &before, &after, &response, &what);
            }
        }
    }
}

#[test]
fn galperins_billiard_bounces_as_often_as_pi_says() {
    // A heavy ball pushes a light one at a wall, all touching: each meeting is one reflection.
    for (k, count) in [(0, 3), (1, 31), (2, 314)] {
        let mut group = Group::row(&[1.0, 100f64.powi(k)], &[0.0, -1.0], 1.0);
        group.contacts.push(surface(0, DVec3::X, 1.0));
        let before = group.energy();
        let response = group.resolve(ImpactLaw::Reflection);
        assert!(!response.cut_short, "{count} reflections");
        assert_close(group.energy(), before, 1e-13 * before);
    }
}

#[test]
fn heavy_ball_on_a_light_one_bounces_even_past_the_bound_of_reflections() {
    for heavy in [1e8, 1e12] {
        let mut group = Group::row(&[1.0, heavy], &[0.0, -1.0], 1.0);
        group.contacts.push(surface(0, DVec3::X, 1.0));
        let before = group.clone();
        let response = group.resolve(ImpactLaw::Reflection);
        assert!(response.cut_short);
        assert_close(group.velocities[1].x, 1.0, 1e-3);
        assert_close(group.energy(), before.energy(), 1e-13 * before.energy());
    }
}

#[test]
fn sphere_wedged_between_walls_stops() {
    for law in LAWS {
        for e in [0.0, 0.5, 1.0] {
            let mut group = Group {
                contacts: vec![surface(0, DVec3::X, e), surface(0, -DVec3::X, e)],
                masses: vec![2.0],
                velocities: vec![vec(0.7, 0.2, 0.0)],
            };
            let before = group.clone();
            let response = group.resolve(law);
            assert_lawful(&before, &group, &response, &format!("{law:?}, e = {e}"));
            assert_eq!(group.velocities[0].y, 0.2);
        }
    }
}

#[test]
fn dead_pair_on_an_elastic_floor_bounces_together() {
    // Both fall onto the floor as one; the pair is plastic, the floor elastic.
    for law in SYMMETRIC {
        let mut group = Group {
            contacts: vec![surface(0, DVec3::Y, 1.0), pair(0, 1, DVec3::Y, 0.0)],
            masses: vec![1.0, 5.0],
            velocities: vec![-DVec3::Y; 2],
        };
        group.resolve(law);
        for velocity in group.velocities {
            assert_close_vec(velocity, DVec3::Y, ROUNDING);
        }
    }
}

#[test]
fn uniform_restitution_blends_the_elastic_and_the_plastic_answer() {
    let mut group = Group::row(&[1.0; 5], &[1.0, 0.0, 0.0, 0.0, 0.0], 0.5);
    let before = group.energy();
    let response = group.resolve(ImpactLaw::Reflection);
    for (speed, expected) in group.speeds().into_iter().zip([0.1, 0.1, 0.1, 0.1, 0.6]) {
        assert_close(speed, expected, ROUNDING);
    }
    assert_close(group.energy() - before, response.restitution_energy, ROUNDING);
}

#[test]
fn newtons_law_at_once_reflects_a_cradle_as_the_complementarity_problem_says() {
    // All contacts must open as fast as they closed: 1 and 0, 0, 0.
    let mut group = Group::row(&[1.0; 4], &[1.0, 0.0, 0.0, 0.0], 1.0);
    group.resolve(ImpactLaw::Simultaneous);
    for (speed, expected) in group.speeds().into_iter().zip([-0.5, 0.5, 0.5, 0.5]) {
        assert_close(speed, expected, ROUNDING);
    }
}

#[test]
fn moving_surface_is_felt_in_its_own_frame() {
    let drift = vec(0.3, 5.0, -2.0);
    let mut numbers = Numbers(8);
    for law in LAWS {
        for e in [0.0, 0.5, 1.0] {
            let still = Group::heap(6, &mut numbers, |_| e);
            let mut moving = still.clone();
            for contact in &mut moving.contacts {
                contact.surface_velocity = drift;
            }
            moving.velocities.iter_mut().for_each(|v| *v += drift);
            let before = moving.clone();
            let mut still = still;
            let (a, b) = (still.resolve(law), moving.resolve(law));
            for (v, w) in still.velocities.iter().zip(&moving.velocities) {
                // Rounding of the faster speeds, through the passes of a small heap.
                assert_close_vec(*v + drift, *w, 1e-12);
            }
            assert_close(a.restitution_energy, b.restitution_energy, 1e-12 * before.energy());
            let change = moving.energy() - before.energy();
            assert_close(change, b.restitution_energy + b.surface_work, 1e-13 * before.energy());
        }
    }
}

#[test]
fn nothing_moves_where_nothing_closes() {
    for law in LAWS {
        let mut group = Group::row(&[1.0; 3], &[-1.0, 0.0, 0.5], 1.0);
        let before = group.velocities.clone();
        assert_eq!(group.resolve(law).impulses, [0.0, 0.0]);
        assert_eq!(group.velocities, before);
    }
}

#[test]
fn extreme_numbers_do_no_harm() {
    for law in LAWS {
        for speed in [1e-310, 1e-200, 1e200, 1e308, f64::INFINITY, f64::NAN, 0.0] {
            for e in [0.0, 0.5, 1.0] {
                let mut group = Group::row(&[1e-200, 1.0, 1e200], &[speed, 0.0, -speed], e);
                group.resolve(law);
                // Twice the largest number is none.
                let representable = speed.is_finite() && speed.abs() < 1e308;
                let finite = group.velocities.iter().all(|v| v.is_finite());
                assert!(finite || !representable, "{law:?}, {speed}, {e}");
            }
        }
        resolve(law, &[], &[], &mut []);
    }
}

#[test]
fn stack_of_ten_weighs_on_the_floor_tenfold() {
    let (mass, g) = (0.3, 9.81);
    let mut contacts = vec![surface(0, DVec3::Y, 0.5)];
    contacts.extend((1..10).map(|i| pair(i - 1, i, DVec3::Y, 0.5)));
    let mut accelerations = vec![vec(0.0, -g, 0.0); 10];
    let forces = contact_forces(&contacts, &[mass; 10], &mut accelerations, &[0.0; 10]);
    for (i, force) in forces.iter().enumerate() {
        let weight = (10 - i) as f64 * mass * g;
        assert_close(*force, weight, ROUNDING * weight);
    }
    for acceleration in accelerations {
        assert_close_vec(acceleration, DVec3::ZERO, ROUNDING * g);
    }
}

#[test]
fn force_on_a_pyramid_follows_statics() {
    // One ball on two, on a floor, held apart by walls: the upper contacts at 30 degrees from
    // the vertical carry m g / (2 cos 30), the walls half of it, the floor 3/2 m g.
    let (s, c) = (0.5, 0.75f64.sqrt());
    let contacts = [
        surface(0, DVec3::X, 1.0),
        surface(0, DVec3::Y, 1.0),
        surface(1, -DVec3::X, 1.0),
        surface(1, DVec3::Y, 1.0),
        pair(0, 1, DVec3::X, 1.0),
        pair(0, 2, vec(s, c, 0.0), 1.0),
        pair(1, 2, vec(-s, c, 0.0), 1.0),
    ];
    let mut accelerations = [vec(0.0, -10.0, 0.0); 3];
    let forces = contact_forces(&contacts, &[2.0; 3], &mut accelerations, &[0.0; 7]);
    let along = 20.0 / (2.0 * c);
    let expected = [along * s, 30.0, along * s, 30.0, 0.0, along, along];
    for (force, expected) in forces.into_iter().zip(expected) {
        assert_close(force, expected, 20.0 * ROUNDING);
    }
    accelerations.into_iter().for_each(|a| assert_close_vec(a, DVec3::ZERO, 10.0 * ROUNDING));
}

#[test]
fn sphere_that_leaves_a_contact_gets_no_force() {
    // Sliding over a fixed sphere so fast that gravity does not hold it: v²/R > g.
    let contacts = [surface(0, DVec3::Y, 1.0)];
    let gravity = vec(0.0, -10.0, 0.0);
    let mut accelerations = [gravity];
    assert_eq!(contact_forces(&contacts, &[2.0], &mut accelerations, &[11.0]), [0.0]);
    assert_eq!(accelerations, [gravity]);
    // Slower, it is held by what is left of its weight.
    let forces = contact_forces(&contacts, &[2.0], &mut accelerations, &[4.0]);
    assert_close(forces[0], 12.0, 12.0 * ROUNDING);
    assert_close(accelerations[0].y, -4.0, 4.0 * ROUNDING);
}

#[test]
fn forces_in_a_heap_hold_it_and_do_not_pull() {
    let mut numbers = Numbers(9);
    let mut group = Group::heap(200, &mut numbers, |_| 0.0);
    group.velocities.fill(vec(0.0, -9.81, 0.0));
    let bias: Vec<f64> = group.contacts.iter().map(|_| numbers.next()).collect();
    let forces = contact_forces(&group.contacts, &group.masses, &mut group.velocities, &bias);
    for ((contact, bias), force) in group.contacts.iter().zip(&bias).zip(&forces) {
        let w = group.opening(contact) + bias;
        // Speeds here are accelerations of up to 10 m/s².
        assert!(w >= -1e-13 * 10.0, "closes at {w}");
        assert!(*force >= 0.0);
        assert!(*force == 0.0 || w <= 1e-13 * 10.0, "pushes a contact that opens at {w}");
    }
}
