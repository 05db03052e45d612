//! Particle files: what runs write begins scenes again to the bit, files of other programs are read,
//! and what makes no sense is refused with its line.

use std::fs;
use std::path::{Path, PathBuf};

use carom::World;
use carom_scene::recording::{
    ParticleError, ParticleFormat, ParticleImport, ParticleOptions, Trajectory, import_particles,
    recover_particles,
};
use carom_scene::{Library, Scene};
use tempfile::TempDir;

const ENDINGS: [&str; 2] = ["xyz", "lammpstrj"];

/// A built-in scene, or balls in a box that is periodic along two axes.
fn scene(name: &str) -> Scene {
    if name != "periodic" {
        return Library::new().find(name, &[]).unwrap().0;
    }
    let ball = |x: f64| {
        format!("[[spheres]]\nposition = [{x}, 0, 0]\nradius = 0.3\nvelocity = [3, 2, {x}]\n")
    };
    let size =
        "[simulation]\nframe_time = 0.1\nboundary = { periodic = { size = [3, 3.3, inf] } }\n";
    Scene::from_toml(&format!("{size}{}{}", ball(-0.7), ball(1.1)), "text").unwrap()
}

/// Runs a scene and records every frame.
fn recorded(name: &str, frames: usize, path: &Path) -> World {
    let scene = scene(name);
    let mut world = scene.world().unwrap();
    let mut trajectory = Trajectory::create(path).unwrap();
    for _ in 0..frames {
        world.step(scene.simulation.frame_time).unwrap();
        trajectory.write(&world).unwrap();
    }
    trajectory.finish().unwrap();
    world
}

fn import(path: &Path, radius: Option<f64>) -> Result<ParticleImport, ParticleError> {
    let format = ParticleFormat::of(path).unwrap();
    import_particles(path, format, &ParticleOptions { radius, ..ParticleOptions::default() })
}

fn written(folder: &TempDir, name: &str, text: &str) -> PathBuf {
    let path = folder.path().join(name);
    fs::write(&path, text).unwrap();
    path
}

fn problem(folder: &TempDir, name: &str, text: &str) -> String {
    let error = import(&written(folder, name, text), None).unwrap_err().to_string();
    error.strip_prefix(&folder.path().display().to_string()).unwrap()[1..].to_owned()
}

#[test]
fn the_last_frame_of_a_run_begins_a_scene_to_the_bit() {
    let folder = TempDir::new().unwrap();
    // Balls that appear during the run, that turn, and a periodic box.
    for (name, frames) in [("simtest3", 60), ("billiards", 5), ("periodic", 20)] {
        for ending in ENDINGS {
            let path = folder.path().join(format!("{name}.{ending}"));
            let before = recorded(name, frames, &path);
            let imported = import(&path, None).unwrap();
            assert_eq!(imported.frames, frames as u64, "{name}.{ending}");
            assert_eq!(imported.time, Some(before.time()));
            let text = imported.scene.to_toml();
            let after = Scene::from_toml(&text, "text").unwrap().world().unwrap();
            let (one, other) = (before.spheres(), after.spheres());
            assert_eq!(one.positions(), other.positions(), "{name}.{ending}");
            assert_eq!(one.velocities(), other.velocities());
            assert_eq!((one.radii(), one.masses()), (other.radii(), other.masses()));
            if before.has_spin() {
                assert_eq!(one.angular_velocities(), other.angular_velocities());
                assert_eq!(one.orientations(), other.orientations());
            }
            assert_eq!(before.settings().boundary, after.settings().boundary);
        }
    }
}

