//! Unfinished files of killed runs, which are recovered.

use std::error::Error;
use std::fs;
use std::io;
use std::path::Path;

use carom_gltf::{Animation, recover_animation};
use carom_scene::Library;
use carom_scene::recording::records::{HEAD, Magic, RecordWriter, Words, scan};
use carom_scene::recording::{RecoveryError, Trajectory, recover};
use proptest::prelude::*;
use proptest::sample::{Index, select};

use crate::fault::{Fault, check_error};
use crate::mutation::mutated;
use crate::target::{Answer, Target};

pub const TARGET: Target = Target {
    name: "unfinished",
    about: "unfinished NPZ files and animations with a few things wrong, their checksums right or not",
    campaign: 5_000,
    cases: || prop_oneof![mutated(files()), with_checksums()].boxed(),
    check,
};

/// Numbers that no record head may have.
const WORDS: [u64; 6] = [0, 1, 4095, 1 << 40, u64::MAX / 8, u64::MAX];

fn files() -> Vec<Vec<u8>> {
    let made = ["npz", "glb"].map(unfinished);
    made.into_iter().map(|file| file.expect("a run can be recorded here")).collect()
}

/// Returns the unfinished file of a run of some frames with an emitter.
fn unfinished(kind: &str) -> Result<Vec<u8>, Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run").with_extension(kind);
    let (scene, _) = Library::new().find("simtest3", &[])?;
    let mut world = scene.world()?;
    let mut recording = match kind {
        "glb" => {
            let animation = Animation::create(&path, &scene, &world)?;
            Trajectory::in_format(&path, Box::new(animation))
        }
        _ => Trajectory::create(&path)?,
    };
    for _ in 0..12 {
        world.step(scene.simulation.frame_time)?;
        recording.write(&world)?;
    }
    drop(recording);
    Ok(fs::read(folder.path().join(format!("run.{kind}.0.unfinished")))?)
}

/// A file as a list of its records.
#[derive(Debug, Clone)]
struct Records {
    magic: Vec<u8>,
    list: Vec<(Words, Vec<u8>)>,
}

impl Records {
    fn of(bytes: &[u8]) -> io::Result<Self> {
        let mut file = tempfile::tempfile()?;
        io::Write::write_all(&mut file, bytes)?;
        let magic: Magic = bytes.first_chunk().copied().unwrap_or_default();
        let mut list = Vec::new();
        let is_animation = magic.starts_with(b"carom glb");
        let length = |words: &Words| {
            let [_, spheres, bits] = *words;
            // Of NPZ files: numbers of 8 bytes, of each sphere.
            let columns = 7 + 7 * (bits & 1) + 2 * (bits >> 1);
            Some(if is_animation { words.iter().sum() } else { 8 * columns * spheres })
        };
        scan(&mut file, &magic, length, |start, words| {
            let body = (start + HEAD) as usize;
            list.push((*words, body..body + length(words).unwrap_or(0) as usize));
        })?;
        let list = list.into_iter().map(|(words, body)| (words, bytes[body].to_vec())).collect();
        Ok(Self { magic: magic.to_vec(), list })
    }

    fn to_bytes(&self) -> io::Result<Vec<u8>> {
        let (mut bytes, mut chunk) = (self.magic.clone(), Vec::new());
        for (words, body) in &self.list {
            let mut record = RecordWriter::begin(&mut chunk, &mut bytes, *words);
            record.push(body)?;
            record.end()?;
        }
        Ok(bytes)
    }
}

/// Returns the parts of the body of a record: JSON, arrays and rows for an animation, one for an
/// NPZ file.
fn parts((words, body): &(Words, Vec<u8>), is_animation: bool) -> Vec<Vec<u8>> {
    if !is_animation {
        return vec![body.clone()];
    }
    let (json, rest) = body.split_at(words[0] as usize);
    let (arrays, rows) = rest.split_at(words[1] as usize);
    [json, arrays, rows].map(<[u8]>::to_vec).to_vec()
}

/// Draws files in which one frame has another part, another head or another place, with valid
/// checksums.
fn with_checksums() -> impl Strategy<Value = Vec<u8>> {
    let [npz, animation] =
        &files().iter().filter_map(|it| Records::of(it).ok()).collect::<Vec<_>>()[..]
    else {
        unreachable!("one of each kind")
    };
    prop_oneof![1 => changed(npz.clone(), false), 3 => changed(animation.clone(), true)]
}

/// Draws files like this one with a mistake in a record.
fn changed(file: Records, is_animation: bool) -> impl Strategy<Value = Vec<u8>> {
    let all: Vec<Vec<Vec<u8>>> = file.list.iter().map(|it| parts(it, is_animation)).collect();
    let of_place = |place: usize| mutated(all.iter().map(|parts| parts[place].clone()).collect());
    let count = all[0].len();
    let part =
        (0..count).map(|place| of_place(place).prop_map(move |part| Some((place, part))).boxed());
    let part = proptest::strategy::Union::new(part.chain([Just(None).boxed()]));
    let word = prop_oneof![4 => Just(None), 1 => (0..3usize, select(&WORDS[..])).prop_map(Some)];
    let at = any::<Index>;
    (at(), at(), part, word).prop_map(move |(place, other, part, word)| {
        let Records { magic, mut list } = file.clone();
        let (place, other) = (place.index(list.len()), other.index(list.len()));
        if let Some((which, part)) = part {
            let mut parts = all[place].clone();
            parts[which] = part;
            if is_animation {
                let lengths: Vec<u64> = parts.iter().map(|part| part.len() as u64).collect();
                list[place].0.copy_from_slice(&lengths);
            }
            list[place].1 = parts.concat();
        } else {
            list.swap(place, other);
        }
        if let Some((which, word)) = word {
            list[place].0[which] = word;
        }
        Records { magic, list }.to_bytes().unwrap_or_default()
    })
}

fn check(case: &[u8]) -> Result<Answer, Fault> {
    let failed = |error: io::Error| Fault::Law(format!("cannot be tried: {error}"));
    let folder = tempfile::tempdir().map_err(failed)?;
    let (left, target) = (folder.path().join("t.0.unfinished"), folder.path().join("t"));
    fs::write(&left, case).map_err(failed)?;
    let recovered = match recover(&left, &target) {
        Err(RecoveryError::Foreign { .. }) => recover_animation(&left, &target),
        recovered => recovered,
    };
    let law = |holds: bool, text: &str| match holds {
        true => Ok(()),
        false => Err(Fault::Law(text.to_owned())),
    };
    match recovered {
        Ok(recovered) => {
            law(is_whole(&target).map_err(failed)?, "the complete file is not whole")?;
            law(left.exists() == recovered.is_damaged, "only what is damaged stays")?;
            Ok(Answer::Accepted)
        }
        Err(error) => {
            law(!target.exists(), "there is a complete file in spite of an error")?;
            let is_same = fs::read(&left).map_err(failed)? == case;
            law(is_same, "the unfinished file is another after an error")?;
            check_error(&error.to_string()).map(|()| Answer::Refused)
        }
    }
}

/// Returns whether a .glb file is as long as it says, or an NPZ file has its end.
fn is_whole(path: &Path) -> io::Result<bool> {
    let bytes = fs::read(path)?;
    let word = |at: usize| bytes.get(at..at + 4).and_then(|it| it.try_into().ok());
    Ok(match bytes.starts_with(b"glTF") {
        true => word(8).map(u32::from_le_bytes) == u32::try_from(bytes.len()).ok(),
        // The end of the list of files of an archive.
        false => bytes.windows(4).any(|it| it == b"PK\x05\x06"),
    })
}
