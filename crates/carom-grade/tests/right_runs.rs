//! Right runs pass in every form: with noise, in single precision, in Unity's coordinates, from a
//! program that shares no code with the reference, in other units, with other names, in part.

mod common;
#[path = "common/student.rs"]
mod student;

use std::path::Path;

use carom_grade::{Mistakes, Reading, Recorded, Verdict};
use carom_scene::Library;
use common::{SCENES, Style, grader, planted, recorded, table};
use student::Slips;

fn read(text: &str, reading: &Reading) -> Recorded {
    Recorded::parse(Path::new("run.csv"), text.as_bytes(), reading).unwrap()
}

#[track_caller]
fn passes(verdict: &Verdict) {
    let Verdict { scene, departure, fit, .. } = verdict;
    assert!(verdict.same, "{scene}: {departure:?}, {} of {} rows", fit.followed, fit.rows);
}

#[test]
fn noise_of_a_micrometre_passes_and_leaves_five_digits() {
    for scene in SCENES {
        let mut grader = grader(scene);
        let tracks = grader.planted(Mistakes::NONE, 12.0, false);
        let style = Style { noise: 1e-6, ..Style::default() };
        let verdict = grader.grade(&recorded(&table(&tracks, style))).verdict;
        passes(&verdict);
        // Noise of 1e-6 m in each coordinate is at most 1.7e-6 m.
        assert!(verdict.fit.max < 1.8e-6, "{scene}: {}", verdict.fit.max);
        assert!(verdict.digits >= Some(5), "{scene}: {:?}", verdict.digits);
    }
}

#[test]
fn single_precision_passes_until_slots_are_used_again() {
    for scene in SCENES {
        let mut grader = grader(scene);
        let run = planted(&grader, Mistakes::NONE, 20.0, Style { noise: 1e-6, ..Style::default() });
        passes(&grader.grade(&run).verdict);
    }
}

#[test]
fn a_program_in_the_frames_of_unity_passes() {
    for name in SCENES {
        let scene = Library::new().find(name, &[]).unwrap().0;
        let text = student::table(&scene, 19.0, Slips::default());
        let columns = "t=time,ball=sphere,x=px,y=py,z=pz".parse().unwrap();
        let reading = Reading { columns, unity: true, ..Reading::default() };
        passes(&grader(name).grade(&read(&text, &reading)).verdict);
    }
}

#[test]
fn runs_in_part_pass() {
    for (scene, style) in [
        ("simtest1", Style { every: 7, ..Style::default() }),
        ("simtest3", Style { first: 151, ..Style::default() }),
        ("simtest6", Style { first: 302, every: 5, velocities: false, ..Style::default() }),
    ] {
        let mut grader = grader(scene);
        let run = planted(&grader, Mistakes::NONE, 11.0, style);
        let verdict = grader.grade(&run).verdict;
        passes(&verdict);
        assert_eq!(verdict.notes, Vec::<String>::new(), "{scene}");
    }
}

#[test]
fn one_ball_without_a_number_passes_and_the_others_are_missed() {
    let mut grader = grader("simtest2");
    let tracks = grader.planted(Mistakes::NONE, 4.0, false);
    let mut text = "t,x,y,z\n".to_owned();
    for frame in 1..=tracks.frames() {
        let [x, y, z] = tracks.state(0, frame).unwrap().position.to_array();
        text += &format!("{},{x},{y},{z}\n", frame as f64 * 0.02);
    }
    let verdict = grader.grade(&recorded(&text)).verdict;
    passes(&verdict);
    let [missing, short] = [
        "5 balls of the reference are not in the table",
        "only the first 4.00 s of 12 s are in the table",
    ];
    assert_eq!(verdict.notes, [missing, short]);
}

