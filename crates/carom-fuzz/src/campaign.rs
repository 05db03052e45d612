//! Many cases of one target.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

use crate::fault::Fault;
use crate::memory;
use crate::stopwatch::Stopwatch;
use crate::target::{Answer, Target};

/// Steps in which a case that fails is made smaller.
const MOST_STEPS: u32 = 400;

/// Time on the clock after which a case that has not ended ends the process: far beyond what counts as too slow, on a
/// busy machine, too.
const GIVE_UP: Duration = Duration::from_secs(300);

/// Which cases are drawn.
#[derive(Debug, Clone, Copy)]
pub struct Campaign {
    /// Seed of the cases.
    pub seed: u64,
    /// Number of the first case.
    pub first: u64,
    /// Number of cases.
    pub count: u64,
    /// Time at which the campaign ends even if cases are left.
    pub until: Option<Instant>,
}

/// Results of a campaign.
#[derive(Debug, Clone, Default)]
pub struct Totals {
    /// Cases that the reader accepted.
    pub accepted: u64,
    /// Cases that were refused.
    pub refused: u64,
    /// Longest processor time of a case.
    pub slowest: Duration,
    /// Most memory of the process \[bytes\].
    pub peak_bytes: Option<u64>,
    /// Cases that break a promise.
    pub findings: Vec<Finding>,
}

/// A case that breaks a promise.
#[derive(Debug, Clone)]
pub struct Finding {
    /// Number of the case.
    pub number: u64,
    /// The promise that it breaks.
    pub fault: Fault,
    /// The case, made smaller.
    pub case: Vec<u8>,
}

impl Campaign {
    /// Tries the cases of a target; calls `on_finding` at once for each that breaks a promise.
    pub fn run(&self, target: &Target, mut on_finding: impl FnMut(&Finding)) -> Totals {
        let cases = (target.cases)();
        let watch = Watch::new(target.name, self.seed);
        let mut totals = Totals::default();
        for number in self.first..self.first.saturating_add(self.count) {
            if self.until.is_some_and(|end| Instant::now() > end) {
                break;
            }
            watch.begin(number);
            let mut runner = runner(self.seed, number);
            let Ok(mut drawn) = cases.new_tree(&mut runner) else { continue };
            let stopwatch = Stopwatch::start();
            let answer = target.try_case(&drawn.current());
            totals.slowest = totals.slowest.max(stopwatch.elapsed());
            match answer {
                Ok(Answer::Accepted) => totals.accepted += 1,
                Ok(Answer::Refused) => totals.refused += 1,
                Err(fault) => {
                    let case = smaller(target, &mut drawn, &fault, &watch);
                    let finding = Finding { number, fault, case };
                    on_finding(&finding);
                    totals.findings.push(finding);
                }
            }
        }
        totals.peak_bytes = memory::peak();
        totals
    }
}

/// Returns a runner that draws the same cases for each number, whatever was drawn before.
fn runner(seed: u64, number: u64) -> TestRunner {
    let mut bytes = [0; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    bytes[8..16].copy_from_slice(&number.to_le_bytes());
    let config = Config { failure_persistence: None, ..Config::default() };
    TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &bytes))
}

/// Returns the smallest case found that breaks a promise in the same way.
fn smaller(
    target: &Target,
    drawn: &mut impl ValueTree<Value = Vec<u8>>,
    fault: &Fault,
    watch: &Watch,
) -> Vec<u8> {
    let mut smallest = drawn.current();
    // What takes seconds would take minutes to make smaller.
    if matches!(fault, Fault::Slow(_) | Fault::Memory { .. }) {
        return smallest;
    }
    let kind = fault.kind();
    let mut goes_on = drawn.simplify();
    for _ in 0..MOST_STEPS {
        if !goes_on {
            break;
        }
        watch.renew();
        let case = drawn.current();
        let is_same = |other: &Fault| other.kind() == kind;
        if target.try_case(&case).err().as_ref().is_some_and(is_same) {
            smallest = case;
            goes_on = drawn.simplify();
        } else {
            goes_on = drawn.complicate();
        }
    }
    smallest
}

impl fmt::Display for Totals {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { accepted, refused, slowest, peak_bytes, findings } = self;
        let cases = accepted + refused + findings.len() as u64;
        write!(f, "{cases} cases, {accepted} accepted, {refused} refused, ")?;
        write!(f, "slowest {:.2} s, ", slowest.as_secs_f64())?;
        if let Some(bytes) = peak_bytes {
            write!(f, "memory {} MB, ", bytes / 1_000_000)?;
        }
        write!(f, "{} findings", findings.len())
    }
}

/// Ends the process if a case does not end, and says which one it was: what hangs cannot be caught.
#[derive(Debug)]
struct Watch {
    case: Arc<AtomicU64>,
    /// Milliseconds from the start of the process to that of the case.
    since: Arc<AtomicU64>,
    began: Instant,
}

impl Watch {
    /// Number that stands for no case.
    const OVER: u64 = u64::MAX;

    fn new(target: &'static str, seed: u64) -> Self {
        let watch = Self { case: Arc::default(), since: Arc::default(), began: Instant::now() };
        let (case, since, began) = (watch.case.clone(), watch.since.clone(), watch.began);
        thread::spawn(move || {
            loop {
                thread::sleep(Duration::from_millis(500));
                let number = case.load(Ordering::Relaxed);
                if number == Self::OVER {
                    return;
                }
                let since = Duration::from_millis(since.load(Ordering::Relaxed));
                if began.elapsed().saturating_sub(since) > GIVE_UP {
                    eprintln!("{target}: case {number} of seed {seed} does not end");
                    std::process::abort();
                }
            }
        });
        watch
    }

    fn begin(&self, number: u64) {
        self.renew();
        self.case.store(number, Ordering::Relaxed);
    }

    fn renew(&self) {
        self.since.store(self.began.elapsed().as_millis() as u64, Ordering::Relaxed);
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        self.case.store(Self::OVER, Ordering::Relaxed);
    }
}
