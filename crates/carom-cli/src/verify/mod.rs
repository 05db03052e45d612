//! The command `verify`: checks this build against exact results and published values of physics.
//!
//! A [`Claim`] has a name, a value with its source, a tolerance with its reason, and a function
//! that measures. Each topic has a file of claims.

mod billiard;
mod claim;
mod collapse;
mod conservation;
mod convergence;
mod coupled_flights;
mod course;
mod curved_flights;
mod dem;
mod dense;
mod dense_flow;
mod derivatives;
mod diffusion;
mod drum;
mod equation;
mod fluid;
mod forces;
mod friction;
mod grains;
mod granular;
mod lyapunov;
mod motion;
mod mutual_gravity;
mod non_additive;
mod packing;
mod plane;
mod report;
mod resting;
mod rolling;
mod runs;
mod setup;
mod shear;
mod silo;
mod simultaneous;
mod single_impacts;
mod surfaces;
mod tunnelling;
mod two_balls;
mod wells;

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use carom::{Bisect, Contact, Discrete, Exact, Rule};

use crate::args::Verify;
use crate::failure::Failure;
use crate::machine;
use claim::{Claim, Effort};
use report::{Finding, Report};

/// Checks claims and prints the results.
pub fn verify(args: &Verify) -> Result<(), Failure> {
    let claims = claims(args);
    if claims.is_empty() {
        let text = args.filter.as_deref().unwrap_or_default();
        let topics = TOPICS.map(|topic| topic.0).join(", ");
        return Err(Failure::Usage(format!(
            "no claim has \"{text}\" in its name; topics are {topics}"
        )));
    }
    let findings = check_all(&claims, rule_named(&args.rule));
    let report = Report::new(args, &findings);
    report.print(args.json, args.csv)?;
    match report.missed {
        0 => Ok(()),
        missed => Err(Failure::Fault(format!("{missed} of {} claims are missed", findings.len()))),
    }
}

/// Name of a topic, and a function that returns its claims.
type Topic = (&'static str, fn() -> Vec<Claim>);

/// All topics, in the order in which their claims are printed.
const TOPICS: [Topic; 24] = [
    ("motion", motion::claims),
    ("forces", forces::claims),
    ("impacts", single_impacts::claims),
    ("tunnelling", tunnelling::claims),
    ("simultaneous", simultaneous::claims),
    ("billiard", billiard::claims),
    ("fluid", fluid::claims),
    ("granular", granular::claims),
    ("shear", shear::claims),
    ("wells", wells::claims),
    ("plane", plane::claims),
    ("conservation", conservation::claims),
    ("resting", resting::claims),
    ("friction", friction::claims),
    ("rolling", rolling::claims),
    ("dem", dem::claims),
    ("derivatives", derivatives::claims),
    ("surfaces", surfaces::claims),
    ("convergence", convergence::claims),
    ("packing", packing::claims),
    ("silo", silo::claims),
    ("collapse", collapse::claims),
    ("drum", drum::claims),
    ("course", course::claims),
];

/// Claims that the arguments select.
fn claims(args: &Verify) -> Vec<Claim> {
    let most = match (args.long, args.full) {
        (true, _) => Effort::Long,
        (false, true) => Effort::Full,
        (false, false) => Effort::Quick,
    };
    let of_topic = |(topic, claims): &Topic| {
        let is_wanted = |claim: &Claim| {
            claim.effort <= most
                && args
                    .filter
                    .as_ref()
                    .is_none_or(|text| text == topic || claim.name.contains(text))
        };
        claims().into_iter().filter(is_wanted).collect::<Vec<_>>()
    };
    TOPICS.iter().flat_map(of_topic).collect()
}

/// Creates a rule with its default parameters.
fn rule_named(name: &str) -> Rule {
    match name {
        "discrete" => Rule::Discrete(Discrete::default()),
        "bisect" => Rule::Bisect(Bisect::default()),
        "contact" => Rule::Contact(Contact::default()),
        _ => Rule::Exact(Exact::default()),
    }
}

/// Checks claims on all cores; returns the findings in the order of the claims.
fn check_all(claims: &[Claim], rule: Rule) -> Vec<Finding> {
    let next = AtomicUsize::new(0);
    let findings = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..machine::cores().min(claims.len()) {
            scope.spawn(|| {
                while let Some((i, claim)) = take(claims, &next) {
                    let began = Instant::now();
                    let outcome = (claim.measure)(claim.rule.unwrap_or(rule));
                    let finding = Finding::new(claim, outcome, began.elapsed());
                    findings.lock().unwrap_or_else(PoisonError::into_inner).push((i, finding));
                }
            });
        }
    });
    let mut findings = findings.into_inner().unwrap_or_else(PoisonError::into_inner);
    findings.sort_by_key(|(i, _)| *i);
    findings.into_iter().map(|(_, finding)| finding).collect()
}

/// Returns the next claim that no thread has taken, with its index.
fn take<'a>(claims: &'a [Claim], next: &AtomicUsize) -> Option<(usize, &'a Claim)> {
    let i = next.fetch_add(1, Ordering::Relaxed);
    claims.get(i).map(|claim| (i, claim))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kept_table_of_figures_has_every_claim_with_its_source() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/verification.csv");
        let mut table = csv::Reader::from_path(path).unwrap();
        assert_eq!(table.headers().unwrap(), report::COLUMNS.to_vec());
        let kept: Vec<_> = table.records().map(Result::unwrap).collect();
        let claims: Vec<Claim> = TOPICS.iter().flat_map(|(_, claims)| claims()).collect();
        assert_eq!(kept.len(), claims.len());
        for claim in &claims {
            let name = &claim.name;
            let row = kept.iter().find(|row| row[0] == **name);
            let row = row.unwrap_or_else(|| panic!("docs/verification.csv lacks: {name}"));
            let number = |column: usize| row[column].parse::<f64>().unwrap();
            let expected = claim.expected.value;
            assert!((number(1) - expected).abs() <= 1e-12 * expected.abs(), "{name}: {}", &row[1]);
            assert_eq!(number(4), claim.tolerance.bound, "{name}");
            assert_eq!(&row[7], claim.expected.source, "{name}");
            // Deviation and run time.
            assert!(number(3) <= claim.tolerance.bound && number(6) >= 0.0, "{name}");
        }
    }
}
