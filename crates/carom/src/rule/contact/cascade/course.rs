//! The course of a cascade: flights, and impacts between them.

use glam::{DMat3, DVec3};

use super::body::Body;
use super::island::Island;
use super::link::{Link, Role};
use super::met::{Contact, Met, Partners};
use crate::contact_time;
use crate::flight::Flight;
use crate::rule::contact::contacts::swept::FAR;
use crate::rule::contact::places::Places;
use crate::rule::contact::report::virial::of_contact;
use crate::rule::contact::sub_step::SubStep;

/// Largest number of impacts per sphere of an island; later ones are answered together.
const MOST_IMPACTS: usize = 8;
/// Largest number of searches for the next meeting of a link: each impact searches all links.
const MOST_LOOKS: usize = 20_000;
/// Largest number of links that a cascade solves, one after the other.
const MOST_VISITS: u32 = 100_000;
/// Accuracy of impacts: their error is a loss or gain of energy.
const OF_IMPACTS: Accuracy = Accuracy { part: 1e-12, visits: 20_000 };
/// Accuracy of contact forces in a flight: a sub-step of the rule has a larger error.
const OF_FLIGHTS: Accuracy = Accuracy { part: 1e-7, visits: 2_000 };
/// Bodies touch whose gap is below this part of the sum of radii.
const TOUCH: f64 = 1e-6;
/// Gains up to this part of the kinetic energy are rounding.
const ROUNDING: f64 = 1e-14;

/// The accuracy of impulses.
#[derive(Clone, Copy)]
struct Accuracy {
    /// Largest change of an impulse in the last sweep, as a part of the largest impulse.
    part: f64,
    /// Largest number of links to solve, one after the other: with friction, sweeps may never end.
    visits: u32,
}

/// The events of a cascade.
pub struct Course {
    /// Work of all impulses \[J\].
    pub work: f64,
    /// Σ J l of all impulses \[N m s\].
    pub virial: DMat3,
    pub impacts: Vec<Met>,
    visits: u32,
}

impl Default for Course {
    fn default() -> Self {
        // The default of a matrix is that of identity.
        Self { work: 0.0, virial: DMat3::ZERO, impacts: Vec::new(), visits: 0 }
    }
}

impl Course {
    /// Advances an island through a time \[s\] of a sub-step.
    pub fn run(&mut self, island: &mut Island, places: &Places, (time, sub_step): (f64, &SubStep)) {
        self.visits = 0;
        let most_by_looks = MOST_LOOKS / island.links.len().max(1);
        let most = (MOST_IMPACTS * island.bodies.len()).min(most_by_looks);
        let mut left = time;
        for number in 0.. {
            let is_last = number >= most || self.visits >= MOST_VISITS;
            expect(island, places, (left, sub_step), is_last);
            self.fly(island, left);
            let meeting = first_meeting(island, places, left);
            let Some(time) = meeting.filter(|_| !is_last) else { break };
            if time > 0.0 {
                self.fly(island, time);
                self.arrive(island, time);
                left -= time;
            } else {
                restart(island);
            }
            self.meet(island, places, time);
            if left <= 0.0 {
                break;
            }
        }
        self.arrive(island, left.max(0.0));
        island.links.iter_mut().for_each(|link| link.last = left);
    }

    /// Computes the velocities after a flight of a time \[s\], with the contact forces of its links.
    fn fly(&mut self, island: &mut Island, time: f64) {
        for body in &mut island.bodies {
            (body.velocity, body.spin) = (body.accelerated(time), body.start[1]);
        }
        for link in &mut island.links {
            link.impulses = Default::default();
        }
        self.solve(island, OF_FLIGHTS);
    }

    /// Sweeps over the links until their impulses have this accuracy.
    fn solve(&mut self, island: &mut Island, accuracy: Accuracy) {
        let Island { bodies, links } = island;
        let mut bearing: Vec<&mut Link> =
            links.iter_mut().filter(|link| link.role == Role::Bears).collect();
        let from = self.visits;
        while self.visits - from < accuracy.visits {
            let (mut change, mut largest) = (0.0_f64, 0.0_f64);
            for link in &mut bearing {
                change = change.max(link.solve(bodies));
                largest = largest.max(link.impulses.normal);
            }
            self.visits += bearing.len() as u32;
            if bearing.is_empty() || change <= accuracy.part * largest {
                return;
            }
        }
    }

