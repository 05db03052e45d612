//! Particle files: what runs write begins scenes again to the bit, files of other programs are read,
//! and what makes no sense is refused with its line.

use std::fs;
use std::path::{Path, PathBuf};

use carom::World;
use carom_scene::recording::{
    ParticleError, ParticleFormat, ParticleImport, ParticleOptions, Trajectory, import_particles,
    read_particles, recover_particles,
};
use carom_scene::{Library, Scene};
use tempfile::TempDir;

const TEXTS: [&str; 2] = ["xyz", "lammpstrj"];
const ENDINGS: [&str; 3] = ["xyz", "lammpstrj", "gsd"];

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
    imported(path, ParticleOptions { radius, ..ParticleOptions::default() })
}

fn imported(path: &Path, options: ParticleOptions) -> Result<ParticleImport, ParticleError> {
    import_particles(path, ParticleFormat::of(path).unwrap(), &options)
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
fn any_frame_of_a_run_begins_a_scene() {
    let folder = TempDir::new().unwrap();
    for ending in ENDINGS {
        let path = folder.path().join(format!("run.{ending}"));
        recorded("periodic", 30, &path);
        let earlier = folder.path().join(format!("earlier.{ending}"));
        let world = recorded("periodic", 8, &earlier);
        let options = ParticleOptions { frame: Some(7), ..ParticleOptions::default() };
        let frame = imported(&path, options).unwrap();
        assert_eq!((frame.time, frame.frames), (Some(world.time()), 30), "{ending}");
        let after = frame.scene.world().unwrap();
        assert_eq!(after.spheres().positions(), world.spheres().positions(), "{ending}");
        let options = ParticleOptions { frame: Some(30), ..ParticleOptions::default() };
        let refused = imported(&path, options).unwrap_err().to_string();
        assert!(refused.ends_with("has no frame 30: its last whole frame is 29"), "{refused}");
        let frames = read_particles(&path, ParticleFormat::of(&path).unwrap()).unwrap();
        assert_eq!((frames.len(), frames[7].time), (30, Some(world.time())));
        assert_eq!(frames[29].sides, [3.0, 3.3, f64::INFINITY]);
        assert_eq!(frames[29].ids, [0, 1]);
    }
}

#[test]
fn an_empty_world_is_a_frame_of_every_format() {
    let folder = TempDir::new().unwrap();
    for ending in ENDINGS {
        let path = folder.path().join(format!("empty.{ending}"));
        let mut trajectory = Trajectory::create(&path).unwrap();
        trajectory.write(&World::default()).unwrap();
        trajectory.finish().unwrap();
        let frames = read_particles(&path, ParticleFormat::of(&path).unwrap()).unwrap();
        assert_eq!((frames.len(), frames[0].ids.len()), (1, 0), "{ending}");
    }
}

#[test]
fn files_keep_to_what_other_readers_expect() {
    let folder = TempDir::new().unwrap();
    let text = |name: &str| {
        let path = folder.path().join(name);
        recorded("simtest4", 3, &path);
        String::from_utf8_lossy(&fs::read(path).unwrap()).into_owned()
    };
    // Plain XYZ has the position after the species.
    let xyz = text("run.xyz");
    assert!(xyz.lines().any(|line| line.starts_with("Properties=species:S:1:pos:R:3:id:I:1:")));
    // LAMMPS names the units once.
    let dump = text("run.lammpstrj");
    assert!(dump.starts_with("ITEM: UNITS\nsi\n"));
    assert_eq!(dump.matches("ITEM: UNITS").count(), 1);
    assert_eq!(dump.matches("ITEM: TIME\n").count(), 3);
    // Each name in the list of GSD has a chunk: these balls do not turn.
    let gsd = text("run.gsd");
    assert!(gsd.contains("particles/position\0particles/velocity\0"));
    assert!(!gsd.contains("particles/orientation") && !gsd.contains("particles/angmom"));
}

#[test]
fn gsd_keeps_every_bit_unless_another_program_changed_the_numbers() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("run.gsd");
    let before = recorded("billiards", 2, &path);
    let format = ParticleFormat::Gsd;
    let exact = read_particles(&path, format).unwrap().remove(1);
    assert_eq!(exact.positions[0], before.spheres().positions()[0].to_array());
    // The first particle moves by a metre in single precision, as a program would write it.
    let mut bytes = fs::read(&path).unwrap();
    let single = (exact.positions[0][0] as f32).to_le_bytes();
    let place = (0..bytes.len() - 3).rfind(|&at| bytes[at..at + 4] == single).unwrap();
    let moved = exact.positions[0][0] as f32 + 1.0;
    bytes[place..place + 4].copy_from_slice(&moved.to_le_bytes());
    fs::write(&path, &bytes).unwrap();
    let changed = read_particles(&path, format).unwrap().remove(1);
    assert_eq!(changed.positions[0][0], f64::from(moved));
    assert_eq!(changed.velocities, exact.velocities);
}

