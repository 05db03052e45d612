//! Pieces: a large island in shorter times, in each of which it falls apart into small ones.

use super::course::Course;
use super::island::{Island, MOST_BODIES, REACH};
use super::link::{Link, Role};
use crate::connected::Connected;
use crate::rule::contact::places::Places;
use crate::rule::contact::sub_step::SubStep;

/// The shortest pieces are the sub-step halved this many times.
const MOST_HALVINGS: u32 = 6;

/// Advances an island through a sub-step. Returns its events; `None` for an island that stays large in the shortest
/// pieces, which is not followed.
pub fn follow(island: &mut Island, places: &Places, sub_step: &SubStep) -> Option<Course> {
    if !island.is_small() && !falls_apart(island, places, sub_step) {
        return None;
    }
    let mut course = Course::default();
    let time = (sub_step.h, sub_step);
    advance(&mut course, island, places, time, MOST_HALVINGS).then_some(course)
}

/// Advances an island through a time \[s\] of a sub-step, in halves where it is large. Returns whether that succeeds.
fn advance(
    course: &mut Course,
    island: &mut Island,
    places: &Places,
    (time, sub_step): (f64, &SubStep),
    halvings: u32,
) -> bool {
    if island.is_small() {
        course.run(island, places, (time, sub_step));
        return true;
    }
    let half = 0.5 * time;
    halvings > 0
        && (0..2).all(|_| {
            parts(island, places, half).into_iter().all(|mut part| {
                let piece = (half, sub_step);
                let is_followed = advance(course, &mut part.island, places, piece, halvings - 1);
                part.put_back(island);
                is_followed
            })
        })
}

/// A part of an island that the rest does not reach in a piece.
#[derive(Debug, Default)]
struct Part {
    island: Island,
    /// Places of its bodies and of its links in the whole.
    bodies: Vec<usize>,
    links: Vec<usize>,
}

impl Part {
    /// Writes the states of its bodies and links into the whole.
    fn put_back(&self, whole: &mut Island) {
        for (&place, body) in self.bodies.iter().zip(&self.island.bodies) {
            whole.bodies[place] = *body;
        }
        for (&place, link) in self.links.iter().zip(&self.island.links) {
            let Link { first, second, .. } = whole.links[place];
            whole.links[place] = link.between(first, second);
        }
    }

    /// Adds a body of the whole. Returns its place.
    fn add(&mut self, whole: &Island, place: usize) -> usize {
        self.bodies.push(place);
        self.island.bodies.push(whole.bodies[place]);
        self.bodies.len() - 1
    }
}

/// The parts of an island in a time \[s\]. Each has its own copies of the sleeping bodies that it reaches.
fn parts(island: &mut Island, places: &Places, time: f64) -> Vec<Part> {
    let near = near_links(island, places, time);
    let mut connected = connected(island, &near);
    let is_awake = |body: usize| island.bodies[body].is_awake();
    let mut parts: Vec<Part> = Vec::new();
    // The part of each body that is awake, and its place there.
    let mut homes = vec![(0, 0); island.bodies.len()];
    for body in (0..homes.len()).filter(|&body| is_awake(body)) {
        let root = connected.root_of(body);
        if root == body {
            parts.push(Part::default());
            homes[body] = (parts.len() - 1, 0);
        }
        let number = homes[root].0;
        homes[body] = (number, parts[number].add(island, body));
    }
    for number in near {
        let link = island.links[number];
        let ends = [Some(link.second), link.first].into_iter().flatten();
        let Some(own) = ends.into_iter().find(|&it| is_awake(it)) else { continue };
        let part = &mut parts[homes[own].0];
        let mut place = |body| if is_awake(body) { homes[body].1 } else { part.add(island, body) };
        let (first, second) = (link.first.map(&mut place), place(link.second));
        part.links.push(number);
        part.island.links.push(link.between(first, second));
    }
    parts
}

/// Whether the parts of an island are small at the start of the shortest piece.
fn falls_apart(island: &mut Island, places: &Places, sub_step: &SubStep) -> bool {
    let near = near_links(island, places, sub_step.h / f64::from(1_u32 << MOST_HALVINGS));
    let mut connected = connected(island, &near);
    let mut sizes = vec![0; island.bodies.len()];
    (0..sizes.len()).for_each(|body| sizes[connected.root_of(body)] += 1);
    sizes.into_iter().all(|size| size <= MOST_BODIES)
}

/// The sets of bodies that these links connect; a sleeping body connects none.
fn connected(island: &Island, near: &[usize]) -> Connected {
    let is_awake = |body: usize| island.bodies[body].is_awake();
    let mut connected = Connected::new(island.bodies.len());
    for &number in near {
        let Link { first, second, .. } = island.links[number];
        if let Some(first) = first.filter(|&first| is_awake(first) && is_awake(second)) {
            connected.join(first, second);
        }
    }
    connected
}

/// The links of an island that act or may close in a time \[s\]; the others are switched off.
fn near_links(island: &mut Island, places: &Places, time: f64) -> Vec<usize> {
    let reach = REACH * time * island.top_speed();
    let Island { bodies, links } = island;
    let mut near = Vec::new();
    for (number, link) in links.iter_mut().enumerate() {
        let is_there = link.measure(bodies, places);
        if link.bears || (is_there && link.gap <= reach) {
            near.push(number);
        } else {
            link.set(Role::Off, 0.0);
        }
    }
    near
}
