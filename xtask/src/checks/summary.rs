//! What test runners say at their end.

/// How many tests had which outcome.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Counts {
    pub passed: usize,
    pub failed: usize,
    pub skipped: usize,
}

impl Counts {
    /// Adds the outcomes of other tests.
    pub fn add(&mut self, other: Self) {
        self.passed += other.passed;
        self.failed += other.failed;
        self.skipped += other.skipped;
    }
}

/// Adds up the summaries of cargo's, pytest's and Node.js's test runners in a log.
pub fn counts(log: &str) -> Counts {
    let mut counts = Counts::default();
    for line in log.lines() {
        let line = line.trim();
        if let Some(rest) = line.strip_prefix("test result: ") {
            counts.add(listed(rest.split(['.', ';'])));
        } else if is_of_pytest(line) {
            let outcomes = line.split(" in ").next().unwrap_or_default();
            counts.add(listed(outcomes.trim_matches(['=', ' ']).split(',')));
        } else if let Some(rest) = line.strip_prefix("ℹ ").or_else(|| line.strip_prefix("# ")) {
            let mut words = rest.split_whitespace();
            let (name, number) = (words.next(), words.next().and_then(|it| it.parse().ok()));
            if let (Some(name), Some(number), None) = (name, number, words.next()) {
                counts.add(counted(number, name));
            }
        }
    }
    counts
}

/// Whether a line is like `938 passed, 4 skipped in 60.21s (0:01:00)`.
fn is_of_pytest(line: &str) -> bool {
    let line = line.trim_matches(['=', ' ']);
    let Some((outcomes, time)) = line.split_once(" in ") else { return false };
    let seconds = time.split_whitespace().next().and_then(|word| word.strip_suffix('s'));
    let first = outcomes.split_whitespace().next().unwrap_or_default();
    first.parse::<usize>().is_ok() && seconds.is_some_and(|it| it.parse::<f64>().is_ok())
}

/// Adds up phrases such as `12 passed`; leaves out those of other things.
fn listed<'a>(phrases: impl Iterator<Item = &'a str>) -> Counts {
    let mut counts = Counts::default();
    for phrase in phrases {
        let mut words = phrase.split_whitespace();
        if let (Some(Ok(number)), Some(name)) = (words.next().map(str::parse), words.next()) {
            counts.add(counted(number, name));
        }
    }
    counts
}

fn counted(number: usize, outcome: &str) -> Counts {
    let mut counts = Counts::default();
    match outcome {
        "passed" | "pass" => counts.passed = number,
        "failed" | "fail" => counts.failed = number,
        "skipped" | "ignored" => counts.skipped = number,
        _ => {}
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::{Counts, counts};

    #[test]
    fn summaries_of_every_runner_are_added_up() {
        let log = "\
running 3 tests
test result: ok. 3 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.01s
938 passed, 4 skipped in 60.21s (0:01:00)
========= 2 failed, 1 passed in 0.51s =========
ℹ tests 7
ℹ pass 6
ℹ fail 1
# skipped 0
100 passed by in silence
";
        assert_eq!(counts(log), Counts { passed: 948, failed: 3, skipped: 5 });
    }
}
