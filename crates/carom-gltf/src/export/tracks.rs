//! Where bodies are, frame by frame, turned into a track for each body.
//!
//! Frames come one after the other, but an animation holds one body after the other: rows wait in a temporary
//! file until all frames are known.

use std::fs::File;
use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::Path;

use carom::{DQuat, DVec3};

/// Where a body is, and how large.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Placement {
    /// \[m\]
    pub position: DVec3,
    /// Of length 1.
    pub rotation: DQuat,
    /// What its mesh, of size 1, is scaled by \[m\].
    pub scale: [f64; 3],
}

/// One body, through all frames.
#[derive(Debug, Clone)]
pub(super) struct Track {
    /// The number of the body.
    pub number: u64,
    /// The first frame in which it is there, and the one after the last.
    pub frames: std::ops::Range<u32>,
    /// From which frames on it has which scale.
    pub scales: Vec<(u32, [f64; 3])>,
    /// Whether its position changes.
    pub moves: bool,
    /// Whether its rotation changes.
    pub turns: bool,
    last: [f32; Row::NUMBERS],
}

impl Track {
    /// Number of frames in which it is there.
    pub fn len(&self) -> usize {
        self.frames.len()
    }

    /// Bytes of its keys.
    pub fn bytes(&self) -> u64 {
        let numbers = 3 * u64::from(self.moves) + 4 * u64::from(self.turns);
        4 * numbers * self.len() as u64
    }
}

/// Position x, y, z \[m\] and rotation x, y, z, w, in 32 bits.
struct Row;

impl Row {
    const NUMBERS: usize = 7;
    const BYTES: usize = 4 * Self::NUMBERS;

    /// Of two opposite quaternions, which turn alike, the one nearer to that of `last`: what is between two
    /// keys is then the shorter way from one to the other.
    fn of(place: &Placement, last: Option<&[f32; Self::NUMBERS]>) -> [f32; Self::NUMBERS] {
        let [x, y, z] = place.position.to_array().map(|it| it as f32);
        let turn = place.rotation.to_array().map(|it| it as f32);
        let along = last.map_or(1.0, |last| {
            last[3..].iter().zip(turn).map(|(before, now)| before * now).sum::<f32>()
        });
        let [a, b, c, d] = if along < 0.0 { turn.map(|it| -it) } else { turn };
        [x, y, z, a, b, c, d]
    }
}

/// Tracks on their way.
pub(super) struct Tracks {
    file: BufWriter<File>,
    tracks: Vec<Track>,
    /// Indices of the tracks of bodies that are there, in order.
    alive: Vec<usize>,
    /// The rows before each frame.
    frame_starts: Vec<u64>,
    /// Bytes of the keys of all tracks.
    bytes: u64,
}

impl Tracks {
    /// Bytes of rows that are in memory at a time.
    const BLOCK: usize = 64 << 20;

    /// Without frames; its rows wait in this folder.
    pub fn create(folder: &Path) -> io::Result<Self> {
        let file = BufWriter::new(tempfile::tempfile_in(folder)?);
        let (tracks, alive) = (Vec::new(), Vec::new());
        Ok(Self { file, tracks, alive, frame_starts: vec![0], bytes: 0 })
    }

    /// All tracks, in the order of the numbers of their bodies.
    pub fn tracks(&self) -> &[Track] {
        &self.tracks
    }

    /// Bytes of the keys of all tracks.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Adds a frame: bodies in the order of their numbers, which are never given again.
    pub fn push(&mut self, bodies: impl Iterator<Item = (u64, Placement)>) -> io::Result<()> {
        let frame = self.frame_starts.len() as u32 - 1;
        let before = std::mem::take(&mut self.alive);
        let mut before = before.into_iter().peekable();
        let mut rows = 0;
        for (number, place) in bodies {
            // What comes before it in the order is no longer there.
            while before.next_if(|&index| self.tracks[index].number < number).is_some() {}
            let index = match before.next_if(|&index| self.tracks[index].number == number) {
                Some(index) => index,
                None => {
                    let frames = frame..frame;
                    let scales = vec![(frame, place.scale)];
                    let last = Row::of(&place, None);
                    let (moves, turns) = (false, false);
                    self.tracks.push(Track { number, frames, scales, moves, turns, last });
                    self.tracks.len() - 1
                }
            };
            self.alive.push(index);
            let track = &mut self.tracks[index];
            self.bytes -= track.bytes();
            let row = Row::of(&place, Some(&track.last));
            track.frames.end = frame + 1;
            track.moves |= row[..3] != track.last[..3];
            track.turns |= row[3..] != track.last[3..];
            track.last = row;
            if track.scales.last().is_some_and(|last| last.1 != place.scale) {
                track.scales.push((frame, place.scale));
            }
            self.bytes += track.bytes();
            row.iter().try_for_each(|number| self.file.write_all(&number.to_le_bytes()))?;
            rows += 1;
        }
        let start = self.frame_starts.last().copied().unwrap_or(0);
        self.frame_starts.push(start + rows);
        Ok(())
    }

