//! Fits numbers of a program to a table by nonlinear least squares.

use rmpfit::{MPConfig, MPFitter, MPMaxFev, MPPar, MPResult};

use crate::course::Course;
use crate::course_rule::Clock;
use crate::fit::{Fit, Rows};
use crate::program::Program;
use crate::quantity::{Number, Quantity};
use crate::tracks::{Key, Tracks};

/// Times of rows after a departure that a fit takes up next.
const NEXT: usize = 10;

/// Times of rows that a fit takes up first: few, because a contact in the wrong frame leads astray.
const FEW: usize = 3;

/// Numbers of times that are taken up in turn until a fit becomes better.
const TAKES: [usize; 6] = [NEXT, FEW, 2 * NEXT, 4 * NEXT, 8 * NEXT, 16 * NEXT];

/// Most rows of a fit.
const MOST_ROWS: usize = 400;

/// Most steps by which the rows of a fit are extended.
const MOST_STEPS: usize = 40;

/// Starting values from which a fit is tried.
const STARTS: usize = 3;

/// Largest deviation of a coordinate that counts \[m\].
const FARTHEST: f64 = 10.0;

/// A program with its comparison.
#[derive(Debug, Clone)]
pub(crate) struct Candidate {
    pub program: Program,
    pub fit: Fit,
}

/// Where programs run and with what they are compared.
pub(crate) struct Bench<'a> {
    pub course: &'a Course,
    pub rows: &'a Rows<'a>,
    /// Time up to which programs run \[s\].
    pub end: f64,
    /// Times of the display's frames, if the table has them \[s\].
    pub display: Option<Vec<f64>>,
}

