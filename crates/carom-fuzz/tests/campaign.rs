//! A small campaign of each target, always of the same cases; `cargo xtask fuzz` draws many more. What
//! it has caught: errors of thousands of characters and of several lines, escape sequences in them.

use carom_fuzz::{Campaign, TARGETS};

/// Cases of the seed 2, where the whole campaign has those of the seed 1; of each target as many as take some seconds.
#[track_caller]
fn holds(name: &str, count: u64) {
    let target = TARGETS.iter().find(|it| it.name == name).unwrap();
    let campaign = Campaign { seed: 2, first: 0, count, until: None };
    let totals = campaign.run(target, |finding| {
        println!("{}: {}\n{}", finding.number, finding.fault, finding.case.escape_ascii());
    });
    assert!(totals.findings.iter().all(|finding| finding.fault.is_limit()), "{totals}");
    // Cases of which all are refused, or none, test little.
    assert!(totals.accepted > count / 20 && totals.refused > count / 20, "{totals}");
}

#[test]
fn scene_files_with_mistakes_are_read_or_refused() {
    holds("scenes", 350);
}

#[test]
fn overrides_with_mistakes_are_taken_or_refused() {
    holds("overrides", 1000);
}

#[test]
fn links_with_mistakes_are_opened_or_refused() {
    holds("links", 500);
}

#[test]
fn recordings_with_mistakes_are_played_or_refused() {
    holds("recordings", 400);
}

#[test]
fn particle_files_with_mistakes_are_imported_or_refused() {
    holds("particles", 300);
}

#[test]
fn unfinished_files_with_mistakes_are_recovered_or_refused() {
    holds("unfinished", 500);
}

#[test]
fn mazes_with_mistakes_are_read_or_refused() {
    holds("mazes", 200);
}

#[test]
fn unity_scenes_with_mistakes_are_imported_or_refused() {
    holds("unity", 350);
}

#[test]
fn gltf_scenes_with_mistakes_are_imported_or_refused() {
    holds("gltf", 1000);
}

#[test]
fn submissions_with_mistakes_are_read_or_refused() {
    holds("submissions", 500);
}

#[test]
fn options_of_no_sense_are_refused() {
    holds("options", 300);
}

#[test]
fn worlds_that_are_hard_to_step_keep_the_laws() {
    holds("worlds", 200);
}
