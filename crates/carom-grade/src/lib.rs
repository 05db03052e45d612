//! Recorded runs of students against the course's rule.

mod assign;
mod contact;
mod course;
mod course_rule;
mod error;
mod fit;
mod grader;
mod mistake;
mod number;
mod real;
mod recorded;
mod spread;
mod tracks;
mod verdict;

pub use contact::ContactKind;
pub use course::Course;
pub use error::GradeError;
pub use fit::{Departed, Fit};
pub use grader::{Graded, Grader, TOLERANCE};
pub use mistake::{Mistake, Mistakes};
pub use recorded::{Columns, Reading, Recorded};
pub use tracks::{State, Touch, Tracks};
pub use verdict::{Departure, DepartureContact, Explanation, Verdict};