impl Bench<'_> {
    /// Runs a program up to a time \[s\].
    pub fn run(&self, program: &Program, until: f64) -> Tracks {
        let until = until.min(self.end);
        let clock = match &self.display {
            Some(times) if program.mistakes.has(crate::mistake::Mistake::DisplayFrames) => {
                Clock::At(times.iter().copied().filter(|time| *time <= until + 1e-9).collect())
            }
            _ => Clock::Fixed(until),
        };
        program.run(self.course, &clock)
    }

    /// Compares the whole table with a program.
    pub fn candidate(&self, program: Program) -> Candidate {
        let fit = self.rows.follow(&self.run(&program, self.end), 0.0);
        Candidate { program, fit }
    }

    /// Fits the numbers of a program, from the values that it has. `from` is a time up to which the
    /// program agrees, or would without them \[s\]; rows after it are taken up step by step, because
    /// rows long after contacts would lead astray. `None` if the numbers do not make the next rows
    /// agree.
    pub fn fitted(&self, start: &Program, from: f64) -> Option<Candidate> {
        let few = self.agreeing(start, from, FEW)?;
        let next = self.agreeing(&few, from, NEXT);
        let mut best = self.candidate(next.or_else(|| self.agreeing(start, from, NEXT))?);
        let mut takes = TAKES.iter();
        for _ in 0..MOST_STEPS {
            let (Some(departed), Some(take)) = (best.fit.departure, takes.next()) else { break };
            let until = self.rows.later(departed.time, *take);
            let Some(next) = self.refined(&best.program, until) else { break };
            let next = self.candidate(next);
            if next.fit.followed > best.fit.followed {
                best = next;
                takes = TAKES.iter();
            }
        }
        Some(self.over_all(best))
    }

    /// Fits the numbers of a program to the rows up to a number of times after `from` \[s\]; `None`
    /// if they do not agree then.
    fn agreeing(&self, start: &Program, from: f64, times: usize) -> Option<Program> {
        let until = self.rows.later(from, times);
        let program = self.refined(start, until)?;
        let tracks = self.run(&program, until + self.margin());
        self.rows.agree_until(&tracks, until).then_some(program)
    }

    /// Fits the numbers of a program once more, to all rows that agree.
    fn over_all(&self, found: Candidate) -> Candidate {
        let until = found.fit.departure.map_or(self.end, |it| it.time - 1e-9);
        let again = self.refined(&found.program, until).map(|it| self.candidate(it));
        again.filter(|it| it.fit.is_better_than(&found.fit)).unwrap_or(found)
    }

    /// Fits one more quantity of a program, from several starting values.
    pub fn with_quantity(
        &self,
        base: &Program,
        quantity: Quantity,
        from: f64,
    ) -> Option<Candidate> {
        let with = |values: Vec<f64>| {
            let mut program = base.clone();
            program.numbers.push(Number { quantity, values });
            program
        };
        if let Quantity::Period(_) = quantity {
            let period = self.period(base)?;
            let found = self.candidate(with(vec![period]));
            return Some(found);
        }
        let expected = quantity.expected(self.course);
        let mut starts = vec![with(expected)];
        starts.extend(quantity.scan(self.course).into_iter().map(|it| with(vec![it])));
        if quantity == Quantity::FrameTime {
            starts.extend(self.usual_step().map(|it| with(vec![it])));
        }
        let fits = self.nearest(starts, from).into_iter().filter_map(|it| self.fitted(&it, from));
        best_of(fits)
    }

    /// Returns the starting values whose next rows after a time \[s\] are nearest to the table. If
    /// several are as near, because a contact is in the same frame for all of them, more rows
    /// decide.
    fn nearest(&self, starts: Vec<Program>, from: f64) -> Vec<Program> {
        let misfits = |starts: &[Program], next: usize| {
            let until = self.rows.later(from, next);
            let chosen = self.rows.chosen(until, MOST_ROWS);
            starts.iter().map(|it| self.misfit(it, &chosen, until)).collect::<Vec<f64>>()
        };
        let near = misfits(&starts, NEXT);
        let mut sorted = near.clone();
        sorted.sort_by(f64::total_cmp);
        let Some(&limit) = sorted.get(STARTS - 1).or(sorted.last()) else { return starts };
        let mut all: Vec<(f64, Program)> = near.into_iter().zip(starts).collect();
        all.retain(|it| it.0 <= limit * (1.0 + 1e-9));
        if all.len() > STARTS {
            let left: Vec<Program> = all.into_iter().map(|it| it.1).collect();
            all = misfits(&left, 8 * NEXT).into_iter().zip(left).collect();
        }
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all.into_iter().take(STARTS).map(|it| it.1).collect()
    }

    /// Rounds the numbers of a program as far as it follows the table as well.
    pub fn rounded(&self, found: Candidate) -> Candidate {
        let mut best = found;
        for number in 0..best.program.numbers.len() {
            for digits in 1..=6 {
                let mut program = best.program.clone();
                let expected = program.numbers[number].quantity.expected(self.course);
                let values = &mut program.numbers[number].values;
                let size =
                    values.iter().chain(&expected).fold(0.0_f64, |most, it| most.max(it.abs()));
                let unit = 10_f64.powi(size.max(1e-9).log10().floor() as i32 + 1 - digits);
                values.iter_mut().for_each(|it| *it = neat(*it, unit));
                let rounded = self.candidate(program);
                let (own, other) = (rounded.fit.residual, best.fit.residual);
                if rounded.fit.followed > best.fit.followed {
                    best = rounded;
                } else if rounded.fit.followed == best.fit.followed && own <= 1.005 * other + 1e-9 {
                    best = rounded;
                    break;
                }
            }
        }
        best
    }

    /// Usual time between two times of the table \[s\].
    fn usual_step(&self) -> Option<f64> {
        let times = self.rows.recorded.times();
        let mut steps: Vec<f64> = times.windows(2).map(|it| it[1] - it[0]).collect();
        steps.sort_by(f64::total_cmp);
        steps.get(steps.len() / 2).copied()
    }

    /// A time after the rows of a fit up to which it runs \[s\].
    fn margin(&self) -> f64 {
        2.0 * self.course.frame_time
    }

    /// Sum of the squares of the limited deviations.
    fn misfit(&self, program: &Program, chosen: &[usize], until: f64) -> f64 {
        let mut deviates = vec![0.0; 3 * chosen.len()];
        self.deviations(program, chosen, until, &mut deviates);
        deviates.iter().map(|it| it.clamp(-1.0, 1.0).powi(2)).sum()
    }

    fn deviations(&self, program: &Program, chosen: &[usize], until: f64, deviates: &mut [f64]) {
        let tracks = self.run(program, until + self.margin());
        let recorded = self.rows.recorded;
        for (number, own) in chosen.iter().zip(deviates.chunks_exact_mut(3)) {
            let row = &recorded.rows[*number];
            let there = tracks.sample(self.rows.keys[row.label], row.time);
            let apart = there.map(|it| (row.position - it.position) * recorded.seen);
            let apart = apart.filter(|it| it.is_finite());
            let apart = apart.map_or([1.0; 3], |it| it.to_array());
            own.copy_from_slice(&apart.map(|it| it.clamp(-FARTHEST, FARTHEST)));
        }
    }

    /// Fits the numbers of a program to the rows up to a time \[s\].
    fn refined(&self, start: &Program, until: f64) -> Option<Program> {
        let of = |number: &Number| number.values.clone();
        let mut values: Vec<f64> = start.numbers.iter().flat_map(of).collect();
        let limits = start.numbers.iter().flat_map(|number| {
            let [low, up] = number.quantity.limits(self.course);
            number.values.iter().map(move |_| [low, up])
        });
        let parameter = |[low, up]: [f64; 2]| MPPar {
            limited_low: true,
            limited_up: true,
            limit_low: low,
            limit_up: up,
            ..MPPar::new()
        };
        let parameters: Vec<MPPar> = limits.map(parameter).collect();
        let chosen = self.rows.chosen(until, MOST_ROWS);
        let config = MPConfig { max_iter: 12, max_fev: MPMaxFev::Limited(60), ..MPConfig::new() };
        let mut problem = Problem { bench: self, start, chosen, until, parameters, config };
        problem.mpfit(&mut values).ok()?;
        Some(with_values(start, &values))
    }

    /// Period of an emitter \[s\] from the times at which balls appear in the frames of a program;
    /// `None` if they do not come at equal times.
    fn period(&self, base: &Program) -> Option<f64> {
        let recorded = self.rows.recorded;
        let is_of_display = base.mistakes.has(crate::mistake::Mistake::DisplayFrames);
        let display = self.usual_step().filter(|_| is_of_display && self.display.is_some());
        let h = display.unwrap_or(base.course(self.course).frame_time);
        let times = recorded.times();
        let mut range = [0.0_f64, f64::INFINITY];
        let mut is_new = vec![true; self.rows.keys.len()];
        for row in &recorded.rows {
            // A slot first holds the ball with its number.
            let (Key::Number(ball) | Key::Slot(ball)) = self.rows.keys[row.label];
            if !std::mem::take(&mut is_new[row.label]) || ball == 0 {
                continue;
            }
            // The ball was emitted in one of the frames since the previous time of the table.
            let before = times.partition_point(|it| *it < row.time).checked_sub(1)?;
            let [first, last] = [times[before] - h, row.time - h];
            let (low, up) = (first / ball as f64, last / ball as f64);
            range = [range[0].max(low), range[1].min(up)];
        }
        if !range[1].is_finite() || range[0] >= range[1] {
            return None;
        }
        let middle = 0.5 * (range[0] + range[1]);
        let neat = (0..9).map(|decimals| neat(middle, 10_f64.powi(-decimals)));
        neat.into_iter().find(|it| range[0] < *it && *it <= range[1] + 1e-9)
    }
}

