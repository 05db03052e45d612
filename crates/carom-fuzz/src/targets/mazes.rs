//! Mazes that are drawn with characters.

use carom_maze::Maze;
use proptest::prelude::*;

use crate::case::text;
use crate::fault::{Fault, check_error};
use crate::mutation::mutated;
use crate::target::{Answer, Target};

pub const TARGET: Target = Target {
    name: "mazes",
    about: "drawings of mazes with a few things wrong",
    campaign: 20_000,
    cases: || {
        let random = (1..4).filter_map(|seed| carom_maze::random_text(seed, 4, 3).ok());
        let drawn = "title: two ways\n#######\n#S    #\n# # # #\n#  o E#\n#######\n".to_owned();
        mutated(random.chain([drawn]).map(String::into_bytes).collect()).boxed()
    },
    check,
};

fn check(case: &[u8]) -> Result<Answer, Fault> {
    match Maze::from_text(&text(case), "case.txt") {
        Ok(_) => Ok(Answer::Accepted),
        Err(error) => {
            check_error(&error.to_string())?;
            Ok(Answer::Refused)
        }
    }
}
