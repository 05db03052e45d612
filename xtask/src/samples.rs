//! Draws doc comments at random, for a reader who judges whether each is understood without the code.

use std::path::PathBuf;

use crate::shell::Outcome;
use crate::sources::{files_of, folders, read, seen_from_root};

/// Seeds of a sample by default.
const SEEDS: std::ops::RangeInclusive<u64> = 1..=20;

/// A doc comment with the line that it describes.
struct Comment {
    file: PathBuf,
    /// Number of its first line, from 1.
    line: usize,
    text: Vec<String>,
    item: String,
}

/// Prints the doc comment that each seed draws, with its place.
pub fn print(seed: Option<&str>) -> Outcome {
    let seeds: Vec<u64> = match seed {
        Some(text) => vec![text.parse().map_err(|_| format!("{text} is no seed"))?],
        None => SEEDS.collect(),
    };
    let comments = comments()?;
    for seed in seeds {
        let Some(comment) = comments.get(drawn(seed, comments.len())) else { continue };
        let Comment { file, line, text, item } = comment;
        println!("seed {seed}: {}:{line}", file.display());
        text.iter().chain([item]).for_each(|line| println!("    {line}"));
    }
    Ok(())
}

/// Returns every block of `///` in the sources of the workspace, in the order of files and lines.
fn comments() -> Outcome<Vec<Comment>> {
    let mut comments = Vec::new();
    for folder in folders()? {
        for file in files_of(&folder)? {
            let place = seen_from_root(&file).to_owned();
            let found = comments_of(&read(&file)?);
            comments.extend(
                found.into_iter().map(|comment| Comment { file: place.clone(), ..comment }),
            );
        }
    }
    Ok(comments)
}

fn comments_of(source: &str) -> Vec<Comment> {
    let mut comments: Vec<Comment> = Vec::new();
    let mut is_open = false;
    for (line, text) in (1..).zip(source.lines().map(str::trim)) {
        let is_doc = text.starts_with("///");
        if is_doc && !is_open {
            comments.push(Comment {
                file: PathBuf::new(),
                line,
                text: Vec::new(),
                item: String::new(),
            });
        }
        let Some(comment) = comments.last_mut() else { continue };
        if is_doc {
            comment.text.push(text.to_owned());
        } else if comment.item.is_empty() && !text.starts_with("#[") {
            text.clone_into(&mut comment.item);
        }
        is_open = is_doc;
    }
    comments
}

/// Returns a number below `count` by the generator SplitMix64 (Steele, Lea and Flood 2014).
fn drawn(seed: u64, count: usize) -> usize {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    state = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    state = (state ^ (state >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((state ^ (state >> 31)) % (count.max(1) as u64)) as usize
}

#[cfg(test)]
mod tests {
    use super::{comments_of, drawn};

    const SOURCE: &str = "
/// A sphere.
///
/// Of any size.
#[derive(Clone)]
pub struct Sphere {
    /// Radius [m].
    pub radius: f64,
    // No doc comment.
    pub mass: f64,
}
";

    #[test]
    fn blocks_of_doc_comments_are_found_with_what_they_describe() {
        let found = comments_of(SOURCE);
        let seen: Vec<_> =
            found.iter().map(|it| (it.line, it.text.len(), it.item.as_str())).collect();
        assert_eq!(seen, [(2, 3, "pub struct Sphere {"), (7, 1, "pub radius: f64,")]);
    }

    #[test]
    fn each_seed_draws_one_number_and_seeds_differ() {
        let all: std::collections::BTreeSet<usize> =
            (1..=20).map(|seed| drawn(seed, 10_000)).collect();
        assert_eq!(all.len(), 20);
        assert!(all.into_iter().all(|number| number < 10_000));
        assert_eq!(drawn(3, 100), drawn(3, 100));
    }
}
