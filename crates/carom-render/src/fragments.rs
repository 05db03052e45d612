//! Growing films: fragmented mp4 files, which players can open even if their writer stopped.
//!
//! The head describes the track. It ends with Carom's own box, of the type `uuid`, which holds the
//! form of the film as three numbers of 32 bits. Each frame follows as a fragment: `moof` holds its
//! time and size, `mdat` its bits. The boxes are those of ISO/IEC 14496-12, 8.8 and 11.1; numbers
//! are big-endian.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};

use muxide::codec::h264::{annexb_to_avcc, extract_avc_config, is_h264_keyframe};
use muxide::fragmented::{FragmentConfig, FragmentedMuxer};

use crate::film_error::TICKS_PER_SECOND;
use crate::film_form::FilmForm;

/// Identifies Carom's own box among those of the type `uuid`.
const MARK: &[u8; 16] = b"carom film 1\x1a\r\n\0";
/// Size and type of a box \[byte\].
const BOX_HEAD: usize = 8;
/// Size of the `moof` box of a fragment \[byte\].
const MOOF: usize = 100;
/// Longer than the head of any film \[byte\].
const LONGEST_HEAD: usize = 4096;
/// Size of the length before each part of a frame \[byte\].
const LENGTH: usize = 4;

/// Returns a box of the type `kind`.
fn boxed(kind: &[u8; 4], parts: &[&[u8]]) -> Vec<u8> {
    let content = parts.concat();
    let size = (BOX_HEAD + content.len()) as u32;
    [&size.to_be_bytes()[..], kind, &content].concat()
}

fn words<const N: usize>(values: [u32; N]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_be_bytes()).collect()
}

/// Returns the `moof` box of frame number `frame`, which has `size` bytes.
fn moof(form: FilmForm, frame: u64, size: u32, is_keyframe: bool) -> Vec<u8> {
    const FROM_MOOF: u32 = 0x02_0000;
    const WITH_OFFSET_DURATION_SIZE_FLAGS: u32 = 0x00_0701;
    const VERSION_1: u32 = 0x0100_0000;
    // Whether decoding needs no other frame, or needs some.
    let flags = if is_keyframe { 0x0200_0000 } else { 0x0101_0000 };
    let ticks = form.ticks_per_frame();
    let header = boxed(b"mfhd", &[&words([0, frame as u32 + 1])]);
    let track = boxed(b"tfhd", &[&words([FROM_MOOF, 1])]);
    let time = frame * u64::from(ticks);
    let time = boxed(b"tfdt", &[&words([VERSION_1]), &time.to_be_bytes()]);
    let offset = (MOOF + BOX_HEAD) as u32;
    let run = words([WITH_OFFSET_DURATION_SIZE_FLAGS, 1, offset, ticks, size, flags]);
    let run = boxed(b"trun", &[&run]);
    boxed(b"moof", &[&header, &boxed(b"traf", &[&track, &time, &run])])
}

/// Returns the head of a film whose first frame has these bits.
fn head(form: FilmForm, first: &[u8]) -> io::Result<Vec<u8>> {
    let FilmForm { width, height, frames_per_second } = form;
    let unfit = |text: &str| io::Error::new(io::ErrorKind::InvalidData, text);
    let codec =
        extract_avc_config(first).ok_or_else(|| unfit("the first frame does not say its codec"))?;
    let config = FragmentConfig {
        sps: codec.sps,
        pps: codec.pps,
        ..FragmentConfig::new(width, height, TICKS_PER_SECOND)
    };
    let mut muxer = FragmentedMuxer::new(config).map_err(io::Error::other)?;
    let mark = boxed(b"uuid", &[MARK, &words([width, height, frames_per_second])]);
    Ok([muxer.init_segment(), mark].concat())
}

/// Writes a growing film. The operating system has each frame when [`Self::add`] returns.
#[derive(Debug)]
pub(crate) struct FragmentWriter {
    form: FilmForm,
    frames: u64,
    /// Bytes of the whole frames.
    end: u64,
    has_failed: bool,
}

impl FragmentWriter {
    pub fn new(form: FilmForm) -> Self {
        Self { form, frames: 0, end: 0, has_failed: false }
    }

    /// Appends a frame, given as parts of H.264 separated by start codes, to `out`. Nothing else
    /// may write to `out`. After an error `out` ends with the frame before, and every later call
    /// fails, because a film cannot go on without a frame.
    pub fn add(&mut self, bits: &[u8], out: &mut File) -> io::Result<()> {
        if self.has_failed {
            return Err(io::Error::other("a frame before could not be written"));
        }
        let added = self.fragment(bits).and_then(|fragment| {
            out.write_all(&fragment)?;
            Ok(fragment.len())
        });
        match added {
            Ok(length) => {
                self.frames += 1;
                self.end += length as u64;
                Ok(())
            }
            Err(error) => {
                self.has_failed = true;
                // An error here would hide the first one; a reader ignores the incomplete frame.
                out.set_len(self.end).ok();
                Err(error)
            }
        }
    }