    /// Moves the bodies to the end of a flight of a time \[s\].
    fn arrive(&mut self, island: &mut Island, time: f64) {
        let touched = touched(island);
        for (body, touched) in island.bodies.iter_mut().zip(touched) {
            self.work += work(body, body.accelerated(time));
            body.add_way(time);
            let path = path(body, touched, time);
            body.from = std::mem::replace(&mut body.position, path.after(time).0);
            body.start = [body.velocity, body.spin];
            body.bears = touched;
        }
        if time > 0.0 {
            self.work += image_work(&island.links);
            self.virial += virial(&island.links);
        }
        for link in &mut island.links {
            link.bears = link.role == Role::Bears && link.impulses.normal > 0.0;
            if link.bears && link.first.is_none() {
                island.bodies[link.second].met_surface = true;
            }
        }
    }

    /// Answers the impacts of bodies that meet after a time of their flight \[s\], and of what touches them.
    fn meet(&mut self, island: &mut Island, places: &Places, time: f64) {
        let Island { bodies, links } = island;
        for link in &mut *links {
            let (was_awaited, bore) = (link.role == Role::Awaited, link.bears);
            if !link.measure(bodies, places) {
                link.set(Role::Off, 0.0);
                continue;
            }
            let touches = link.gap <= TOUCH * link.size();
            let closing = link.closing(bodies);
            if was_awaited && closing > 0.0 && (link.time == time || touches) {
                link.strike(bodies, closing);
            } else if bore || touches {
                link.set(Role::Bears, 0.0);
            } else {
                link.set(Role::Off, 0.0);
            }
        }
        let before = kinetic_energy(bodies);
        self.solve(island, OF_IMPACTS);
        let part = take_gain(island, before);
        let Island { bodies, links } = island;
        self.work += part * image_work(links);
        self.virial += part * virial(links);
        self.work += bodies.iter().map(|body| work(body, body.start[0])).sum::<f64>();
        for link in &mut *links {
            if link.approach > 0.0 && link.impulses.normal > 0.0 {
                self.impacts.push(met(link, bodies));
            }
            // Bodies that bounce may meet again; others stay together.
            link.bears = link.bias >= 0.0 && (link.bears || link.impulses.normal > 0.0);
            if link.first.is_none() && link.impulses.normal > 0.0 {
                bodies[link.second].met_surface = true;
            }
        }
        bodies.iter_mut().for_each(|body| body.start = [body.velocity, body.spin]);
    }
}

/// Sets the role of each link in a flight of at most this time \[s\]; in the last flight, none awaits a meeting.
fn expect(island: &mut Island, places: &Places, (left, sub_step): (f64, &SubStep), is_last: bool) {
    let Island { bodies, links } = island;
    for link in links {
        let is_there = link.measure(bodies, places);
        let goes_far = left * link.velocity(bodies).length() > FAR * link.size();
        let room = link.gap.max(0.0) / left;
        if !is_there {
            link.set(if goes_far && !is_last { Role::Awaited } else { Role::Off }, 0.0);
            continue;
        }
        let closing = link.closing(bodies);
        let fall = 0.5 * link.pressing(bodies) * left;
        if link.bears || is_last {
            link.set(Role::Bears, room);
        } else if closing > link.threshold(bodies, sub_step) || (goes_far && link.gap > 0.0) {
            link.set(Role::Awaited, 0.0);
        } else if room > closing + fall {
            // On its parabola the body does not get as far as with its last velocity.
            link.set(Role::Bears, room + fall.max(0.0));
        } else {
            link.set(Role::Bears, room);
        }
    }
}

/// Time of the first meeting that a link awaits in a flight of a time \[s\].
fn first_meeting(island: &mut Island, places: &Places, time: f64) -> Option<f64> {
    let touched = touched(island);
    let bodies = &island.bodies;
    let path = |place: usize| path(&bodies[place], touched[place], time);
    let mut first = f64::INFINITY;
    for link in island.links.iter_mut().filter(|link| link.role == Role::Awaited) {
        let mut own = path(link.second);
        own.position += link.shift_at(bodies[link.second].elapsed);
        own.velocity += link.slide;
        let found = match link.first {
            Some(other) => contact_time::sphere_sphere(&path(other), &own, link.size(), time),
            None => {
                let (form, motion) = places.at_start(link.surface);
                contact_time::sphere_surface_in_reach(&own, link.size(), form, motion, time)
            }
        };
        link.time = found.unwrap_or(f64::INFINITY);
        first = first.min(link.time);
    }
    (first <= time).then_some(first)
}

/// Resets all bodies to the start of the flight.
fn restart(island: &mut Island) {
    for body in &mut island.bodies {
        [body.velocity, body.spin] = body.start;
    }
}

