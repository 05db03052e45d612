//! Tables of students' runs.

use std::path::Path;

use carom_grade::{Reading, Recorded};
use proptest::prelude::*;

use super::recordings::tables;
use crate::fault::{Fault, check_error};
use crate::mutation::mutated;
use crate::target::{Answer, Target};

pub const TARGET: Target = Target {
    name: "submissions",
    about: "tables to be graded with a few things wrong",
    campaign: 5_000,
    cases: || mutated(tables()).boxed(),
    check,
};

fn check(case: &[u8]) -> Result<Answer, Fault> {
    match Recorded::parse(Path::new("run.csv"), case, &Reading::default()) {
        Ok(_) => Ok(Answer::Accepted),
        Err(error) => check_error(&error.to_string()).map(|()| Answer::Refused),
    }
}
