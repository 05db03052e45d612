//! A thousand files with mistakes in them: each is imported or refused, in time, and none ends in a panic.

mod files;

use std::time::{Duration, Instant};

use carom_gltf::Options;
use files::fixture;
use rand_core::Rng;
use rand_pcg::Pcg64Mcg;

#[test]
fn a_thousand_broken_files_are_imported_or_refused_in_time() {
    let folder = tempfile::TempDir::new().unwrap();
    std::fs::copy(fixture("meshes.bin"), folder.path().join("meshes.bin")).unwrap();
    let names = ["bodies.gltf", "meshes.gltf", "run.glb"];
    let files = names.map(|name| std::fs::read(fixture(name)).unwrap());
    let mut random = Pcg64Mcg::new(0xfedc_ba98_7654_3210);
    let (mut imported, mut slowest) = (0, Duration::ZERO);
    for round in 0..1000 {
        let which = round % names.len();
        let mut bytes = files[which].clone();
        for _ in 0..1 + random.next_u32() % 3 {
            mutate(&mut bytes, &mut random);
        }
        let path = folder.path().join(names[which]);
        std::fs::write(&path, &bytes).unwrap();
        let start = Instant::now();
        imported += usize::from(carom_gltf::import(&path, &Options::default()).is_ok());
        slowest = slowest.max(start.elapsed());
    }
    // Both happen often: else the mistakes would test little.
    assert!((100..900).contains(&imported), "{imported} of 1000 are imported");
    // A file takes some milliseconds; the bound leaves room for a busy machine.
    assert!(slowest < Duration::from_secs(10), "{slowest:?}");
}

/// One mistake: a byte changed, a piece left out or doubled, the end lost, a number or a word replaced.
fn mutate(bytes: &mut Vec<u8>, random: &mut Pcg64Mcg) {
    let mut below = |bound: usize| random.next_u32() as usize % bound.max(1);
    let at = below(bytes.len());
    let end = bytes.len().min(at + below(40));
    match below(8) {
        0 => bytes[at] = below(256) as u8,
        1 => drop(bytes.drain(at..end)),
        2 => {
            let piece = bytes[at..end].to_vec();
            bytes.splice(at..at, piece);
        }
        3 => bytes.truncate(at.max(60)),
        4 => {
            let words: [&[u8]; 6] = [b"[", b"{", b"null", b"\"", b", ", b": {}"];
            bytes.splice(at..at, words[below(6)].iter().copied());
        }
        _ => {
            let digit = (at..bytes.len()).find(|&it| bytes[it].is_ascii_digit());
            let numbers: [&[u8]; 8] = [
                b"-1",
                b"1e300",
                b"1e999",
                b"99999999999999999999",
                b"0",
                b"0.000000001",
                b"7",
                b"4294967296",
            ];
            if let Some(digit) = digit {
                let number = numbers[below(8)].iter().copied();
                bytes.splice(digit..=digit, number);
            }
        }
    }
}
