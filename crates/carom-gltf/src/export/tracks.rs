//! Collects the states of bodies frame by frame, and writes a track for each body.
//!
//! Frames arrive one by one, but an animation stores body after body. Rows stay in the unfinished
//! file until all frames are known.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};

use carom::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

/// Position, rotation and scale of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Placement {
    /// Position \[m\].
    pub position: DVec3,
    /// Rotation, normalized.
    pub rotation: DQuat,
    /// Scale of its mesh of size 1 \[m\].
    pub scale: [f64; 3],
}

/// A body over all frames.
#[derive(Debug, Clone)]
pub(super) struct Track {
    /// Number of the body.
    pub number: u64,
    /// Index of its node.
    pub node: usize,
    /// First frame in which the body exists, and the one after the last.
    pub frames: std::ops::Range<u32>,
    /// Scales, each with the frame from which it holds.
    pub scales: Vec<(u32, [f64; 3])>,
    /// Whether its position changes.
    pub moves: bool,
    /// Whether its rotation changes.
    pub turns: bool,
    last: [f32; Row::NUMBERS],
}

impl Track {
    /// Starts the track of a body that appears in this frame.
    fn new(came: Came, frame: u32) -> Self {
        let Came { number, node, scale } = came;
        let (frames, scales, last) = (frame..frame, vec![(frame, scale)], [0.0; Row::NUMBERS]);
        Self { number, node, frames, scales, moves: false, turns: false, last }
    }

    /// Adds a frame.
    fn push(&mut self, row: [f32; Row::NUMBERS]) {
        if self.frames.is_empty() {
            self.last = row;
        }
        self.frames.end += 1;
        self.moves |= row[..3] != self.last[..3];
        self.turns |= row[3..] != self.last[3..];
        self.last = row;
    }

    /// Number of frames in which the body exists.
    pub fn len(&self) -> usize {
        self.frames.len()
    }

    /// Length of its keys \[byte\].
    pub fn bytes(&self) -> u64 {
        let numbers = 3 * u64::from(self.moves) + 4 * u64::from(self.turns);
        4 * numbers * self.len() as u64
    }
}

/// Position x, y, z \[m\] and rotation x, y, z, w, in 32 bits.
pub(super) struct Row;

impl Row {
    const NUMBERS: usize = 7;
    pub const BYTES: usize = 4 * Self::NUMBERS;

    /// Creates a row. Of two opposite quaternions, which are the same rotation, it takes the one
    /// nearer to `last`, so that interpolation follows the smaller angle.
    fn of(place: &Placement, last: Option<&[f32; Self::NUMBERS]>) -> [f32; Self::NUMBERS] {
        let [x, y, z] = place.position.to_array().map(|it| it as f32);
        let turn = place.rotation.to_array().map(|it| it as f32);
        let along = last.map_or(1.0, |last| {
            last[3..].iter().zip(turn).map(|(before, now)| before * now).sum::<f32>()
        });
        let [a, b, c, d] = if along < 0.0 { turn.map(|it| -it) } else { turn };
        [x, y, z, a, b, c, d]
    }

    fn read(bytes: &[u8]) -> [f32; Self::NUMBERS] {
        let mut numbers = bytes.chunks_exact(4).map(|it| [it[0], it[1], it[2], it[3]]);
        [(); Self::NUMBERS].map(|()| numbers.next().map_or(0.0, f32::from_le_bytes))
    }
}

/// A body that appears in a frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Came {
    number: u64,
    /// Index of its node.
    node: usize,
    scale: [f64; 3],
}

/// Bodies that appear, disappear or change their scale in a frame; numbers ascend.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct Changes {
    #[serde(skip_serializing_if = "Vec::is_empty")]
    gone: Vec<u64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    came: Vec<Came>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    scaled: Vec<(u64, [f64; 3])>,
}

/// Tracks of all bodies.
#[derive(Debug, Default)]
pub(super) struct Tracks {
    tracks: Vec<Track>,
    /// Indices of the tracks of existing bodies, by number.
    alive: Vec<usize>,
    /// Start of the rows of each frame in the unfinished file \[byte\].
    rows: Vec<u64>,
    /// Length of the keys of all tracks \[byte\].
    bytes: u64,
}

impl Tracks {
    /// Most bytes of rows in memory.
    const BLOCK: usize = 64 << 20;

    /// All tracks, in the order in which their bodies appeared.
    pub fn tracks(&self) -> &[Track] {
        &self.tracks
    }