/// Rounds a value to a multiple of a unit that is a power of ten.
fn neat(value: f64, unit: f64) -> f64 {
    // Division by a whole number gives the nearest double of a decimal fraction.
    let per = (1.0 / unit).round();
    if per >= 1.0 { (value * per).round() / per } else { (value / unit).round() * unit }
}

/// The best of some candidates.
pub(crate) fn best_of(all: impl Iterator<Item = Candidate>) -> Option<Candidate> {
    all.reduce(|best, next| if next.fit.is_better_than(&best.fit) { next } else { best })
}

fn with_values(program: &Program, values: &[f64]) -> Program {
    let mut program = program.clone();
    let mut left = values;
    for number in &mut program.numbers {
        let (own, others) = left.split_at(number.values.len());
        number.values.copy_from_slice(own);
        left = others;
    }
    program
}

/// A problem of least squares.
struct Problem<'a> {
    bench: &'a Bench<'a>,
    start: &'a Program,
    /// Numbers of the rows.
    chosen: Vec<usize>,
    until: f64,
    parameters: Vec<MPPar>,
    config: MPConfig,
}

impl MPFitter for Problem<'_> {
    fn eval(&mut self, values: &[f64], deviates: &mut [f64]) -> MPResult<()> {
        let program = with_values(self.start, values);
        self.bench.deviations(&program, &self.chosen, self.until, deviates);
        Ok(())
    }

    fn number_of_points(&self) -> usize {
        3 * self.chosen.len()
    }

    fn config(&self) -> &MPConfig {
        &self.config
    }

    fn parameters(&self) -> &[MPPar] {
        &self.parameters
    }
}
