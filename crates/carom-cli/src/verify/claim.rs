//! What a claim is.

use std::error::Error;

use carom::{Rule, StateHash, World};

/// A claim about physics that can be false.
pub struct Claim {
    pub name: String,
    pub expected: Expected,
    pub tolerance: Tolerance,
    pub effort: Effort,
    /// The rule it is about, or any.
    pub rule: Option<Rule>,
    pub measure: Box<Measure>,
}

/// Measures what a claim is about under a rule.
pub type Measure = dyn Fn(Rule) -> Outcome + Send + Sync;

/// What came out, or why nothing did.
pub type Outcome = Result<Measured, Fault>;

/// Why nothing came out.
pub type Fault = Box<dyn Error + Send + Sync>;

/// The value a claim is about.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expected {
    pub value: f64,
    /// Where it comes from.
    pub source: &'static str,
}

impl Expected {
    /// A value and where it comes from.
    pub fn value(value: f64, source: &'static str) -> Self {
        Self { value, source }
    }

    /// No error, of whatever a claim measures the error of.
    pub fn no_error(source: &'static str) -> Self {
        Self { value: 0.0, source }
    }
}

/// How far the measured value may be from the expected one, and why.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    pub bound: f64,
    /// Whether the bound is a part of the expected value.
    pub is_relative: bool,
    pub reason: &'static str,
}

impl Tolerance {
    pub fn absolute(bound: f64, reason: &'static str) -> Self {
        Self { bound, is_relative: false, reason }
    }

    pub fn relative(bound: f64, reason: &'static str) -> Self {
        Self { bound, is_relative: true, reason }
    }

    /// The value itself.
    pub fn none(reason: &'static str) -> Self {
        Self::absolute(0.0, reason)
    }

    /// How far `measured` is from `expected`, in the manner of the bound.
    pub fn error(&self, measured: f64, expected: f64) -> f64 {
        let error = (measured - expected).abs();
        if self.is_relative { error / expected.abs() } else { error }
    }
}

/// How long a claim takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Effort {
    /// Seconds.
    Quick,
    /// Minutes.
    Full,
}

/// What came out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    pub value: f64,
    /// Of the worlds at their ends.
    pub state: StateHash,
    /// Whether spheres were stepped in zones, which is not exact.
    pub was_stepped: bool,
}

impl Measured {
    /// A value measured in one world.
    pub fn in_world(world: &World, value: f64) -> Self {
        Self { value, state: world.state_hash(), was_stepped: world.was_stepped() }
    }

    /// The largest of several values.
    pub fn largest(measured: impl IntoIterator<Item = Self>) -> Self {
        Self::folded(measured, f64::max)
    }

    /// The sum of several values.
    pub fn sum(measured: impl IntoIterator<Item = Self>) -> Self {
        Self::folded(measured, |a, b| a + b)
    }

    fn folded(measured: impl IntoIterator<Item = Self>, fold: impl Fn(f64, f64) -> f64) -> Self {
        let none = Self { value: 0.0, state: StateHash(0), was_stepped: false };
        measured.into_iter().fold(none, |all, one| Self {
            // What is no number shall not get lost in a maximum.
            value: if (all.value + one.value).is_nan() {
                f64::NAN
            } else {
                fold(all.value, one.value)
            },
            state: StateHash(all.state.0.rotate_left(1) ^ one.state.0),
            was_stepped: all.was_stepped || one.was_stepped,
        })
    }
}

impl Claim {
    /// A claim about every rule that takes seconds to check.
    pub fn new(
        name: impl Into<String>,
        expected: Expected,
        tolerance: Tolerance,
        measure: impl Fn(Rule) -> Outcome + Send + Sync + 'static,
    ) -> Self {
        let (effort, rule, measure) = (Effort::Quick, None, Box::new(measure));
        Self { name: name.into(), expected, tolerance, effort, rule, measure }
    }

    /// The same claim, about this rule only.
    pub fn about(self, rule: Rule) -> Self {
        Self { rule: Some(rule), ..self }
    }

    /// The same claim, taking minutes.
    pub fn slow(self) -> Self {
        Self { effort: Effort::Full, ..self }
    }
}