    /// Length of the keys of all tracks \[byte\].
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Adds a frame with these bodies, by number; numbers are never reused. `node` returns the node
    /// of a new body. Appends the rows to `rows`, and returns the other changes.
    pub fn push(
        &mut self,
        bodies: impl Iterator<Item = (u64, Placement)>,
        mut node: impl FnMut(u64) -> usize,
        rows: &mut Vec<u8>,
    ) -> Changes {
        let frame = self.begin(0);
        let mut changes = Changes::default();
        let before = std::mem::take(&mut self.alive);
        let mut before = before.into_iter().peekable();
        for (number, place) in bodies {
            // Bodies with smaller numbers no longer exist.
            while let Some(gone) = before.next_if(|&index| self.tracks[index].number < number) {
                changes.gone.push(self.tracks[gone].number);
            }
            let known = before.next_if(|&index| self.tracks[index].number == number);
            let index = known.unwrap_or_else(|| {
                let came = Came { number, node: node(number), scale: place.scale };
                changes.came.push(came);
                self.add(came, frame)
            });
            if self.scale(index, frame, place.scale) {
                changes.scaled.push((number, place.scale));
            }
            let row = Row::of(&place, known.map(|index| &self.tracks[index].last));
            rows.extend(row.iter().flat_map(|number| number.to_le_bytes()));
            self.alive.push(index);
            self.go_on(index, row);
        }
        changes.gone.extend(before.map(|index| self.tracks[index].number));
        changes
    }

    /// Adds a frame with these changes; its rows start at `place` in the unfinished file and are
    /// read from `rows`. Returns whether all bodies have a row.
    pub fn repeat(&mut self, changes: &Changes, place: u64, mut rows: impl Read) -> bool {
        let frame = self.begin(place);
        let Changes { gone, came, scaled } = changes;
        let mut alive = std::mem::take(&mut self.alive);
        alive.retain(|&index| gone.binary_search(&self.tracks[index].number).is_err());
        alive.extend(came.iter().map(|it| self.add(*it, frame)));
        if !came.is_empty() {
            alive.sort_by_key(|&index| self.tracks[index].number);
        }
        for (number, scale) in scaled {
            let found = alive.binary_search_by_key(number, |&index| self.tracks[index].number);
            if let Ok(place) = found {
                self.scale(alive[place], frame, *scale);
            }
        }
        let mut row = [0; Row::BYTES];
        let are_whole = alive.iter().all(|&index| {
            let is_there = rows.read_exact(&mut row).is_ok();
            self.go_on(index, Row::read(&row));
            is_there
        });
        self.alive = alive;
        are_whole
    }

    /// Length of the rows of the last frame \[byte\].
    pub fn rows_length(&self) -> u64 {
        (self.alive.len() * Row::BYTES) as u64
    }

    /// Starts a frame; returns its number.
    fn begin(&mut self, place: u64) -> u32 {
        self.rows.push(place);
        self.rows.len() as u32 - 1
    }

    /// Adds a track; returns its index.
    fn add(&mut self, came: Came, frame: u32) -> usize {
        self.tracks.push(Track::new(came, frame));
        self.tracks.len() - 1
    }

    /// Sets the scale of a body from a frame on; returns whether it changed.
    fn scale(&mut self, index: usize, frame: u32, scale: [f64; 3]) -> bool {
        let scales = &mut self.tracks[index].scales;
        let is_other = scales.last().is_none_or(|last| last.1 != scale);
        if is_other {
            scales.push((frame, scale));
        }
        is_other
    }

    fn go_on(&mut self, index: usize, row: [f32; Row::NUMBERS]) {
        let track = &mut self.tracks[index];
        self.bytes -= track.bytes();
        track.push(row);
        self.bytes += track.bytes();
    }

