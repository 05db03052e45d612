//! Grades recorded runs of students by the course's rule, and finds the known mistake that explains
//! a difference.
//!
//! ```text
//!  scene -> Course -> course_rule (with Mistakes) -> Tracks --+
//!  table -> Recorded -> keys of its balls -> rows -----------+-> Fit -> Verdict -> words, page
//! ```
//!
//! [`Grader::grade`] compares a [`Recorded`] run with the run of the course's rule and, if it
//! departs, with the run of each [`Mistake`]. Mistakes are variants of a small implementation of
//! the rule in this crate; the engine's rule has none.
//!
//! ```
//! use carom_grade::{Course, Grader, Mistake, Reading, Recorded, TOLERANCE};
//! use carom_scene::Library;
//!
//! let scene = Library::new().find("simtest1", &[])?.0;
//! let mut grader = Grader::new(Course::of(&scene)?, TOLERANCE);
//! let mut table = Vec::new();
//! grader.planted(Mistake::ExplicitEuler.into(), 5.0, true).write(&mut table)?;
//! let recorded = Recorded::parse("run.csv".as_ref(), &table, &Reading::default())?;
//! let verdict = grader.grade(&recorded).verdict;
//! assert_eq!(verdict.explanations[0].cause.mistakes, Mistake::ExplicitEuler.into());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![warn(clippy::unwrap_used)]

mod assign;
mod class;
mod contact;
mod course;
mod course_rule;
mod encoding;
mod error;
mod estimate;
mod fit;
mod form;
mod grader;
mod heading;
mod mistake;
mod number;
mod particles;
mod program;
mod quantity;
mod real;
mod recorded;
mod report;
mod scatter;
mod search;
mod spread;
mod spreadsheet;
mod svg;
mod table;
mod tracks;
mod verdict;
mod wide;
mod words;

pub use class::{ClassRun, class_page};
pub use contact::ContactKind;
pub use course::Course;
pub use error::GradeError;
pub use fit::{Departed, Fit};
pub use grader::{Graded, Grader, TOLERANCE};
pub use mistake::{Mistake, Mistakes};
pub use quantity::WrongNumber;
pub use recorded::{Reading, Recorded};
pub use report::page;
pub use scatter::Scatter;
pub use table::Columns;
pub use tracks::{State, Touch, Tracks};
pub use verdict::{Cause, Departure, DepartureContact, Explanation, Then, Verdict};
