//! Which drawings, scenes and random mazes are valid.

mod common;

use carom_maze::{
    BUILT_IN_DRAWINGS, MOST_CELLS_PER_SIDE, Maze, MazeError, Role, TextProblem, random_text,
};
use common::{open_floor, wall};

/// Returns place and problem of an invalid drawing.
fn problem(text: &str) -> (Option<(usize, usize)>, TextProblem) {
    match Maze::from_text(text, "test") {
        Err(MazeError::Text { name, place, problem }) if name == "test" => (place, problem),
        other => panic!("{other:?}"),
    }
}

#[test]
fn errors_of_drawings_tell_line_and_column() {
    for (text, place, expected) in [
        ("####\n#Sx#\n#E##", Some((2, 3)), TextProblem::UnknownCharacter('x')),
        ("title: a\n\n####\n#S\t#", Some((4, 3)), TextProblem::UnknownCharacter('\t')),
        ("walls: none\n#SE#", Some((1, 1)), TextProblem::UnknownWalls),
        (
            "#####\n#S E#\n#  S#\n#####",
            Some((3, 4)),
            TextProblem::SecondStart { line: 2, column: 2 },
        ),
        ("####\n# E#\n####", None, TextProblem::NoStart),
        ("####\n#S #\n####", None, TextProblem::NoEnd),
        ("######\n#S# E#\n######", Some((2, 2)), TextProblem::NoWay),
        ("#######\n#S E#o#\n#######", Some((2, 6)), TextProblem::NoWayTo),
        ("", None, TextProblem::Empty),
        ("title: nothing\n\n  \n", None, TextProblem::Empty),
    ] {
        assert_eq!(problem(text), (place, expected), "{text:?}");
    }
    assert_eq!(problem(&"#\n".repeat(99)), (Some((82, 1)), TextProblem::TooLarge));
    assert_eq!(problem(&"#".repeat(99)), (Some((1, 82)), TextProblem::TooLarge));
}

#[test]
fn an_error_reads_like_that_of_a_compiler() {
    let error = Maze::from_text("####\n#Sx#\n#E##", "my.txt").unwrap_err().to_string();
    assert!(error.starts_with("my.txt:2:3: unknown character 'x'; a maze is drawn"), "{error}");
}

#[test]
fn ways_between_corners_are_too_narrow_for_the_ball() {
    let (_, found) = problem("####\n#S##\n##E#\n####");
    assert_eq!(found, TextProblem::NoWay);
}

#[test]
fn a_start_in_the_place_of_a_thin_wall_is_too_narrow() {
    let (place, found) = problem("walls: thin\n#####\n#####\n#S  E\n#####");
    assert_eq!((place, found), (Some((4, 2)), TextProblem::NarrowStart));
}

#[test]
fn a_drawing_says_what_is_where() {
    let text = "title: Corner\n#####\n#S.o#\n#  E#\n#####\n";
    let maze = Maze::from_text(text, "corner").unwrap();
    assert_eq!(maze.title(), "Corner");
    let collectible = maze.collectibles().next().unwrap();
    // Two cells of 1.45 m to the right of the start, at the height of the ball on the ground.
    let way = collectible - maze.start();
    assert!((way.x - 2.9).abs() < 1e-12 && way.z.abs() < 1e-12, "{way}");
    assert_eq!(maze.start().y, maze.ball_radius());
    assert_eq!(maze.roles().iter().filter(|role| **role == Role::EndWall).count(), 1);
}

#[test]
fn runs_of_walls_are_few_boxes() {
    let maze = Maze::from_text("######\n#S  E#\n######\n", "hall").unwrap();
    let walls = maze.roles().iter().filter(|role| **role == Role::Wall).count();
    assert_eq!(walls, 4);
}