    /// Writes the keys of all tracks, with rows read from `file`: for each track the positions if
    /// it moves, then the rotations if it rotates.
    pub fn write_keys(self, file: &mut File, out: &mut impl Write) -> io::Result<()> {
        let Self { tracks, mut rows, .. } = self;
        let mut rest = &tracks[..];
        while !rest.is_empty() {
            let (block, later) = rest.split_at(block_len(rest, Self::BLOCK));
            rest = later;
            let keys = read_block(file, block, &mut rows)?;
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

/// Number of tracks whose rows fit into `most` bytes; at least one.
fn block_len(tracks: &[Track], most: usize) -> usize {
    let mut bytes = 0;
    let fits = tracks.iter().take_while(|track| {
        bytes += track.len() * Row::BYTES;
        bytes <= most
    });
    fits.count().max(1)
}

/// Reads the rows of each track of a block. `places` contains the start of the rows of this block
/// and later ones in each frame; on return, that of the later ones.
fn read_block(file: &mut File, block: &[Track], places: &mut [u64]) -> io::Result<Vec<Vec<u8>>> {
    let is_still = |track: &Track| !track.moves && !track.turns;
    let needed = |track: &Track| if is_still(track) { 0 } else { track.len() * Row::BYTES };
    let mut keys: Vec<Vec<u8>> =
        block.iter().map(|track| Vec::with_capacity(needed(track))).collect();
    let first = block.iter().map(|track| track.frames.start).min().unwrap_or(0);
    let end = block.iter().map(|track| track.frames.end).max().unwrap_or(0);
    let mut rows = Vec::new();
    for frame in first..end {
        let there = || (0..block.len()).filter(|&i| block[i].frames.contains(&frame));
        let place = &mut places[frame as usize];
        rows.resize(there().count() * Row::BYTES, 0);
        let start = SeekFrom::Start(*place);
        *place += rows.len() as u64;
        if there().all(|i| is_still(&block[i])) {
            continue;
        }
        file.seek(start)?;
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

    /// Converts frames to tracks, and to a file of rows with the other changes.
    fn tracks(frames: &[Vec<(u64, Placement)>]) -> (Tracks, File) {
        let (mut tracks, mut repeated) = (Tracks::default(), Tracks::default());
        let mut file = tempfile::tempfile().unwrap();
        for frame in frames {
            let mut rows = Vec::new();
            let changes = tracks.push(frame.iter().copied(), |number| number as usize, &mut rows);
            let place = file.stream_position().unwrap();
            file.write_all(&rows).unwrap();
            assert!(repeated.repeat(&changes, place, &rows[..]));
        }
        assert_eq!(format!("{:?}", tracks.tracks), format!("{:?}", repeated.tracks));
        assert_eq!((tracks.bytes, tracks.alive), (repeated.bytes, repeated.alive.clone()));
        (repeated, file)
    }

    /// Body 0 exists in all frames, 1 in the first only; 2 rests from the second frame on, 3 moves
    /// from there on.
    fn some() -> (Tracks, File) {
        tracks(&[
            vec![(0, at(0.0)), (1, at(10.0))],
            vec![(0, at(1.0)), (2, at(20.0)), (3, at(30.0))],
            vec![(0, at(2.0)), (2, at(20.0)), (3, at(31.0))],
        ])
    }

    #[test]
    fn each_body_has_its_own_places_in_order() {
        let (tracks, mut file) = some();
        let frames: Vec<_> = tracks.tracks().iter().map(|it| it.frames.clone()).collect();
        assert_eq!(frames, [0..3, 0..1, 1..3, 1..3]);
        let bytes = tracks.bytes();
        let mut out = Vec::new();
        tracks.write_keys(&mut file, &mut out).unwrap();
        assert_eq!(out.len() as u64, bytes);
        let x: Vec<f32> = out
            .chunks_exact(12)
            .map(|it| f32::from_le_bytes([it[0], it[1], it[2], it[3]]))
            .collect();
        assert_eq!(x, [0.0, 1.0, 2.0, 30.0, 31.0]);
    }

    #[test]
    fn blocks_of_one_track_give_what_one_block_gives() {
        let (Tracks { tracks, mut rows, .. }, mut file) = some();
        let whole = read_block(&mut file, &tracks, &mut rows.clone()).unwrap();
        let mut one = |it| read_block(&mut file, it, &mut rows).unwrap();
        let single: Vec<_> = tracks.chunks(block_len(&tracks, 1)).flat_map(&mut one).collect();
        assert_eq!(single, whole);
    }

    #[test]
    fn a_turn_goes_the_shorter_way() {
        let turned = |rotation| Placement { rotation, ..at(0.0) };
        let quarter = DQuat::from_xyzw(0.0, 0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt());
        let (tracks, _) = tracks(&[quarter, -quarter].map(|it| vec![(0, turned(it))]));
        assert!(!tracks.tracks()[0].turns, "the opposite quaternion is the same rotation");
    }

    #[test]
    fn sizes_that_change_are_kept_with_the_frame_from_which_they_hold() {
        let sized = |scale| vec![(7, Placement { scale: [scale; 3], ..at(0.0) })];
        let (tracks, _) = tracks(&[sized(1.0), sized(2.0), sized(2.0), vec![], sized(2.0)]);
        let scales: Vec<_> = tracks.tracks().iter().map(|it| it.scales.clone()).collect();
        assert_eq!(scales, [vec![(0, [1.0; 3]), (1, [2.0; 3])], vec![(4, [2.0; 3])]]);
    }

    #[test]
    fn rows_that_are_missing_are_noticed() {
        let mut rows = Vec::new();
        let there = [(0, at(0.0)), (1, at(1.0))];
        let changes = Tracks::default().push(there.into_iter(), |_| 0, &mut rows);
        assert!(Tracks::default().repeat(&changes, 0, &rows[..]));
        assert!(!Tracks::default().repeat(&changes, 0, &rows[..Row::BYTES]));
    }
}