    /// Writes the keys of all tracks: of each the positions, if it moves, and then the rotations, if it turns.
    pub fn write_keys(self, out: &mut impl Write) -> io::Result<()> {
        let Self { file, tracks, frame_starts, .. } = self;
        let mut file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
        // Rows of each frame that belong to the tracks before a block.
        let mut skipped = vec![0; frame_starts.len() - 1];
        let mut rest = &tracks[..];
        while !rest.is_empty() {
            let (block, later) = rest.split_at(block_len(rest, Self::BLOCK));
            rest = later;
            let keys = read_block(&mut file, block, &frame_starts, &mut skipped)?;
            for (track, rows) in block.iter().zip(&keys) {
                let rows = || rows.chunks_exact(Row::BYTES);
                if track.moves {
                    rows().try_for_each(|row| out.write_all(&row[..12]))?;
                }
                if track.turns {
                    rows().try_for_each(|row| out.write_all(&row[12..]))?;
                }
            }
        }
        Ok(())
    }
}

/// How many of these tracks fit into so many bytes, one at least.
fn block_len(tracks: &[Track], most: usize) -> usize {
    let mut bytes = 0;
    let fits = tracks.iter().take_while(|track| {
        bytes += track.len() * Row::BYTES;
        bytes <= most
    });
    fits.count().max(1)
}

/// The rows of each track of a block.
fn read_block(
    file: &mut File,
    block: &[Track],
    frame_starts: &[u64],
    skipped: &mut [u64],
) -> io::Result<Vec<Vec<u8>>> {
    let is_still = |track: &Track| !track.moves && !track.turns;
    let needed = |track: &Track| if is_still(track) { 0 } else { track.len() * Row::BYTES };
    let mut keys: Vec<Vec<u8>> =
        block.iter().map(|track| Vec::with_capacity(needed(track))).collect();
    let first = block.iter().map(|track| track.frames.start).min().unwrap_or(0);
    let end = block.iter().map(|track| track.frames.end).max().unwrap_or(0);
    let mut rows = Vec::new();
    for frame in first..end {
        let there = || (0..block.len()).filter(|&i| block[i].frames.contains(&frame));
        let start = frame_starts[frame as usize] + skipped[frame as usize];
        let count = there().count();
        skipped[frame as usize] += count as u64;
        if there().all(|i| is_still(&block[i])) {
            continue;
        }
        file.seek(SeekFrom::Start(start * Row::BYTES as u64))?;
        rows.resize(count * Row::BYTES, 0);
        file.read_exact(&mut rows)?;
        for (i, row) in there().zip(rows.chunks_exact(Row::BYTES)) {
            if !is_still(&block[i]) {
                keys[i].extend_from_slice(row);
            }
        }
    }
    Ok(keys)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64) -> Placement {
        Placement { position: DVec3::X * x, rotation: DQuat::IDENTITY, scale: [1.0; 3] }
    }

    /// Body 0 is there throughout, 1 in the first frame, 2 rests from the second on, 3 moves from there on.
    fn tracks() -> Tracks {
        let mut tracks = Tracks::create(Path::new(".")).unwrap();
        let frames = [
            vec![(0, at(0.0)), (1, at(10.0))],
            vec![(0, at(1.0)), (2, at(20.0)), (3, at(30.0))],
            vec![(0, at(2.0)), (2, at(20.0)), (3, at(31.0))],
        ];
        frames.into_iter().for_each(|frame| tracks.push(frame.into_iter()).unwrap());
        tracks
    }

    #[test]
    fn each_body_has_its_own_places_in_order() {
        let tracks = tracks();
        let frames: Vec<_> = tracks.tracks().iter().map(|it| it.frames.clone()).collect();
        assert_eq!(frames, [0..3, 0..1, 1..3, 1..3]);
        let bytes = tracks.bytes();
        let mut out = Vec::new();
        tracks.write_keys(&mut out).unwrap();
        assert_eq!(out.len() as u64, bytes);
        let x: Vec<f32> = out
            .chunks_exact(12)
            .map(|it| f32::from_le_bytes([it[0], it[1], it[2], it[3]]))
            .collect();
        assert_eq!(x, [0.0, 1.0, 2.0, 30.0, 31.0]);
    }

    #[test]
    fn blocks_of_one_track_give_what_one_block_gives() {
        let Tracks { file, tracks, frame_starts, .. } = tracks();
        let mut file = file.into_inner().unwrap();
        let whole = read_block(&mut file, &tracks, &frame_starts, &mut [0; 3]).unwrap();
        let mut skipped = [0; 3];
        let mut one = |it| read_block(&mut file, it, &frame_starts, &mut skipped).unwrap();
        let single: Vec<_> = tracks.chunks(block_len(&tracks, 1)).flat_map(&mut one).collect();
        assert_eq!(single, whole);
    }

    #[test]
    fn a_turn_goes_the_shorter_way() {
        let mut tracks = Tracks::create(Path::new(".")).unwrap();
        let turned = |rotation| Placement { rotation, ..at(0.0) };
        let quarter = DQuat::from_xyzw(0.0, 0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt());
        for rotation in [quarter, -quarter] {
            tracks.push([(0, turned(rotation))].into_iter()).unwrap();
        }
        assert!(!tracks.tracks()[0].turns, "the opposite quaternion is the same rotation");
    }
}