#[test]
fn a_camera_shows_the_whole_maze() {
    for maze in [Maze::random(1, 3, 9).unwrap(), Maze::random(1, 9, 3).unwrap()] {
        let camera = maze.scene().camera.clone().unwrap();
        let into_view = carom::DQuat::from_array(camera.rotation).inverse();
        let half_height = libm::tan(0.5 * camera.vertical_fov_degrees.to_radians());
        for collider in &maze.scene().colliders {
            let seen = carom::DVec3::from_array(collider.position)
                - carom::DVec3::from_array(camera.position);
            let seen = into_view * seen;
            assert!(seen.z < 0.0);
            assert!(seen.y.abs() < -seen.z * half_height, "{}", collider.name);
            assert!(seen.x.abs() < -seen.z * half_height * 16.0 / 9.0, "{}", collider.name);
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_maze_and_another_seed_another() {
    assert_eq!(random_text(5, 7, 6).unwrap(), random_text(5, 7, 6).unwrap());
    assert_ne!(random_text(5, 7, 6).unwrap(), random_text(6, 7, 6).unwrap());
}

#[test]
fn a_random_maze_is_the_maze_that_its_drawing_says() {
    let maze = Maze::random(5, 4, 3).unwrap();
    let name = &maze.scene().name;
    let drawn = Maze::from_text(&random_text(5, 4, 3).unwrap(), name).unwrap();
    assert_eq!(drawn.scene(), maze.scene());
}

#[test]
fn random_mazes_of_many_seeds_and_sizes_can_be_won() {
    for seed in 0..12 {
        for (columns, rows) in [(2, 2), (5, 2), (4, 5)] {
            // `random` refuses a maze without a way to the end.
            Maze::random(seed, columns, rows).unwrap();
        }
    }
}

#[test]
fn collectibles_of_random_mazes_are_in_dead_ends() {
    let text = random_text(11, 8, 8).unwrap();
    let lines: Vec<&[u8]> = text.lines().skip(2).map(str::as_bytes).collect();
    let mut count = 0;
    for z in 0..lines.len() {
        for x in (0..lines[z].len()).filter(|&x| lines[z][x] == b'o') {
            let around = [lines[z][x - 1], lines[z][x + 1], lines[z - 1][x], lines[z + 1][x]];
            assert_eq!(around.iter().filter(|&&it| it == b'#').count(), 3);
            count += 1;
        }
    }
    assert!(count >= 3, "{text}");
}

#[test]
fn a_random_maze_of_no_size_or_too_large_is_refused() {
    for (columns, rows) in [(0, 5), (5, 1), (MOST_CELLS_PER_SIDE + 1, 5)] {
        let error = random_text(1, columns, rows).unwrap_err();
        assert!(matches!(error, MazeError::Size { .. }), "{error}");
    }
}

#[test]
fn built_in_drawings_are_mazes() {
    for (name, text) in BUILT_IN_DRAWINGS {
        Maze::from_text(text, name).unwrap();
    }
}

#[test]
fn a_scene_without_what_a_maze_needs_is_refused() {
    let error = |change: fn(&mut carom_scene::Scene)| {
        let mut scene = open_floor(0.0);
        change(&mut scene);
        Maze::from_scene(&scene).unwrap_err()
    };
    let found = error(|scene| scene.colliders.truncate(1));
    assert!(matches!(found, MazeError::NoEndWall { .. }), "{found}");
    let found = error(|scene| scene.spheres.push(scene.spheres[0].clone()));
    assert!(matches!(found, MazeError::OneBall { count: 2, .. }), "{found}");
    let found = error(|scene| scene.forces.clear());
    assert!(matches!(found, MazeError::NoGravity { .. }), "{found}");
    let found = error(|scene| scene.spheres[0].position[0] = 11.0);
    assert!(matches!(found, MazeError::NoGround { .. }), "{found}");
    let found = error(|scene| {
        scene.colliders.push(wall("wall", [0.5, 0.5, 0.0], [0.2, 1.0, 1.0]));
    });
    assert!(matches!(found, MazeError::Scene(_)), "{found}");
}
