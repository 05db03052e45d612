//! A thousand scenes with mistakes in them: each is imported or refused, in time, and none ends in a panic.

mod fixtures;

use std::fs;
use std::time::{Duration, Instant};

use fixtures::Copy;
use rand_core::Rng;
use rand_pcg::Pcg64Mcg;

#[test]
fn a_thousand_broken_scenes_are_imported_or_refused_in_time() {
    let copy = Copy::new();
    let names = ["First", "Nested", "Bodies", "Own"];
    let texts = names.map(|name| fs::read(fixtures::scene(name)).unwrap());
    let mut random = Pcg64Mcg::new(0x0123_4567_89ab_cdef);
    let (mut imported, mut slowest) = (0, Duration::ZERO);
    for round in 0..1000 {
        let which = round % names.len();
        let mut text = texts[which].clone();
        for _ in 0..1 + random.next_u32() % 4 {
            mutate(&mut text, &mut random);
        }
        fs::write(copy.path(&format!("Assets/Scenes/{}.unity", names[which])), &text).unwrap();
        let start = Instant::now();
        imported += usize::from(copy.import(names[which]).is_ok());
        slowest = slowest.max(start.elapsed());
    }
    // Both happen often: else the mistakes would test little.
    assert!((100..900).contains(&imported), "{imported} of 1000 are imported");
    // A scene takes some milliseconds; the bound leaves room for a busy machine.
    assert!(slowest < Duration::from_secs(10), "{slowest:?}");
}

/// One mistake: a byte changed, a piece left out or doubled, a number replaced.
fn mutate(text: &mut Vec<u8>, random: &mut Pcg64Mcg) {
    let mut below = |bound: usize| random.next_u32() as usize % bound.max(1);
    let at = below(text.len());
    let end = text.len().min(at + below(40));
    match below(6) {
        0 => text[at] = below(256) as u8,
        1 => drop(text.drain(at..end)),
        2 => {
            let piece = text[at..end].to_vec();
            text.splice(at..at, piece);
        }
        3 => text.truncate(at.max(60)),
        4 => {
            let words: [&[u8]; 6] = [b"[", b"{", b"\n---\n", b"&a *a", b"\t- ", b": "];
            text.splice(at..at, words[below(6)].iter().copied());
        }
        _ => {
            let digit = (at..text.len()).find(|&it| text[it].is_ascii_digit());
            let numbers: [&[u8]; 6] =
                [b"-1", b"1e300", b"nan", b"99999999999999999999", b"0", b"0.000000001"];
            if let Some(digit) = digit {
                text.splice(digit..=digit, numbers[below(6)].iter().copied());
            }
        }
    }
}
