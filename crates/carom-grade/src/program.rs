//! A program that differs from the course's rule by known mistakes and wrong numbers.

use crate::course::Course;
use crate::course_rule::{Clock, run, run_jittered};
use crate::mistake::{Mistake, Mistakes};
use crate::quantity::Number;
use crate::tracks::Tracks;

/// What a program does other than the course's rule.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Program {
    /// Known mistakes.
    pub mistakes: Mistakes,
    /// Wrong numbers.
    pub numbers: Vec<Number>,
}

impl Program {
    /// Number of differences from the course's rule.
    pub(crate) fn causes(&self) -> usize {
        self.mistakes.len() + self.numbers.len()
    }

    /// The course with the numbers of the program.
    pub(crate) fn course(&self, course: &Course) -> Course {
        let mut own = course.clone();
        for Number { quantity, values } in &self.numbers {
            quantity.put(values, &mut own);
        }
        own
    }

    /// Runs the program.
    pub(crate) fn run(&self, course: &Course, clock: &Clock) -> Tracks {
        run::<f64>(&self.course(course), self.mistakes, clock)
    }

    /// Runs the program in single precision.
    pub(crate) fn run_single(&self, course: &Course, clock: &Clock) -> Tracks {
        run::<f32>(&self.course(course), self.mistakes, clock)
    }

    /// Runs the program with an error in each number of each step.
    pub(crate) fn run_jittered(
        &self,
        course: &Course,
        clock: &Clock,
        jitter: &mut dyn FnMut() -> f64,
    ) -> Tracks {
        run_jittered(&self.course(course), self.mistakes, clock, jitter)
    }
}

impl From<Mistakes> for Program {
    fn from(mistakes: Mistakes) -> Self {
        Self { mistakes, numbers: Vec::new() }
    }
}

impl From<Mistake> for Program {
    fn from(mistake: Mistake) -> Self {
        Mistakes::from(mistake).into()
    }
}
