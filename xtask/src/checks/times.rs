//! How long parts of the checks take: on the clock, and in processor time.

use std::fs;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use crate::documents;
use crate::shell::{Outcome, target_folder};

/// How long a part took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Times {
    pub wall: Duration,
    /// Processor time of the part and of every program that it ran; `None` where the system does
    /// not report it.
    pub processor: Option<Duration>,
}

/// The document whose table says how long each part takes.
const DOCUMENT: &str = "CONTRIBUTING.md";
/// The first cell of that table.
const HEADING: &str = "part";
/// How much more of the processor time of all parts a part may take than the table says.
const GROWTH: f64 = 1.5;
/// What a part may take beyond that: a download, another program on the machine.
const SLACK: Duration = Duration::from_secs(20);

/// Where the logs and times of parts are kept.
pub fn folder() -> PathBuf {
    target_folder().join("checks")
}

/// Runs a part in this process, prints how long it took, and keeps that for [`read`].
pub fn timed(name: &str, run: fn() -> Outcome) -> Outcome {
    let start = Instant::now();
    run()?;
    let times = Times { wall: start.elapsed(), processor: processor_time() };
    eprintln!("\n-- {name}: {}", described(times));
    let processor = times.processor.map_or(String::new(), |it| it.as_millis().to_string());
    let text = format!("{} {processor}\n", times.wall.as_millis());
    let file = file(name);
    fs::create_dir_all(folder())
        .and_then(|()| fs::write(&file, text))
        .map_err(|error| format!("{}: {error}", file.display()))
}

/// The times that a part kept.
pub fn read(name: &str) -> Option<Times> {
    let text = fs::read_to_string(file(name)).ok()?;
    let mut numbers = text.split_whitespace().map(str::parse);
    let wall = Duration::from_millis(numbers.next()?.ok()?);
    let processor = numbers.next().and_then(Result::ok).map(Duration::from_millis);
    Some(Times { wall, processor })
}

fn file(name: &str) -> PathBuf {
    folder().join(format!("{name}.time"))
}

/// The table of the times of parts, in Markdown.
pub fn table(parts: &[(&str, Times)]) -> String {
    let mut rows = String::from("| part | on the clock | processor time [s] |\n|---|---:|---:|\n");
    for (name, times) in parts {
        let processor = times.processor.map_or(String::new(), |it| it.as_secs().to_string());
        rows += &format!("| {name} | {} | {processor} |\n", minutes(times.wall));
    }
    rows
}

/// Refuses a part that takes half as much again, beside all others, as the table of [`DOCUMENT`] says
/// of a run that builds everything. Beside the others, because machines differ in speed.
pub fn check(parts: &[(&str, Times)]) -> Outcome {
    let text = documents::text(DOCUMENT)?;
    let known = known(&text);
    let measured: Option<Vec<(&str, f64)>> =
        parts.iter().map(|(name, times)| Some((*name, times.processor?.as_secs_f64()))).collect();
    // Some systems do not tell.
    let Some(measured) = measured else { return Ok(()) };
    match grown(&measured, &known)? {
        faults if faults.is_empty() => Ok(()),
        faults => Err(format!("{}\n{DOCUMENT} must say what became of it", faults.join("\n"))),
    }
}

/// What the table of a document says of each part \[s\].
fn known(text: &str) -> Vec<(String, f64)> {
    let rows = text.lines().skip_while(|line| !line.starts_with(&format!("| {HEADING} |")));
    let rows = rows.take_while(|line| line.starts_with('|')).skip(2);
    let row = |line: &str| {
        let mut cells = line.trim_matches('|').split('|').map(str::trim);
        Some((cells.next()?.to_owned(), cells.next()?.parse().ok()?))
    };
    rows.filter_map(row).collect()
}

/// Sentences about the parts that have grown.
fn grown(measured: &[(&str, f64)], known: &[(String, f64)]) -> Outcome<Vec<String>> {
    let expected = |name: &str| {
        let row = known.iter().find(|(other, _)| other == name);
        row.map(|(_, time)| *time).ok_or_else(|| format!("{DOCUMENT} has no row of {name}"))
    };
    let mut faults = Vec::new();
    for &(name, time) in measured {
        let rest: f64 = measured.iter().filter(|it| it.0 != name).map(|it| it.1).sum();
        let mut expected_rest = 0.0;
        for (other, _) in measured.iter().filter(|it| it.0 != name) {
            expected_rest += expected(other)?;
        }
        let own = expected(name)?;
        // Alone, a part has nothing to be held against.
        let allowed = if expected_rest > 0.0 { own * rest / expected_rest } else { continue };
        if time > GROWTH * allowed + SLACK.as_secs_f64() {
            faults.push(format!("{name} took {time:.0} s of processor time, not {allowed:.0}"));
        }
    }
    Ok(faults)
}

/// Processor time of this process and of every program that it ran and waited for.
fn processor_time() -> Option<Duration> {
    /// Ticks of the clock of Linux in a second, on every machine that Rust runs on.
    const TICKS: f64 = 100.0;
    let text = fs::read_to_string("/proc/self/stat").ok()?;
    // The name of the program, in brackets, may hold spaces.
    let (_, fields) = text.rsplit_once(')')?;
    let fields: Vec<&str> = fields.split_whitespace().collect();
    // utime, stime, cutime and cstime of proc_pid_stat(5).
    let ticks: f64 = fields.get(11..15)?.iter().filter_map(|it| it.parse::<f64>().ok()).sum();
    Some(Duration::from_secs_f64(ticks / TICKS))
}

/// Times, for people.
fn described(times: Times) -> String {
    match times.processor {
        Some(processor) => {
            format!("{}, {} of processor time", minutes(times.wall), minutes(processor))
        }
        None => minutes(times.wall),
    }
}

/// A time, for people.
fn minutes(time: Duration) -> String {
    let seconds = time.as_secs();
    format!("{} min {:02} s", seconds / 60, seconds % 60)
}

#[cfg(test)]
mod tests {
    use super::{grown, known};

    const TEXT: &str = "\
| part | cold | warm |
|---|---:|---:|
| lint | 10 | 5 |
| tests | 600 | 300 |
| page | 400 | 200 |

| part | 1 |
";

    #[test]
    fn a_part_that_grows_by_half_beside_the_others_is_found_on_any_machine() {
        let known = known(TEXT);
        assert_eq!(known.len(), 3);
        let faults = |speed: f64, tests: f64| {
            let measured = [("lint", 10.0), ("tests", tests), ("page", 400.0)];
            grown(&measured.map(|(name, time)| (name, time / speed)), &known).unwrap().len()
        };
        for speed in [0.5, 1.0, 2.0] {
            assert_eq!(faults(speed, 600.0), 0);
            assert_eq!(faults(speed, 800.0), 0);
            assert_eq!(faults(speed, 1000.0), 1);
        }
        let unknown = [("lint", 10.0), ("play", 10.0)];
        assert!(grown(&unknown, &known).is_err());
    }
}
