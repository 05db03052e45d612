//! Impact laws and contact forces for groups of bodies that touch at one instant, against closed
//! forms and against the properties that Smith et al. (2012) demand of an impact operator.
//!
//! Geometry is made here, so these say nothing about detection.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

#[path = "../common/mod.rs"]
mod common;
mod extremes;

use carom::respond::{GroupResponse, line_of_centres, reflection, resolve};
use carom::{DVec3, ImpactLaw};
use common::group::{Group, pair, surface};
use common::{Numbers, assert_close, assert_close_vec, vec};

const LAWS: [ImpactLaw; 3] =
    [ImpactLaw::Sequential, ImpactLaw::Simultaneous, ImpactLaw::Reflection];

const SYMMETRIC: [ImpactLaw; 2] = [ImpactLaw::Simultaneous, ImpactLaw::Reflection];

/// Roundings: results of a handful of operations on numbers of order 1.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

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
fn single_contact_is_answered_to_the_bit_as_by_the_law_for_one() {
    let mut numbers = Numbers(1);
    for law in LAWS {
        for _ in 0..300 {
            let (normal, e) = (numbers.unit_vector(), numbers.next());
            let masses = [numbers.between(0.1, 10.0), numbers.between(0.1, 10.0)];
            let before = [numbers.vector(), numbers.vector()];
            let mut after = before;
            let response = resolve(law, &[pair(0, 1, normal, e)], &masses, &mut after);
            let (expected, impulse) =
                line_of_centres(before, masses, normal, e).unwrap_or((before, 0.0));
            assert_eq!(after, expected);
            assert_eq!(response.impulses, [impulse]);

            let mut after = [before[0]];
            resolve(law, &[surface(0, normal, e)], &masses[..1], &mut after);
            let change = reflection(before[0], normal, e).unwrap_or(0.0);
            assert_eq!(after[0], before[0] + change * normal);
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

/// Restitution of each contact of a group.
type Restitution = fn(usize) -> f64;

const RESTITUTIONS: [(&str, Restitution); 5] = [
    ("plastic", |_| 0.0),
    ("half", |_| 0.5),
    ("elastic", |_| 1.0),
    ("mixed", |contact| [0.0, 0.5, 1.0][contact % 3]),
    ("all different", |contact| (contact % 101) as f64 / 100.0),
];

/// Checks what every law makes of a group, without a bound of work.
fn assert_obeys_every_law(before: &Group, name: &str) {
    for law in LAWS {
        let mut after = before.clone();
        let response = after.resolve(law);
        assert_lawful(before, &after, &response, &format!("{name}, {law:?}"));
        assert!(!response.cut_short);
    }
}

#[test]
fn heaps_obey_every_law() {
    let mut numbers = Numbers(2);
    for (name, e) in RESTITUTIONS {
        let before = Group::heap(200, &mut numbers, e);
        assert_obeys_every_law(&before, name);
    }
}

#[test]
fn packings_full_of_redundant_contacts_obey_every_law() {
    let mut numbers = Numbers(2);
    for (name, e) in RESTITUTIONS {
        let before = Group::packing(6, &mut numbers, e);
        assert!(before.contacts.len() > 3 * before.masses.len(), "not redundant");
        assert_obeys_every_law(&before, name);
    }
}

#[test]
fn heaps_of_unlike_masses_obey_every_law() {
    let mut numbers = Numbers(77);
    for decades in [2.0, 4.0, 6.0, 9.0, 12.0] {
        for (name, e) in RESTITUTIONS {
            let mut before = Group::heap(40, &mut numbers, e);
            for mass in &mut before.masses {
                *mass = 10f64.powf(numbers.between(0.0, decades));
            }
            for law in LAWS {
                let mut after = before.clone();
                let response = after.resolve(law);
                let what = format!("{name}, {law:?}, {decades} decades");
                // Hundreds of impacts of the heaviest.
                assert_lawful_within(1e-12, &before, &after, &response, &what);
            }
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
        for (old, &new) in new_of_old.iter().enumerate() {
            other.velocities[new] = mirrored(group.velocities[old]);
            other.masses[new] = group.masses[old];
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
            for (old, &new) in new_of_old.iter().enumerate() {
                assert_eq!(mirrored(a.velocities[old]), b.velocities[new], "{law:?}");
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
fn galperins_billiard_bounces_as_often_as_pi_says() {
    // A heavy ball pushes a light one at a wall, all touching, and each meeting is a reflection.
    // A meeting of the balls and one with the wall together turn (√M V, √m v) by 2 atan √(m/M).
    for (ratio, meetings) in [(1.0, 3), (100.0, 31), (10_000.0, 314)] {
        let mut group = Group::row(&[1.0, ratio], &[0.0, -1.0], 1.0);
        group.contacts.push(surface(0, DVec3::X, 1.0));
        let before = group.energy();
        let response = group.resolve(ImpactLaw::Reflection);
        assert!(!response.cut_short);
        let of_balls = (meetings + 1) / 2;
        let angle = 2.0 * f64::from(of_balls) * (1.0 / ratio).sqrt().atan();
        // A rounding or two for each meeting.
        assert_close(group.velocities[1].x, -angle.cos(), 1e-13);
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