#[test]
fn other_units_names_separators_and_decimals_pass() {
    let mut grader = grader("simtest1");
    let tracks = grader.planted(Mistakes::NONE, 3.0, false);
    let mut text = "\u{feff}Frame;Id;Pos X;Position.y;Pz;vx;vy;vz\n".to_owned();
    for ball in 0..tracks.len() {
        for frame in 1..=tracks.frames() {
            let Some(state) = tracks.state(ball, frame) else { continue };
            // In cm, and in cm per frame.
            let velocity = (0.02 * state.velocity).to_array();
            let numbers = state.position.to_array().into_iter().chain(velocity);
            let numbers = numbers.map(|it| format!("{:.4}", 100.0 * it).replace('.', ","));
            let numbers: Vec<String> = numbers.collect();
            text += &format!("{frame};{};{}\r\n", -17_000 - 12 * ball as i32, numbers.join(";"));
        }
    }
    let columns = "t=Frame,x=Pos X".parse().unwrap();
    let reading = Reading { columns, length_unit: 0.01, time_unit: 0.02, ..Reading::default() };
    let verdict = grader.grade(&read(&text, &reading)).verdict;
    passes(&verdict);
    assert_eq!(verdict.balls, 5);
    // Half of the last decimal in three coordinates: 1e-6 m in a frame of 0.02 s.
    assert!(verdict.fit.max_velocity.unwrap() < 1e-4, "{:?}", verdict.fit);
}

#[test]
fn a_column_of_balls_counts_more_than_one_of_indices() {
    let mut grader = grader("simtest2");
    let style = Style { velocities: false, ..Style::default() };
    let text = table(&grader.planted(Mistakes::NONE, 4.0, false), style);
    let numbered = text.lines().enumerate().map(|(number, line)| match number {
        0 => format!("index,{line}\n"),
        number => format!("{number},{line}\n"),
    });
    let numbered: String = numbered.collect();
    let verdict = grader.grade(&recorded(&numbered)).verdict;
    passes(&verdict);
    assert_eq!(verdict.balls, grader.grade(&recorded(&text)).verdict.balls);
}

#[test]
fn a_verdict_does_not_depend_on_the_runs_graded_before() {
    let mut grader = grader("simtest3");
    let long = planted(&grader, Mistakes::NONE, 40.0, Style::default());
    // The largest spread by rounding decides about a ball that the rule does not have.
    let text = table(&grader.planted(Mistakes::NONE, 4.0, true), Style::default());
    let short = recorded(&(text + "3.0,999,0,50,0,0,0,0\n"));
    let alone = grader.grade(&short).verdict;
    grader.grade(&long);
    assert_eq!(grader.grade(&short).verdict, alone);
}

#[test]
fn few_decimals_widen_the_tolerance() {
    let mut grader = grader("simtest1");
    let tracks = grader.planted(Mistakes::NONE, 5.0, false);
    let mut text = "t,ball,x,y,z\n".to_owned();
    for frame in 1..=tracks.frames() {
        let [x, y, z] = tracks.state(0, frame).unwrap().position.to_array();
        text += &format!("{:.2},0,{x:.2},{y:.2},{z:.2}\n", frame as f64 * 0.02);
    }
    let verdict = grader.grade(&recorded(&text)).verdict;
    passes(&verdict);
    assert_eq!(verdict.tolerance, 0.01);
    assert!(
        verdict.notes.iter().any(|note| note.contains("off by 1.0e-2 m")),
        "{:?}",
        verdict.notes
    );
}

#[test]
fn a_clock_that_is_a_frame_late_is_recognised() {
    for (frames, said) in [(1.0, "-0.020 s"), (-1.0, "+0.020 s")] {
        let mut grader = grader("simtest3");
        let style = Style { first: 2, velocities: false, ..Style::default() };
        let text = table(&grader.planted(Mistakes::NONE, 6.0, true), style);
        let reading = Reading { time_offset: frames * 0.02, ..Reading::default() };
        let verdict = grader.grade(&read(&text, &reading)).verdict;
        passes(&verdict);
        assert!(verdict.headline().contains(said), "{}", verdict.headline());
    }
}
