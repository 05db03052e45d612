//! What killed runs left, which is recovered.

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

/// Numbers that no head has.
const WORDS: [u64; 6] = [0, 1, 4095, 1 << 40, u64::MAX / 8, u64::MAX];

fn files() -> Vec<Vec<u8>> {
    ["npz", "glb"].into_iter().filter_map(|kind| unfinished(kind).ok()).collect()
}

/// What is left of a run of some frames with an emitter.
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

/// A file as its records.
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

/// Files of which one frame has another body, another head, or is elsewhere, with the checksums of that.
fn with_checksums() -> impl Strategy<Value = Vec<u8>> {
    let files: Vec<Records> = files().iter().filter_map(|it| Records::of(it).ok()).collect();
    let bodies = files.iter().flat_map(|it| it.list.iter().map(|record| record.1.clone()));
    let body = prop_oneof![2 => mutated(bodies.collect()).prop_map(Some), 1 => Just(None)];
    let word = prop_oneof![Just(None), (0..3usize, select(&WORDS[..])).prop_map(Some)];
    let at = any::<Index>;
    (at(), at(), at(), body, word).prop_map(move |(file, place, other, body, word)| {
        let mut file = file.get(&files).clone();
        let list = &mut file.list;
        let (place, other) = (place.index(list.len()), other.index(list.len()));
        if let Some(body) = body {
            // The last part is as long as the body has it.
            let [first, second, _] = list[place].0;
            let rest = (body.len() as u64).saturating_sub(first.saturating_add(second));
            let is_animation = file.magic.starts_with(b"carom glb");
            list[place].0[2] = if is_animation { rest } else { list[place].0[2] };
            list[place].1 = body;
        } else {
            list.swap(place, other);
        }
        if let Some((which, word)) = word {
            list[place].0[which] = word;
        }
        file.to_bytes().unwrap_or_default()
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

/// Whether a .glb file is as long as it says, or an NPZ file has its end.
fn is_whole(path: &Path) -> io::Result<bool> {
    let bytes = fs::read(path)?;
    let word = |at: usize| bytes.get(at..at + 4).and_then(|it| it.try_into().ok());
    Ok(match bytes.starts_with(b"glTF") {
        true => word(8).map(u32::from_le_bytes) == u32::try_from(bytes.len()).ok(),
        // The end of the list of files of an archive.
        false => bytes.windows(4).any(|it| it == b"PK\x05\x06"),
    })
}
