//! Searches for the mistakes and wrong numbers that explain a run.

use crate::estimate::{Bench, Candidate, best_of};
use crate::fit::Fit;
use crate::mistake::Mistakes;
use crate::program::Program;
use crate::quantity::{Number, Quantity};

/// Most rows of a table that is compared with pairs of causes, which would take minutes for more.
const MOST_ROWS_OF_PAIRS: usize = 100_000;

/// Fraction of all rows by which two causes must agree longer than a single one to be named.
const WORTH_A_PAIR: f64 = 0.02;

/// Residual of two causes, as a part of that of a single one that follows all rows only because
/// rounding moves it far, below which they are named. A number more follows chance to some hundredths.
const MUCH_CLOSER: f64 = 1e-3;

/// Change of a number, as a part of it, below which it only fits the rounding of a run.
const LEAST_CHANGE: f64 = 2e-3;

/// Number of times after the departures of the single causes up to which a pair of causes must
/// agree with the run.
const NEXT: usize = 10;

/// Programs with one cause each.
pub(crate) struct Alone {
    /// Programs with a known mistake, in the order of the list.
    pub mistakes: Vec<Candidate>,
    /// A program with one wrong number for each quantity, where its value can be found; empty if a
    /// mistake explains all rows closely.
    pub numbers: Vec<Option<Candidate>>,
}

impl Alone {
    /// Returns the programs that agree longer than the course's rule, or only those that agree with
    /// all rows, if some do.
    pub fn better_than(&self, right: &Fit) -> Vec<Candidate> {
        let all = self.mistakes.iter().chain(self.numbers.iter().flatten());
        let mut found: Vec<Candidate> =
            all.filter(|it| it.fit.followed > right.followed).cloned().collect();
        if self.mistakes.iter().any(|it| it.fit.is_complete()) {
            found.retain(|it| it.fit.is_complete());
        }
        found
    }
}

/// A search over the causes of one run.
pub(crate) struct Search<'a> {
    pub bench: &'a Bench<'a>,
    /// Comparison with the course's rule, which the run departs from.
    pub right: &'a Fit,
    /// Allowed error of positions without that by rounding \[m\].
    pub tolerance: f64,
}

