//! Wrong runs: where they depart, at which contact, and which mistake explains them. The program of
//! these runs shares no code with the one that grades them.

mod common;
#[path = "common/student.rs"]
mod student;

use std::path::Path;

use carom_grade::{
    ContactKind, Course, Grader, Mistake, Mistakes, Reading, Recorded, TOLERANCE, Verdict,
};
use carom_scene::{Library, Scene};
use common::{Style, grader, planted, recorded, table};
use student::Slips;

/// Grades a student's program by the table of its recorder.
fn verdict_on(name: &str, slips: Slips) -> Verdict {
    let scene = Library::new().find(name, &[]).unwrap().0;
    let text = student::table(&scene, 10.0, slips);
    let columns = "t=time,ball=sphere".parse().unwrap();
    let reading = Reading { columns, unity: true, ..Reading::default() };
    let run = Recorded::parse(Path::new("run.csv"), text.as_bytes(), &reading).unwrap();
    grader(name).grade(&run).verdict
}

#[test]
fn slips_of_another_program_are_named() {
    let right = Slips::default();
    let slips = [
        ("simtest1", Slips { explicit_euler: true, ..right }, Mistake::ExplicitEuler),
        (
            "simtest2",
            Slips { velocity_stays_local: true, ..right },
            Mistake::VelocityNotTransformed,
        ),
        ("simtest3", Slips { whole_restitution: true, ..right }, Mistake::RestitutionOfWhole),
        ("simtest6", Slips { width_for_height: true, ..right }, Mistake::ExtentSwapped),
        ("simtest6", Slips { no_entering_test: true, ..right }, Mistake::NoEnteringTest),
    ];
    for (scene, slips, mistake) in slips {
        let verdict = verdict_on(scene, slips);
        assert!(!verdict.same && verdict.explained, "{scene}: {verdict:?}");
        assert_eq!(verdict.explanations[0].cause.mistakes, mistake.into(), "{scene}");
    }
}

#[test]
fn a_run_in_unitys_coordinates_is_recognised_if_it_was_not_said() {
    let scene = Library::new().find("simtest3", &[]).unwrap().0;
    let text = student::table(&scene, 6.0, Slips::default());
    let columns = "t=time,ball=sphere".parse().unwrap();
    let reading = Reading { columns, ..Reading::default() };
    let run = Recorded::parse(Path::new("run.csv"), text.as_bytes(), &reading).unwrap();
    let verdict = grader("simtest3").grade(&run).verdict;
    assert!(verdict.same && verdict.headline().contains("z mirrored (--unity)"), "{verdict:?}");
}

#[test]
fn two_slips_at_once_are_named_together() {
    let slips = Slips { explicit_euler: true, whole_restitution: true, ..Slips::default() };
    let verdict = verdict_on("simtest3", slips);
    let both = [Mistake::ExplicitEuler, Mistake::RestitutionOfWhole].into_iter().collect();
    assert_eq!(verdict.explanations[0].cause.mistakes, both);
    assert!(verdict.explanations[0].fit.is_complete());
}

/// Grades a run with a mistake.
fn planted_verdict(scene: &str, mistakes: Mistakes) -> Verdict {
    let mut grader = grader(scene);
    let run = planted(&grader, mistakes, 6.0, Style::default());
    grader.grade(&run).verdict
}

#[test]
fn a_verdict_names_the_contact_where_the_run_departs() {
    let at = |scene: &str, mistake: Mistake| {
        let departure = planted_verdict(scene, mistake.into()).departure.unwrap();
        (departure.ball, departure.contact)
    };
    let (ball, contact) = at("simtest1", Mistake::RestitutionSquared);
    let contact = contact.unwrap();
    assert_eq!((ball.as_str(), contact.kind), ("0", ContactKind::Sphere));
    assert_eq!((contact.collider.as_str(), contact.only_by_mistake), ("SphereCollider", false));
    let (_, contact) = at("simtest5", Mistake::EdgeNormalOfPlane);
    assert_eq!(contact.unwrap().kind, ContactKind::Edge);
    // Drag acts without any contact.
    assert_eq!(at("simtest3", Mistake::DragSign).1, None);
    // An infinite plane is touched where the rule has none.
    let (_, contact) = at("simtest5", Mistake::ExtentIgnored);
    assert!(contact.unwrap().only_by_mistake);
}

