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

/// Change of a number, as a part of it, below which it only fits the rounding of a run.
const LEAST_CHANGE: f64 = 2e-3;

/// Times of rows after the departures of its parts up to which a pair must agree.
const NEXT: usize = 10;

/// A search over the causes of one run.
pub(crate) struct Search<'a> {
    pub bench: &'a Bench<'a>,
    /// Comparison with the course's rule, which the run departs from.
    pub right: &'a Fit,
    /// Runs of single mistakes, in the order of the list.
    pub singles: Vec<Candidate>,
}

impl Search<'_> {
    /// Finds programs that explain the run better than the course's rule does: one cause each, or
    /// pairs if no single cause explains all.
    pub fn explanations(&self) -> Vec<Candidate> {
        let mut found = self.singles.clone();
        if found.iter().any(|it| it.fit.is_complete()) {
            found.retain(|it| it.fit.is_complete());
            return found;
        }
        let numbers = self.numbers();
        found.extend(numbers.iter().flatten().cloned());
        found.retain(|it| it.fit.followed > self.right.followed);
        let best = found.iter().map(|it| it.fit.followed).max().unwrap_or(0);
        let rows = self.right.rows;
        if best < rows && rows <= MOST_ROWS_OF_PAIRS {
            let least = best as f64 + WORTH_A_PAIR * rows as f64;
            let pairs = self.pairs(&numbers);
            let is_worth = |it: &Candidate| it.fit.followed as f64 > least && self.is_seen(it);
            found.extend(pairs.into_iter().filter(is_worth));
        }
        found
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

    fn pairs(&self, numbers: &[Option<Candidate>]) -> Vec<Candidate> {
        let mut found = self.mistakes_twice();
        for single in &self.singles {
            let from = self.departure(&single.fit);
            let with = |it| self.bench.with_quantity(&single.program, it, from);
            found.extend(self.quantities().into_iter().filter_map(with));
        }
        found.extend(self.numbers_twice(numbers));
        found
    }

    fn mistakes_twice(&self) -> Vec<Candidate> {
        let mut found = Vec::new();
        let until = |of: &Candidate| self.bench.rows.later(self.departure(&of.fit), NEXT);
        for (place, first) in self.singles.iter().enumerate() {
            for second in &self.singles[place + 1..] {
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