#[test]
fn a_gsd_file_that_is_damaged_is_refused_and_one_cut_short_keeps_its_frames() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("run.gsd");
    recorded("simtest4", 3, &path);
    let whole = fs::read(&path).unwrap();
    let refused = |change: &dyn Fn(&mut Vec<u8>)| {
        let mut bytes = whole.clone();
        change(&mut bytes);
        fs::write(&path, &bytes).unwrap();
        let error = import(&path, None).unwrap_err().to_string();
        error.strip_prefix(&format!("{}: ", path.display())).unwrap().to_owned()
    };
    assert_eq!(refused(&|bytes| bytes.truncate(100)), "is no GSD file");
    assert_eq!(refused(&|bytes| bytes[0] = 0), "is no GSD file");
    assert_eq!(refused(&|bytes| bytes[46] = 9), "version 9.0 of GSD is not read");
    assert_eq!(refused(&|bytes| bytes[112] = b'x'), "its schema is \"xoomd\", expected \"hoomd\"");
    assert_eq!(refused(&|bytes| bytes[15] = 1), "its index reaches beyond the end of the file");
    assert_eq!(refused(&|bytes| bytes[256 + 30] = 99), "entry 0 of its index is invalid");
    // The fourth chunk of a frame holds the positions: whole numbers are none.
    let is_used = |entry: &usize| whole[256 + entry * 32 + 16..][..8] != [0; 8];
    let entries = (0..128).take_while(is_used).count();
    assert_eq!(
        refused(&|bytes| bytes[256 + (entries / 3 * 2 + 3) * 32 + 30] = 3),
        "frame 2: particles/position must be finite real numbers"
    );
    // A frame whose data are there and whose entries are not.
    let mut bytes = whole.clone();
    bytes.extend([7; 1000]);
    fs::write(&path, &bytes).unwrap();
    assert_eq!(import(&path, None).unwrap().frames, 3);
    assert_eq!(recover_particles(&path, ParticleFormat::Gsd).unwrap(), 0);
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
    // Without numbers, LAMMPS writes 0 for all atoms.
    let dump = "ITEM: NUMBER OF ATOMS\n2\nITEM: ATOMS id x y z radius\n0 5 0 0 1\n0 1 0 0 1\n";
    let scene = import(&written(&folder, "unnumbered.dump", dump), None).unwrap().scene;
    assert_eq!(scene.spheres[0].position, [5.0, 0.0, 0.0]);
}

#[test]
fn a_frame_that_is_cut_short_is_left_out_and_can_be_removed() {
    let folder = TempDir::new().unwrap();
    for ending in TEXTS {
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
    assert_eq!(
        of("1\n\nX 0 0 0\n"),
        "a.xyz: its particles have no radius: name one (--radius, radius=)"
    );
    assert_eq!(of("two\n"), "a.xyz:1: expected the number of particles, not \"two\"");
    assert_eq!(
        of(&format!("1\n{radii}\nX 0 0 nan 1\n")),
        "a.xyz:3: column 4 is no finite number: \"nan\""
    );
    assert_eq!(of(&format!("1\n{radii}\nX 0 0 0\n")), "a.xyz:3: expected 5 columns, found 4");
    assert_eq!(
        of(&format!("0\nLattice=\"1 1 0 0 1 0 0 0 1\" {radii}\n")),
        "a.xyz:2: Lattice: a box is read with skewed edges in steady shear only: y along x"
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
        of("ITEM: BOX BOUNDS xy xz yz pp pp pp\n0 1 0\n0 1 0.5\n0 1 0\n"),
        "a.dump:4: a box is read with skewed edges in steady shear only: y along x"
    );
    assert_eq!(
        of("ITEM: ATOMS id x y z\n"),
        "a.dump:1: ITEM: NUMBER OF ATOMS is missing before this line"
    );
    let atoms = "ITEM: NUMBER OF ATOMS\n2\nITEM: ATOMS id x y z\n";
    assert_eq!(
        of(&format!("{atoms}3 0 0 0\n3 1 0 0\n")),
        "a.dump:5: another particle has the id 3, too"
    );
    assert_eq!(
        of(&format!("{atoms}3 0 0 0\n0.5 1 0 0\n")),
        "a.dump:5: the id of a particle must be a whole number, not 0.5"
    );
    let negative = format!("1\n{radii}\nX 0 0 0 -1\n");
    let refused = problem(&folder, "scene.xyz", &negative);
    assert!(refused.contains("spheres[0].radius"), "{refused}");
}
