//! Texts with a few mistakes.

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::{Index, select};

/// Numbers that formats, sums or loops trip over.
const NUMBERS: [&str; 30] = [
    "0",
    "-0.0",
    "-1",
    "1",
    "2",
    "3.5",
    "1e-9",
    "1e9",
    "1000000",
    "4294967296",
    "9223372036854775807",
    "-9223372036854775808",
    "18446744073709551615",
    "1e19",
    "1e154",
    "1e308",
    "-1e308",
    "1e400",
    "5e-324",
    "1e-300",
    "nan",
    "inf",
    "-inf",
    "0x10",
    "1_000",
    "0.1.2",
    "1e",
    "\"10 cm\"",
    "\"-3 m/s\"",
    "[1, 2, 3]",
];

/// Pieces of text that readers take for something else, or for an end.
const PIECES: [&str; 30] = [
    "[",
    "]",
    "{",
    "}",
    "\"",
    "'''",
    "=",
    ",",
    "\n",
    "\r",
    "\t",
    "#",
    "\0",
    "\u{1b}[31m",
    "\u{202e}",
    "\u{2028}",
    "\u{feff}",
    "é",
    "🎱",
    "[[spheres]]\n",
    "[simulation]\n",
    "include = [\"/dev/zero\"]\n",
    "true",
    "\"exact\"",
    "%",
    "&",
    "%00",
    "..",
    "/",
    "{ x = 1 }",
];

/// A mistake in a text. Places are parts of its length.
#[derive(Debug, Clone)]
enum Mutation {
    /// One bit is changed.
    Flip {
        place: Index,
        bit: u8,
    },
    Insert {
        place: Index,
        piece: &'static str,
    },
    /// The end is cut off.
    Truncate {
        place: Index,
    },
    /// A number is replaced.
    Number {
        place: Index,
        number: &'static str,
    },
    RemoveLine {
        line: Index,
    },
    RepeatLine {
        line: Index,
        times: usize,
    },
    SwapLines {
        lines: [Index; 2],
    },
    /// A line of another text of the corpus is inserted.
    Splice {
        line: Index,
        text: Index,
        from: Index,
    },
    /// A long row of characters is inserted.
    Long {
        place: Index,
        character: char,
        times: usize,
    },
}

/// Values on which readers often fail: extreme numbers, and pieces of syntax.
pub fn values() -> impl Strategy<Value = &'static str> {
    prop_oneof![select(&NUMBERS[..]), select(&PIECES[..])]
}

fn mutation() -> impl Strategy<Value = Mutation> {
    let at = any::<Index>;
    prop_oneof![
        2 => (at(), 0..8u8).prop_map(|(place, bit)| Mutation::Flip { place, bit }),
        2 => (at(), select(&PIECES[..])).prop_map(|(place, piece)| Mutation::Insert { place, piece }),
        1 => at().prop_map(|place| Mutation::Truncate { place }),
        6 => (at(), select(&NUMBERS[..])).prop_map(|(place, number)| Mutation::Number { place, number }),
        2 => at().prop_map(|line| Mutation::RemoveLine { line }),
        2 => (at(), 1..4usize).prop_map(|(line, times)| Mutation::RepeatLine { line, times }),
        1 => [at(), at()].prop_map(|lines| Mutation::SwapLines { lines }),
        4 => (at(), at(), at()).prop_map(|(line, text, from)| Mutation::Splice { line, text, from }),
        1 => (at(), select(&['a', '[', '{', '(', '9', ' ', '\n', '"', '.'][..]), 1..3000usize)
            .prop_map(|(place, character, times)| Mutation::Long { place, character, times }),
    ]
}

/// Texts of a corpus with up to four mutations; smaller cases have fewer.
pub fn mutated(corpus: Vec<Vec<u8>>) -> impl Strategy<Value = Vec<u8>> {
    let at = (any::<Index>(), vec(mutation(), 0..=4));
    at.prop_map(move |(text, mutations)| {
        let mut bytes = text.get(&corpus).clone();
        for mutation in mutations {
            mutate(&mut bytes, &mutation, &corpus);
        }
        bytes
    })
}

fn mutate(bytes: &mut Vec<u8>, mutation: &Mutation, corpus: &[Vec<u8>]) {
    let place = |it: &Index, bytes: &[u8]| it.index(bytes.len() + 1);
    match mutation {
        Mutation::Flip { place, bit } if !bytes.is_empty() => {
            let place = place.index(bytes.len());
            bytes[place] ^= 1 << bit;
        }
        Mutation::Flip { .. } => {}
        Mutation::Insert { place: at, piece } => {
            let at = place(at, bytes);
            bytes.splice(at..at, piece.bytes());
        }
        Mutation::Truncate { place: at } => bytes.truncate(place(at, bytes)),
        Mutation::Number { place, number } => {
            let numbers = numbers(bytes);
            if !numbers.is_empty() {
                bytes.splice(place.get(&numbers).clone(), number.bytes());
            }
        }
        Mutation::RemoveLine { line } => with_lines(bytes, |lines| {
            lines.remove(line.index(lines.len()));
        }),
        Mutation::RepeatLine { line, times } => with_lines(bytes, |lines| {
            let line = line.index(lines.len());
            let repeated = vec![lines[line].clone(); *times];
            lines.splice(line..line, repeated);
        }),
        Mutation::SwapLines { lines: [one, other] } => {
            with_lines(bytes, |lines| {
                let count = lines.len();
                lines.swap(one.index(count), other.index(count));
            });
        }
        Mutation::Splice { line, text, from } => {
            let other: Vec<_> = text.get(corpus).split_inclusive(|&it| it == b'\n').collect();
            if !other.is_empty() {
                let piece = from.get(&other).to_vec();
                with_lines(bytes, |lines| lines.insert(line.index(lines.len()), piece));
            }
        }
        Mutation::Long { place: at, character, times } => {
            let at = place(at, bytes);
            bytes.splice(at..at, character.to_string().repeat(*times).bytes());
        }
    }
}

/// Changes the lines of a text, if it has any.
fn with_lines(bytes: &mut Vec<u8>, change: impl FnOnce(&mut Vec<Vec<u8>>)) {
    let mut lines: Vec<_> = bytes.split_inclusive(|&it| it == b'\n').map(<[u8]>::to_vec).collect();
    if !lines.is_empty() {
        change(&mut lines);
        *bytes = lines.concat();
    }
}

/// Returns the ranges of the numbers in a text.
fn numbers(bytes: &[u8]) -> Vec<std::ops::Range<usize>> {
    let mut found = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let is_part = |it: &u8| it.is_ascii_digit() || matches!(it, b'.' | b'-' | b'+' | b'e');
        let length = bytes[at..].iter().take_while(|it| is_part(it)).count();
        if bytes[at..at + length].iter().any(u8::is_ascii_digit) {
            found.push(at..at + length);
        }
        at += length.max(1);
    }
    found
}
