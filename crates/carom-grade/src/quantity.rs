//! Numbers of the course's rule that a program may have wrong.

use carom::DVec3;
use serde::Serialize;

use crate::course::{Acting, Course};

/// A number of the course's rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Quantity {
    /// Time by which a frame moves the balls \[s\].
    TimeStep,
    /// Length of a frame, and the time by which it moves the balls \[s\].
    FrameTime,
    /// Magnitude of the constant force \[N\].
    Force,
    /// Magnitude of gravity \[m/s²\].
    Gravity,
    /// Mass of the first ball \[kg\]; those of others change in proportion.
    Mass,
    /// Coefficient of viscous drag \[kg/s\].
    Drag,
    /// Restitution of one collider, by its number in the scene.
    RestitutionOf(usize),
    /// Restitution of all colliders.
    Restitution,
    /// Fraction of the tangential velocity that a bounce leaves.
    Tangential,
    /// Radius of the first ball \[m\]; those of others change in proportion.
    Radius,
    /// Velocity of balls at their start \[m/s\].
    Velocity,
    /// Period of an emitter, by its number in the scene \[s\].
    Period(usize),
}

/// A quantity with its value.
#[derive(Debug, Clone, PartialEq)]
pub struct Number {
    /// The quantity.
    pub quantity: Quantity,
    /// Values of the quantity: one, or three coordinates of a velocity.
    pub values: Vec<f64>,
}

impl Quantity {
    /// Returns the quantities that a course has.
    pub(crate) fn of(course: &Course) -> Vec<Self> {
        let has = |is: fn(&Acting) -> bool| course.forces.iter().any(is);
        let mut all = vec![Self::TimeStep, Self::FrameTime];
        if has(|it| matches!(it, Acting::Constant(force) if *force != DVec3::ZERO)) {
            all.push(Self::Force);
        }
        if has(|it| matches!(it, Acting::Gravity(acceleration) if *acceleration != DVec3::ZERO)) {
            all.push(Self::Gravity);
        }
        all.extend([Self::Mass, Self::Drag]);
        let mut colliders: Vec<usize> = course.colliders.iter().map(|it| it.collider).collect();
        colliders.dedup();
        if colliders.len() > 1 {
            all.push(Self::Restitution);
        }
        all.extend(colliders.into_iter().map(Self::RestitutionOf));
        all.extend([Self::Tangential, Self::Radius, Self::Velocity]);
        all.extend((0..course.emitters.len()).map(Self::Period));
        all
    }

    /// Values of the course, as many as the quantity has.
    pub(crate) fn expected(self, course: &Course) -> Vec<f64> {
        let starts = || course.emitters.iter().map(|it| &it.ball).chain(&course.balls);
        let sum = |part: fn(&Acting) -> DVec3| {
            course.forces.iter().map(part).fold(DVec3::ZERO, |sum, it| sum + it).length()
        };
        let restitution = |collider: Option<usize>| {
            let own = |it: &&crate::course::Fixed| collider.is_none_or(|own| own == it.collider);
            course.colliders.iter().find(own).map_or(1.0, |it| it.restitution)
        };
        let value = match self {
            Self::TimeStep => course.step,
            Self::FrameTime => course.frame_time,
            Self::Force => sum(|it| match it {
                Acting::Constant(force) => *force,
                _ => DVec3::ZERO,
            }),
            Self::Gravity => sum(|it| match it {
                Acting::Gravity(acceleration) => *acceleration,
                _ => DVec3::ZERO,
            }),
            Self::Mass => starts().next().map_or(1.0, |it| it.mass),
            Self::Radius => starts().next().map_or(1.0, |it| it.radius),
            Self::Drag => course.drag(),
            Self::RestitutionOf(collider) => restitution(Some(collider)),
            Self::Restitution => restitution(None),
            Self::Tangential => course.tangential,
            Self::Period(emitter) => course.emitters[emitter].period,
            Self::Velocity => {
                let velocity = starts().next().map_or(DVec3::ZERO, |it| it.velocity);
                return velocity.to_array().to_vec();
            }
        };
        vec![value]
    }

    /// Smallest and largest value that a program may have.
    pub(crate) fn limits(self, course: &Course) -> [f64; 2] {
        let times = |least: f64, most: f64| {
            let expected = self.expected(course)[0];
            [least * expected, most * expected]
        };
        match self {
            Self::TimeStep | Self::FrameTime => times(0.02, 20.0),
            Self::Force | Self::Gravity => times(-100.0, 100.0),
            Self::Mass => times(0.01, 1000.0),
            Self::Radius => times(0.0, 10.0),
            Self::Period(_) => times(0.01, 100.0),
            Self::Drag => [-1e3, 1e3],
            Self::RestitutionOf(_) | Self::Restitution | Self::Tangential => [-2.0, 2.0],
            Self::Velocity => [-1e4, 1e4],
        }
    }

    /// Values from which a search starts, besides that of the course.
    pub(crate) fn scan(self, course: &Course) -> Vec<f64> {
        let expected = self.expected(course)[0];
        let factors = |all: &[f64]| all.iter().map(|it| it * expected).collect::<Vec<f64>>();
        let tenths = |range: std::ops::RangeInclusive<i32>| range.map(|it| 0.1 * f64::from(it));
        match self {
            Self::TimeStep | Self::FrameTime => {
                factors(&[0.1, 0.25, 0.5, 0.8, 1.25, 1.6, 2.0, 3.0, 5.0])
            }
            Self::Force | Self::Gravity => factors(&[-1.0, 0.1, 0.5, 2.0, 5.0]),
            Self::Mass => factors(&[0.1, 0.5, 2.0, 10.0]),
            Self::Drag => vec![0.0, 0.1, 1.0],
            Self::RestitutionOf(_) | Self::Restitution => tenths(0..=12).collect(),
            Self::Tangential => tenths(-10..=12).collect(),
            Self::Radius => (1..=96).map(|part| f64::from(part) / 32.0 * expected).collect(),
            Self::Velocity | Self::Period(_) => Vec::new(),
        }
    }