#[test]
fn files_of_other_programs_are_read() {
    let folder = TempDir::new().unwrap();
    let plain = written(&folder, "plain.xyz", "2\nwater\nO 0 0 0\nH 0 0 3");
    let scene = import(&plain, Some(0.5)).unwrap().scene;
    assert_eq!(scene.spheres[1].position, [0.0, 0.0, 3.0]);
    assert_eq!((scene.spheres[1].radius, scene.spheres[1].mass), (Some(0.5), None));
    // As ASE writes it: another order, columns that are not read, a box from the origin.
    let extended = "2\nProperties=pos:R:3:forces:R:3:species:S:1:velo:R:3 note=\"a = b\" \
                    Lattice=\"4 0 0 0 4 0 0 0 8\" pbc=\"T T F\"\n\
                    1 1 1 9 9 9 C 0.5 0 0\n3 3 5 9 9 9 C 0 0 0\n";
    let scene = import(&written(&folder, "ase.extxyz", extended), Some(0.5)).unwrap().scene;
    let world = scene.world().unwrap();
    let period = carom::DVec3::new(4.0, 4.0, f64::INFINITY);
    assert_eq!(world.settings().boundary, carom::Boundary::Periodic { size: period });
    assert_eq!(scene.spheres[0].position, [-1.0, -1.0, 1.0]);
    assert_eq!(scene.spheres[0].velocity, [0.5, 0.0, 0.0]);
    // Scaled positions, diameters, atoms out of order, an older frame before.
    let dump = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n0\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n\
                0 1\nITEM: ATOMS id type xs ys zs\nITEM: TIMESTEP\n100\nITEM: NUMBER OF ATOMS\n2\n\
                ITEM: BOX BOUNDS pp pp ff\n-2 2\n0 8\n0 1\nITEM: ATOMS diameter xs ys zs id vx vy vz\n\
                1 0.75 0.5 0.5 7 1 0 0\n0.5 0.25 0.25 0 3 0 0 0\n";
    let imported = import(&written(&folder, "lammps.dump", dump), None).unwrap();
    let spheres = &imported.scene.spheres;
    assert_eq!((imported.frames, imported.time), (2, None));
    assert_eq!([spheres[0].radius, spheres[1].radius], [Some(0.25), Some(0.5)]);
    assert_eq!(spheres[1].position, [1.0, 0.0, 0.5]);
    assert_eq!(spheres[0].position, [-1.0, -2.0, 0.0]);
}

#[test]
fn a_frame_that_is_cut_short_is_left_out_and_can_be_removed() {
    let folder = TempDir::new().unwrap();
    for ending in ENDINGS {
        let path = folder.path().join(format!("run.{ending}"));
        recorded("simtest4", 3, &path);
        let whole = fs::read(&path).unwrap();
        let frame = whole.len() / 3;
        for length in [whole.len() - 1, whole.len() - frame / 2, whole.len() - frame + 9] {
            fs::write(&path, &whole[..length]).unwrap();
            let imported = import(&path, None).unwrap();
            assert_eq!((imported.frames, imported.omissions.len()), (2, 1), "{ending} {length}");
            let format = ParticleFormat::of(&path).unwrap();
            let cut = recover_particles(&path, format).unwrap();
            assert!(cut > 0);
            assert_eq!(import(&path, None).unwrap().omissions, []);
            assert_eq!(recover_particles(&path, format).unwrap(), 0);
        }
        // Without a whole frame nothing is taken out.
        fs::write(&path, &whole[..frame / 2]).unwrap();
        import(&path, None).unwrap_err();
        recover_particles(&path, ParticleFormat::of(&path).unwrap()).unwrap_err();
        assert_eq!(fs::read(&path).unwrap().len(), frame / 2);
    }
}

#[test]
fn what_makes_no_sense_is_refused_with_its_line() {
    let folder = TempDir::new().unwrap();
    let of = |text: &str| problem(&folder, "a.xyz", text);
    let radii = "Properties=species:S:1:pos:R:3:radius:R:1";
    assert_eq!(of("1\n\nX 0 0 0\n"), "a.xyz: its particles have no radius: name one with --radius");
    assert_eq!(of("two\n"), "a.xyz:1: expected the number of particles, not \"two\"");
    assert_eq!(
        of(&format!("1\n{radii}\nX 0 0 nan 1\n")),
        "a.xyz:3: column 4 is no finite number: \"nan\""
    );
    assert_eq!(of(&format!("1\n{radii}\nX 0 0 0\n")), "a.xyz:3: expected 5 columns, found 4");
    assert_eq!(
        of(&format!("0\nLattice=\"1 1 0 0 1 0 0 0 1\" {radii}\n")),
        "a.xyz:2: Lattice: a box with edges along other lines than the axes is not read"
    );
    assert_eq!(
        of("1\nProperties=species:S:1\nX\n"),
        "a.xyz:2: Properties has no pos:R:3, the positions"
    );
    assert_eq!(of(""), "a.xyz has no whole frame");
    assert_eq!(of("18446744073709551615\n\nX 0 0 0\n"), "a.xyz has no whole frame");
    let of = |text: &str| problem(&folder, "a.dump", text);
    assert_eq!(of("hello\n"), "a.dump:1: expected a line that begins with ITEM:, not \"hello\"");
    assert_eq!(
        of("ITEM: BOX BOUNDS xy xz yz pp pp pp\n0 1 0\n"),
        "a.dump:1: a box with skewed edges is not read"
    );
    assert_eq!(
        of("ITEM: ATOMS id x y z\n"),
        "a.dump:1: ITEM: NUMBER OF ATOMS is missing before this line"
    );
    let negative = format!("1\n{radii}\nX 0 0 0 -1\n");
    let refused = problem(&folder, "scene.xyz", &negative);
    assert!(refused.contains("spheres[0].radius"), "{refused}");
}