impl Search<'_> {
    /// Adds the programs with one wrong number to those with one mistake.
    pub fn alone(&self, mistakes: Vec<Candidate>) -> Alone {
        if mistakes.iter().any(|it| self.is_settled(&it.fit)) {
            return Alone { mistakes, numbers: Vec::new() };
        }
        let mut numbers = self.numbers();
        // In a run of many contacts, the last digits decide how long it agrees.
        let best = numbers
            .iter_mut()
            .flatten()
            .reduce(|best, next| if next.fit.is_better_than(&best.fit) { next } else { best });
        if let Some(best) = best {
            *best = self.bench.rounded(best.clone());
        }
        Alone { mistakes, numbers }
    }

    /// Compares programs that were found with other errors of rows; `mistakes` are so already.
    pub fn again(&self, found: Alone, mistakes: Vec<Candidate>) -> Alone {
        if found.numbers.is_empty() {
            return self.alone(mistakes);
        }
        let compared = |it: Option<Candidate>| it.map(|it| self.bench.candidate(it.program));
        Alone { mistakes, numbers: found.numbers.into_iter().map(compared).collect() }
    }

    /// Finds pairs of causes that agree much longer than `alone`, or as long and much more closely, if
    /// no single cause explains all.
    pub fn pairs(&self, alone: &Alone) -> Vec<Candidate> {
        let single = alone.better_than(self.right);
        let best = single.iter().reduce(|a, b| if b.fit.is_better_than(&a.fit) { b } else { a });
        let best = best.map_or(self.right, |it| &it.fit);
        if self.is_settled(best) || best.rows > MOST_ROWS_OF_PAIRS {
            return Vec::new();
        }
        let least = best.followed as f64 + WORTH_A_PAIR * best.rows as f64;
        let is_closer =
            |it: &Fit| it.followed >= best.followed && it.residual < MUCH_CLOSER * best.residual;
        let may_be_closer = best.is_complete();
        let is_worth = |it: &Fit| it.followed as f64 > least || may_be_closer && is_closer(it);
        let mut pairs = self.mistakes_twice(&alone.mistakes);
        pairs.extend(self.mistakes_with_numbers(&alone.mistakes));
        pairs.extend(self.numbers_twice(&alone.numbers));
        pairs.retain(|it| is_worth(&it.fit) && self.is_seen(it));
        pairs
    }

    /// Whether a program explains all rows, and not only because rounding moves it far.
    fn is_settled(&self, fit: &Fit) -> bool {
        fit.is_complete() && !fit.is_far(self.tolerance)
    }

    /// Whether each number of a program is other than that of the course, not only by rounding.
    fn is_seen(&self, candidate: &Candidate) -> bool {
        candidate.program.numbers.iter().all(|number| {
            let expected = number.quantity.expected(self.bench.course);
            let size = expected.iter().fold(0.0_f64, |most, it| most.max(it.abs()));
            let least = LEAST_CHANGE * if size > 0.0 { size } else { 1.0 };
            number.values.iter().zip(&expected).any(|(own, it)| (own - it).abs() > least)
        })
    }

    /// Time at which a program departs \[s\].
    fn departure(&self, fit: &Fit) -> f64 {
        fit.departure.map_or(self.bench.end, |it| it.time)
    }

    fn quantities(&self) -> Vec<Quantity> {
        Quantity::of(self.bench.course)
    }

    /// A program with one wrong number for each quantity, where its value can be found.
    fn numbers(&self) -> Vec<Option<Candidate>> {
        let from = self.departure(self.right);
        let fitted = |it| self.bench.with_quantity(&Program::default(), it, from);
        self.quantities().into_iter().map(fitted).collect()
    }

    fn mistakes_with_numbers(&self, mistakes: &[Candidate]) -> Vec<Candidate> {
        let mut found = Vec::new();
        for single in mistakes {
            let from = self.departure(&single.fit);
            let with = |it| self.bench.with_quantity(&single.program, it, from);
            found.extend(self.quantities().into_iter().filter_map(with));
        }
        found
    }

    fn mistakes_twice(&self, mistakes: &[Candidate]) -> Vec<Candidate> {
        let mut found = Vec::new();
        let until = |of: &Candidate| self.bench.rows.later(self.departure(&of.fit), NEXT);
        for (place, first) in mistakes.iter().enumerate() {
            for second in &mistakes[place + 1..] {
                let both: Mistakes =
                    first.program.mistakes.iter().chain(second.program.mistakes.iter()).collect();
                let program = Program::from(both);
                let until = until(first).max(until(second));
                let margin = 2.0 * self.bench.course.frame_time;
                if self.bench.rows.agree_until(&self.bench.run(&program, until + margin), until) {
                    found.push(self.bench.candidate(program));
                }
            }
        }
        found
    }

    fn numbers_twice(&self, numbers: &[Option<Candidate>]) -> Vec<Candidate> {
        let all = self.quantities();
        let mut found = Vec::new();
        for (place, first) in all.iter().enumerate() {
            for (other, second) in all.iter().enumerate().skip(place + 1) {
                if !first.goes_with(*second) {
                    continue;
                }
                // The one that follows the run for a while is the base of the other.
                let bases = [(place, *first, *second), (other, *second, *first)];
                let both = bases.into_iter().filter_map(|(place, base, added)| {
                    let known = numbers[place].as_ref();
                    let values = base.expected(self.bench.course);
                    let start = Program {
                        mistakes: Mistakes::NONE,
                        numbers: vec![Number { quantity: base, values }],
                    };
                    let (base, fit) =
                        known.map_or((&start, self.right), |it| (&it.program, &it.fit));
                    self.bench.with_quantity(base, added, self.departure(fit))
                });
                found.extend(best_of(both));
            }
        }
        found
    }
}