    /// Whether a program can have both wrong, each by itself.
    pub(crate) fn goes_with(self, other: Self) -> bool {
        let is_time = |it| matches!(it, Self::TimeStep | Self::FrameTime);
        let is_own = |it| matches!(it, Self::RestitutionOf(_));
        let is_either = |is: fn(Self) -> bool| (is(self), is(other));
        let times = is_time(self) && is_time(other);
        let of_all = [self, other].contains(&Self::Restitution)
            && matches!(is_either(is_own), (true, _) | (_, true));
        self != other && !times && !of_all
    }

    /// Changes the course to have these values.
    pub(crate) fn put(self, values: &[f64], course: &mut Course) {
        let value = values[0];
        let ratio = value / self.expected(course)[0];
        let restitution = |course: &mut Course, collider: Option<usize>| {
            let is_own = |it: &usize| collider.is_none_or(|own| own == *it);
            for own in course.colliders.iter_mut().filter(|it| is_own(&it.collider)) {
                own.restitution = value;
            }
        };
        match self {
            Self::TimeStep => course.step = value,
            Self::FrameTime => (course.frame_time, course.step) = (value, value),
            Self::Force | Self::Gravity => {
                for force in &mut course.forces {
                    match force {
                        Acting::Constant(force) if self == Self::Force => *force *= ratio,
                        Acting::Gravity(own) if self == Self::Gravity => *own *= ratio,
                        _ => {}
                    }
                }
            }
            Self::Mass => course.starts_mut().for_each(|it| it.mass *= ratio),
            Self::Radius => course.starts_mut().for_each(|it| it.radius *= ratio),
            Self::Velocity => {
                let velocity = DVec3::new(values[0], values[1], values[2]);
                course.starts_mut().for_each(|it| it.velocity = velocity);
            }
            Self::Drag => {
                course.forces.retain(|force| !matches!(force, Acting::Drag(_)));
                course.forces.push(Acting::Drag(value));
            }
            Self::RestitutionOf(collider) => restitution(course, Some(collider)),
            Self::Restitution => restitution(course, None),
            Self::Tangential => course.tangential = value,
            Self::Period(emitter) => course.emitters[emitter].period = value,
        }
    }

    /// Name, as in "time step 0.04 s".
    pub(crate) fn name(self, course: &Course) -> String {
        let name = match self {
            Self::TimeStep => "time step",
            Self::FrameTime => "length of a frame",
            Self::Force => "constant force",
            Self::Gravity => "gravity",
            Self::Mass => "mass",
            Self::Drag => "drag coefficient",
            Self::RestitutionOf(collider) => {
                let own = course.colliders.iter().find(|it| it.collider == collider);
                return format!("restitution of {}", own.map_or("", |it| &it.name));
            }
            Self::Restitution => "restitution of every collider",
            Self::Tangential => "tangential factor",
            Self::Radius => "radius",
            Self::Velocity => "initial velocity",
            Self::Period(_) => "emitter period",
        };
        name.to_owned()
    }

    /// Unit; empty for a plain number.
    pub(crate) fn unit(self) -> &'static str {
        match self {
            Self::TimeStep | Self::FrameTime | Self::Period(_) => "s",
            Self::Force => "N",
            Self::Gravity => "m/s²",
            Self::Mass => "kg",
            Self::Drag => "kg/s",
            Self::Radius => "m",
            Self::Velocity => "m/s",
            Self::RestitutionOf(_) | Self::Restitution | Self::Tangential => "",
        }
    }
}

/// A wrong number of a program, in words and values.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WrongNumber {
    /// Name of the quantity.
    pub quantity: String,
    /// Value in the program; three coordinates of a velocity.
    pub values: Vec<f64>,
    /// Values of the course.
    pub expected: Vec<f64>,
    /// Unit; empty for a plain number.
    pub unit: &'static str,
}

impl WrongNumber {
    pub(crate) fn of(number: &Number, course: &Course) -> Self {
        let Number { quantity, values } = number;
        Self {
            quantity: quantity.name(course),
            values: values.clone(),
            expected: quantity.expected(course),
            unit: quantity.unit(),
        }
    }
}

impl std::fmt::Display for WrongNumber {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        let (value, expected) =
            (written(&self.values, three_digits), written(&self.expected, plain));
        write!(f, "{} {value}{unit} ({expected}{unit} expected)", self.quantity)
    }
}

fn written(values: &[f64], write: fn(f64) -> String) -> String {
    match values {
        [value] => write(*value),
        values => {
            let all: Vec<String> = values.iter().map(|it| write(*it)).collect();
            format!("({})", all.join(", "))
        }
    }
}

/// Writes a number with at least three significant digits, and at most two decimals more than it
/// needs.
fn three_digits(value: f64) -> String {
    let size = value.abs();
    if size < 1e-9 {
        return "0.000".to_owned();
    }
    let decimals = (2 - size.log10().floor() as i32).clamp(0, 12);
    format!("{value:.*}", decimals as usize)
}

/// Writes a number with six significant digits, without zeros at its end.
fn plain(value: f64) -> String {
    let size = value.abs().max(1e-9);
    let decimals = (5 - size.log10().floor() as i32).clamp(0, 12);
    let text = format!("{value:.*}", decimals as usize);
    if !text.contains('.') {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
