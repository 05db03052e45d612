//! `carom-fuzz`: a campaign of hostile input.

use std::error::Error;
use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use carom_fuzz::{Campaign, Finding, TARGETS, Target};
use clap::Parser;

/// Tries hostile input on every reader of Carom, and worlds that are hard to step.
#[derive(Debug, Parser)]
struct Arguments {
    /// Targets to try; by default all.
    targets: Vec<String>,
    /// Cases of each, instead of those of a whole campaign.
    #[arg(long)]
    cases: Option<u64>,
    /// Number of the first case: with `--cases 1`, a case of an earlier campaign.
    #[arg(long, default_value_t = 0)]
    first: u64,
    /// Hours for all together, with as many cases as there is time for.
    #[arg(long, conflicts_with = "cases")]
    hours: Option<f64>,
    /// Seed of the cases.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// File that holds a case, instead of cases that are drawn.
    #[arg(long, conflicts_with_all = ["cases", "first", "hours", "seed"])]
    file: Option<PathBuf>,
    /// Folder for cases that break a promise.
    #[arg(long)]
    out: Option<PathBuf>,
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

/// Runs the campaign; returns the number of cases that break a promise.
fn run(arguments: &Arguments) -> Result<usize, Box<dyn Error>> {
    // Findings say what panicked.
    std::panic::set_hook(Box::new(|_| {}));
    let targets = chosen(&arguments.targets)?;
    if let Some(file) = &arguments.file {
        let case = fs::read(file)?;
        return Ok(targets.iter().filter(|target| is_broken(target, &case)).count());
    }
    let end = arguments.hours.map(|hours| Instant::now() + duration(hours));
    let mut findings = 0;
    for (index, target) in targets.iter().enumerate() {
        let until = end.map(|end| share(end, targets.len() - index));
        let count = match until {
            Some(_) => u64::MAX - arguments.first,
            None => arguments.cases.unwrap_or(target.campaign),
        };
        let campaign = Campaign { seed: arguments.seed, first: arguments.first, count, until };
        let mut problem = None;
        let totals = campaign.run(target, |finding| {
            println!("{} {}: {}", target.name, finding.number, finding.fault);
            problem = problem.take().or(keep(arguments, target, finding).err());
        });
        if let Some(problem) = problem {
            return Err(problem);
        }
        println!("{}: {totals}", target.name);
        findings += totals.findings.len();
    }
    Ok(findings)
}

fn chosen(names: &[String]) -> Result<Vec<&'static Target>, Box<dyn Error>> {
    let find = |name: &String| {
        let found = TARGETS.iter().find(|it| it.name == name);
        let names = || TARGETS.map(|it| it.name).join(", ");
        found
            .ok_or_else(|| format!("there is no target \"{name}\"; targets are {}", names()).into())
    };
    if names.is_empty() { Ok(TARGETS.iter().collect()) } else { names.iter().map(find).collect() }
}

/// Tries a case and prints the result. Returns whether it breaks a promise.
fn is_broken(target: &Target, case: &[u8]) -> bool {
    let answer = target.try_case(case);
    match &answer {
        Ok(answer) => println!("{}: {answer:?}", target.name),
        Err(fault) => println!("{}: {fault}", target.name),
    }
    answer.is_err()
}

/// Converts hours to a duration of a year at most; more is probably a typing mistake.
fn duration(hours: f64) -> Duration {
    Duration::from_secs_f64((3600.0 * hours).clamp(0.0, 31_536_000.0))
}

/// Returns when a target must end that shares the time with those after it, `targets` in all.
fn share(end: Instant, targets: usize) -> Instant {
    let now = Instant::now();
    now + end.saturating_duration_since(now) / targets as u32
}

fn keep(arguments: &Arguments, target: &Target, finding: &Finding) -> Result<(), Box<dyn Error>> {
    let Some(folder) = &arguments.out else { return Ok(()) };
    let folder = folder.join(target.name);
    fs::create_dir_all(&folder)?;
    fs::write(folder.join(format!("{}-{}", arguments.seed, finding.number)), &finding.case)?;
    Ok(())
}
