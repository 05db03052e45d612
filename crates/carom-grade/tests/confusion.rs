//! Grades every known mistake in every SimTest, and checks which mistake is named first. Runs are in single
//! precision, with 1e-6 m of noise, without velocities. The table of `confusion.md` is made here, and checked.

mod common;

use carom_grade::{Cause, Grader, Mistake, Mistakes, Tracks};
use common::{SCENES, Style, grader, planted};

/// Longer than the time until slots are reused [s].
const SECONDS: f64 = 18.4;

/// Smallest difference \[m\] that makes a mistake visible.
const VISIBLE: f64 = 1e-3;

/// Result for a mistake in a scene.
#[derive(Debug, PartialEq)]
enum Cell {
    /// The mistake has no effect in this scene.
    Unseen,
    /// The mistake is named first, alone or with others whose run is the same.
    Named(Vec<String>),
    /// Another mistake is named first, or none.
    Missed(Option<String>),
}

impl Cell {
    fn text(&self) -> String {
        match self {
            Self::Unseen => "-".to_owned(),
            Self::Named(others) if others.is_empty() => "named".to_owned(),
            Self::Named(others) => {
                let others: Vec<String> = others.iter().map(|it| format!("`{it}`")).collect();
                format!("named, as is {}", others.join(", "))
            }
            Self::Missed(Some(other)) => format!("**{other}**"),
            Self::Missed(None) => "**none**".to_owned(),
        }
    }
}

/// Whether two runs differ visibly.
fn is_seen(right: &Tracks, wrong: &Tracks) -> bool {
    if right.len() != wrong.len() || right.frames() != wrong.frames() {
        return true;
    }
    let apart =
        |ball: usize, frame: usize| match (right.state(ball, frame), wrong.state(ball, frame)) {
            (Some(a), Some(b)) => a.position.distance(b.position) > VISIBLE,
            (a, b) => a.is_some() != b.is_some(),
        };
    (0..right.len()).any(|ball| (0..=right.frames()).any(|frame| apart(ball, frame)))
}

fn cell(grader: &mut Grader, right: &Tracks, mistake: Mistake) -> Cell {
    if !is_seen(right, &grader.planted(mistake.into(), SECONDS, false)) {
        return Cell::Unseen;
    }
    // A table of display frames contains every frame.
    let every = if mistake == Mistake::DisplayFrames { 1 } else { 3 };
    let style = Style { noise: 1e-6, every, velocities: false, ..Style::default() };
    let run = planted(grader, mistake.into(), SECONDS, style);
    let verdict = grader.grade(&run).verdict;
    let Some(first) = verdict.explanations.first() else { return Cell::Missed(None) };
    let is_it = |it: &Cause| it.numbers.is_empty() && it.mistakes == mistake.into();
    let all = std::iter::once(&first.cause).chain(&first.same_as);
    if all.clone().any(is_it) {
        // Numbers that do the same as the mistake are no other mistake.
        let others = all.filter(|it| !is_it(it) && it.numbers.is_empty());
        Cell::Named(others.map(ToString::to_string).collect())
    } else {
        Cell::Missed(Some(first.named()))
    }
}

/// Results of all mistakes in a scene.
fn column(scene: &str) -> Vec<Cell> {
    let mut grader = grader(scene);
    let right = grader.planted(Mistakes::NONE, SECONDS, false);
    Mistake::all().map(|mistake| cell(&mut grader, &right, mistake)).collect()
}

#[test]
fn some_mistakes_of_every_scene_are_named() {
    // One of thirteen in each scene; the table below has all.
    for (number, scene) in SCENES.iter().enumerate() {
        let mut grader = grader(scene);
        let right = grader.planted(Mistakes::NONE, SECONDS, false);
        for mistake in Mistake::all().skip(2 * number).step_by(13) {
            let cell = cell(&mut grader, &right, mistake);
            assert!(!matches!(cell, Cell::Missed(_)), "{scene}, {}: {cell:?}", mistake.name());
        }
    }
}

#[test]
#[ignore = "minutes; `cargo xtask test --full` runs it"]
fn mistakes_are_named_and_the_table_of_them_is_current() {
    let columns: Vec<Vec<Cell>> = std::thread::scope(|scope| {
        let columns: Vec<_> = SCENES.iter().map(|scene| scope.spawn(|| column(scene))).collect();
        columns.into_iter().map(|it| it.join().unwrap()).collect()
    });
    let cells = || columns.iter().flatten();
    let seen = cells().filter(|cell| **cell != Cell::Unseen).count();
    let named = cells().filter(|cell| matches!(cell, Cell::Named(_))).count();
    let mut table =
        String::from("| mistake | 1 | 2 | 3 | 4 | 5 | 6 |\n|---|---|---|---|---|---|---|\n");
    for (row, mistake) in Mistake::all().enumerate() {
        let texts: Vec<String> = columns.iter().map(|column| column[row].text()).collect();
        table += &format!("| `{}` | {} |\n", mistake.name(), texts.join(" | "));
    }
    table += &format!(
        "\n{named} of {seen} pairs of a mistake and a scene where it can be seen are named.\n"
    );
    assert!(10 * named >= 9 * seen, "{table}");
    let document = include_str!("confusion.md");
    assert!(document.contains(&table), "confusion.md should have this table:\n{table}");
}

#[test]
fn the_guide_for_courses_names_every_mistake() {
    let guide = include_str!("../../../docs/courses.md");
    for mistake in Mistake::all() {
        let name = format!("`{}`", mistake.name());
        assert!(guide.contains(&name), "docs/courses.md should name {name}");
    }
}