/// Whether a link has given each body an impulse.
fn touched(island: &Island) -> Vec<bool> {
    let mut touched = vec![false; island.bodies.len()];
    for link in island.links.iter().filter(|link| link.impulses.normal > 0.0) {
        touched[link.second] = true;
        if let Some(first) = link.first {
            touched[first] = true;
        }
    }
    touched
}

/// The path of a body in a flight of a time \[s\]: a parabola, or straight at its last velocity where links
/// touch it.
fn path(body: &Body, is_touched: bool, time: f64) -> Flight {
    let flight = Flight {
        position: body.position,
        velocity: body.start[0],
        acceleration: body.acceleration,
        drag_rate: 0.0,
    };
    if body.inverse_mass == 0.0 {
        Flight { velocity: DVec3::ZERO, acceleration: DVec3::ZERO, ..flight }
    } else if is_touched {
        Flight { velocity: body.velocity, acceleration: DVec3::ZERO, ..flight }
    } else if body.drag_rate > 0.0 && time > 0.0 {
        Flight { acceleration: (body.velocity - body.start[0]) / time, ..flight }
    } else {
        flight
    }
}

/// Work \[J\] of the impulses on a body with this velocity without them \[m/s\], by the mean of its velocities at
/// both ends.
fn work(body: &Body, without: DVec3) -> f64 {
    if body.inverse_mass == 0.0 {
        return 0.0;
    }
    let Body { velocity, spin, start, .. } = *body;
    let mut twice = (velocity - without).dot(velocity + start[0]) / body.inverse_mass;
    if body.inverse_inertia > 0.0 {
        twice += (spin - start[1]).dot(spin + start[1]) / body.inverse_inertia;
    }
    0.5 * twice
}

/// \[J\]
fn kinetic_energy(bodies: &[Body]) -> f64 {
    let of = |body: &Body| {
        if body.inverse_mass == 0.0 {
            return 0.0;
        }
        let linear = body.velocity.length_squared() / body.inverse_mass;
        let inertia = body.inverse_inertia;
        linear + if inertia > 0.0 { body.spin.length_squared() / inertia } else { 0.0 }
    };
    0.5 * bodies.iter().map(of).sum::<f64>()
}

/// Reduces the impulses of an impact where they would raise the kinetic energy above that of before \[J\]:
/// restitution in a group may. Returns the part of them that is left.
///
/// With the velocities v before and v + d after, the energy of `v + s d` is a parabola in s that begins
/// with a descent; s is the largest part that adds nothing.
fn take_gain(island: &mut Island, before: f64) -> f64 {
    let gain = kinetic_energy(&island.bodies) - before + image_work(&island.links);
    if gain <= ROUNDING * before {
        return 1.0;
    }
    let change = |body: &Body| Body {
        velocity: body.velocity - body.start[0],
        spin: body.spin - body.start[1],
        ..*body
    };
    let changes: Vec<Body> = island.bodies.iter().map(change).collect();
    let of_change = kinetic_energy(&changes);
    let part = if of_change > 0.0 { (1.0 - gain / of_change).clamp(0.0, 1.0) } else { 0.0 };
    for (body, change) in island.bodies.iter_mut().zip(&changes) {
        body.velocity = body.start[0] + part * change.velocity;
        body.spin = body.start[1] + part * change.spin;
    }
    part
}

/// Σ J l of the impulses of links between spheres \[N m s\].
fn virial(links: &[Link]) -> DMat3 {
    let pressing = |link: &&Link| link.first.is_some() && link.impulses.normal > 0.0;
    let of_link = |link: &Link| of_contact(link.impulse(), link.size() * link.normal);
    links.iter().filter(pressing).map(of_link).sum()
}

/// Work of impulses on sliding images beyond that on the spheres \[J\].
fn image_work(links: &[Link]) -> f64 {
    links.iter().filter(|link| link.slide != DVec3::ZERO).map(Link::image_work).sum()
}

/// The impact of a link.
fn met(link: &Link, bodies: &[Body]) -> Met {
    let second = bodies[link.second].slot;
    let partners = match link.first {
        Some(first) => Partners::Spheres([bodies[first].slot, second]),
        None => Partners::Surface(link.surface, second),
    };
    Met {
        bodies: partners,
        impact: Contact {
            point: link.point,
            normal: link.normal,
            approach_speed: link.approach,
            separation_speed: -link.closing(bodies),
            impulse: link.impulses.normal,
            tangential_impulse: DVec3::from_array(link.impulses.tangential),
        },
    }
}