#[test]
fn the_first_departure_is_where_a_ball_leaves_the_tolerance() {
    // One ball is shifted by a millimetre for a while; line, ball and distance of the departure are
    // its own.
    let mut grader = grader("simtest1");
    let tracks = grader.planted(Mistakes::NONE, 3.0, false);
    let moved = |(number, line): (usize, &str)| {
        let mut fields: Vec<String> = line.split(',').map(str::to_owned).collect();
        if number >= 100 && fields[1] == "1" {
            fields[2] = (fields[2].parse::<f64>().unwrap() + 1e-3).to_string();
        }
        fields.join(",") + "\n"
    };
    let text: String = table(&tracks, Style::default()).lines().enumerate().map(moved).collect();
    let first =
        text.lines().enumerate().skip(100).find(|(_, line)| line.split(',').nth(1) == Some("1"));
    let verdict = grader.grade(&recorded(&text)).verdict;
    let departure = verdict.departure.unwrap();
    assert_eq!((departure.ball.as_str(), departure.line), ("1", first.unwrap().0 as u64 + 1));
    assert!((departure.distance.unwrap() - 1e-3).abs() < 1e-9, "{:?}", departure.distance);
    assert!(!verdict.explained, "{:?}", verdict.explanations);
}

#[test]
fn mistakes_that_no_simtest_shows_are_named_where_they_can_be_seen() {
    // Balls are thrown up at a plane, touch it and fall back; others fall into a groove of two
    // planes.
    let text = r#"
        name = "groove"
        [simulation]
        rule = "discrete"
        frame_time = 0.02
        spheres_collide = false
        [[forces]]
        gravity = { acceleration = [0.0, -9.81, 0.0] }
        [[emitters]]
        position = [-3.0, 0.0, 0.0]
        period = 0.5
        sphere = { radius = 0.2, velocity = [0.3, 4.3, 0.0] }
        [[emitters]]
        position = [3.0, 2.0, 0.0]
        period = 0.5
        sphere = { radius = 0.2 }
        [[colliders]]
        shape = { rectangle = { size_x = 2.0, size_z = 2.0 } }
        position = [-3.0, 1.0, 0.0]
        restitution = 0.5
        [[colliders]]
        shape = { rectangle = { size_x = 2.0, size_z = 2.0 } }
        position = [2.3, 0.7, 0.0]
        rotation = [0.0, 0.0, -0.3826834, 0.9238795]
        restitution = 0.5
        [[colliders]]
        shape = { rectangle = { size_x = 2.0, size_z = 2.0 } }
        position = [3.7, 0.7, 0.0]
        rotation = [0.0, 0.0, 0.3826834, 0.9238795]
        restitution = 0.5
    "#;
    let scene = Scene::from_toml(text, "groove.toml").unwrap();
    for mistake in [Mistake::FromUnderneath, Mistake::FirstColliderOnly] {
        let mut grader = Grader::new(Course::of(&scene).unwrap(), TOLERANCE);
        // In the groove, single precision would soon move a ball far.
        let tracks = grader.planted(mistake.into(), 4.0, false);
        let run = recorded(&table(&tracks, Style::default()));
        let verdict = grader.grade(&run).verdict;
        assert!(!verdict.same && verdict.explained, "{mistake:?}: {verdict:?}");
        assert_eq!(verdict.explanations[0].cause.mistakes, mistake.into(), "{verdict:?}");
    }
}

#[test]
fn a_run_of_chance_is_explained_by_nothing() {
    let mut grader = grader("simtest1");
    let mut text = "t,ball,x,y,z\n".to_owned();
    for frame in 1..=100 {
        let t = f64::from(frame) * 0.02;
        text += &format!("{t},0,{},{},{}\n", 3.0 * t, 12.0 - 7.0 * t * t, t * t * t);
    }
    let verdict = grader.grade(&recorded(&text)).verdict;
    assert!(!verdict.same && !verdict.explained, "{verdict:?}");
}

#[test]
fn pages_hold_all_that_they_show() {
    let mut grader = grader("simtest5");
    let run = planted(&grader, Mistake::EdgeNormalOfPlane.into(), 4.0, Style::default());
    let graded = grader.grade(&run);
    let page = carom_grade::page(grader.course(), &graded);
    for part in ["edge-normal-of-plane", "departs from the course", "PlaneCollider", "<svg"] {
        assert!(page.contains(part), "{part}");
    }
    assert!(!page.contains("http") && !page.contains("<script") && !page.contains("NaN"), "{page}");
}