    /// Returns the next fragment, with the head of the film before the first one.
    fn fragment(&self, bits: &[u8]) -> io::Result<Vec<u8>> {
        let head = if self.frames == 0 { head(self.form, bits)? } else { Vec::new() };
        let sample = annexb_to_avcc(bits);
        let moof = moof(self.form, self.frames, sample.len() as u32, is_h264_keyframe(bits));
        Ok([head, moof, boxed(b"mdat", &[&sample])].concat())
    }

    /// Returns the number of frames written.
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// Returns the number of bytes written.
    pub fn bytes(&self) -> u64 {
        self.end
    }
}

/// Reads a growing film, frame by frame.
pub(crate) struct Fragments<'a> {
    reader: BufReader<&'a mut File>,
    pub form: FilmForm,
    /// Whole frames read.
    pub frames: u64,
    /// Bytes not read yet. After the last frame: bytes that belong to no whole frame.
    pub rest: u64,
    /// Whether the bytes after the last frame are damaged, not only an incomplete frame.
    pub is_damaged: bool,
}

/// A frame of H.264.
pub(crate) struct Frame {
    /// Parts of the frame, separated by start codes.
    pub bits: Vec<u8>,
    pub is_keyframe: bool,
}

impl<'a> Fragments<'a> {
    /// Reads the head; `None` if the file is no growing film.
    pub fn open(file: &'a mut File) -> io::Result<Option<Self>> {
        let length = file.seek(SeekFrom::End(0))?;
        file.rewind()?;
        let mut reader = BufReader::new(file);
        let mut head = Vec::new();
        reader.by_ref().take(LONGEST_HEAD as u64).read_to_end(&mut head)?;
        let Some((form, end)) = read_head(&head) else { return Ok(None) };
        reader.seek(SeekFrom::Start(end as u64))?;
        let rest = length - end as u64;
        Ok(Some(Self { reader, form, frames: 0, rest, is_damaged: false }))
    }

    /// Reads the next whole frame.
    pub fn next_frame(&mut self) -> io::Result<Option<Frame>> {
        let mut head = [0; MOOF + BOX_HEAD];
        if self.is_damaged || self.rest < head.len() as u64 {
            return Ok(None);
        }
        self.reader.read_exact(&mut head)?;
        let (said, data) = head.split_at(MOOF);
        let size = u32::from_be_bytes([data[0], data[1], data[2], data[3]]);
        let size = size.saturating_sub(BOX_HEAD as u32);
        let is_said = |is_keyframe| said == moof(self.form, self.frames, size, is_keyframe);
        let is_fragment = data[4..] == *b"mdat" && (is_said(true) || is_said(false));
        if !is_fragment || size > self.largest_frame() {
            self.is_damaged = true;
            return Ok(None);
        }
        let fragment = head.len() as u64 + u64::from(size);
        if fragment > self.rest {
            return Ok(None);
        }
        let mut sample = vec![0; size as usize];
        self.reader.read_exact(&mut sample)?;
        let frame = with_start_codes(&sample)
            .map(|bits| Frame { is_keyframe: is_h264_keyframe(&bits), bits })
            .filter(|frame| is_said(frame.is_keyframe));
        self.is_damaged = frame.is_none();
        if frame.is_some() {
            self.frames += 1;
            self.rest -= fragment;
        }
        Ok(frame)
    }

    /// Returns a size above that of any frame \[byte\]: twice the size of the picture in 4:2:0.
    fn largest_frame(&self) -> u32 {
        3 * self.form.width * self.form.height + LONGEST_HEAD as u32
    }
}

/// Returns the form of the film and the position at which its head ends.
fn read_head(bytes: &[u8]) -> Option<(FilmForm, usize)> {
    let number = |place: usize| -> Option<u32> {
        Some(u32::from_be_bytes(bytes.get(place..place + 4)?.try_into().ok()?))
    };
    let mut place = 0;
    for kind in [b"ftyp", b"moov", b"uuid"] {
        let size = number(place)? as usize;
        let is_there = bytes.get(place + 4..place + BOX_HEAD)? == kind;
        if !is_there || !(BOX_HEAD..=LONGEST_HEAD).contains(&size) {
            return None;
        }
        if kind != b"uuid" {
            place += size;
        }
    }
    let content = place + BOX_HEAD;
    let is_own = bytes.get(content..content + MARK.len())? == MARK;
    let numbers = content + MARK.len();
    let form = FilmForm::new(number(numbers)?, number(numbers + 4)?, number(numbers + 8)?);
    let end = numbers + 12;
    let is_whole = is_own && number(place)? as usize == end - place;
    is_whole.then_some((form.ok()?, end))
}

/// Replaces the length before each part of a frame by a start code; `None` if the lengths do not
/// fit.
fn with_start_codes(sample: &[u8]) -> Option<Vec<u8>> {
    let mut bits = Vec::with_capacity(sample.len());
    let mut rest = sample;
    while !rest.is_empty() {
        let (length, after) = rest.split_first_chunk::<LENGTH>()?;
        let (part, after) = after.split_at_checked(u32::from_be_bytes(*length) as usize)?;
        bits.extend([0, 0, 0, 1]);
        bits.extend(part);
        rest = after;
    }
    (!bits.is_empty()).then_some(bits)
}
