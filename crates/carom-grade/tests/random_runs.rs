//! Random runs of an independent simulator: what is planted is named, and nothing else is named with
//! confidence. A quick part runs with the other tests; `cargo xtask test --full` runs all, and every
//! known mistake together with every number.

#[path = "common/planting.rs"]
mod planting;
#[path = "common/simulator.rs"]
mod simulator;

use carom_grade::{Cause, Course, Grader, Mistake, TOLERANCE, Verdict};
use planting::{EXACT, Table, part, random, read, said, scene, table};
use rand_pcg::Pcg64;
use simulator::{Plan, Row, simulate};

/// Longer than the time until slots are reused [s].
const SECONDS: f64 = 18.4;

/// Distance [m] that makes a difference visible, and the fraction of rows in which it must be.
const VISIBLE: f64 = 1e-3;
const ENOUGH: f64 = 0.02;

/// How well a plan was named.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Outcome {
    /// The plan differs from the rule in too few rows.
    Unseen,
    /// It is named, or a cause that writes the same run.
    Named,
    /// One of two planted causes is named.
    InPart,
    /// Nothing is named with confidence.
    Missed,
    /// Something else is named.
    Wrong,
}

impl Outcome {
    fn text(self) -> &'static str {
        match self {
            Self::Unseen => "-",
            Self::Named => "named",
            Self::InPart => "in part",
            Self::Missed => "**none**",
            Self::Wrong => "**wrong**",
        }
    }
}

/// The simulator's name of a quantity, and the grader's.
const NUMBERS: [(&str, &str); 9] = [
    ("time step", "time step"),
    ("mass", "mass"),
    ("force", "constant force"),
    ("drag", "drag coefficient"),
    ("restitution 0", "restitution of"),
    ("tangential", "tangential factor"),
    ("radius", "radius"),
    ("velocity", "initial velocity"),
    ("period", "emitter period"),
];

/// A random wrong value of a quantity of a scene.
fn value(random: &mut Pcg64, scene: &carom_scene::Scene, name: &str) -> Vec<f64> {
    // A factor that is not near 1.
    let factor = if part(random) < 0.5 { 0.4 + 0.4 * part(random) } else { 1.25 + part(random) };
    let emitter = &scene.emitters[0];
    let value = match name {
        "time step" => 0.02 * factor,
        "mass" => emitter.sphere.mass.unwrap() * factor,
        "force" => 20.0 * factor,
        "drag" => 0.05 + 0.6 * part(random),
        "restitution 0" => 0.1 + 0.5 * part(random),
        "tangential" => 0.4 + 0.5 * part(random),
        "radius" => 0.5 * emitter.sphere.diameter.unwrap() * factor,
        "period" => (0.7 * factor * 100.0).round() / 100.0,
        _ => return (0..3).map(|_| 4.0 * part(random) - 2.0).collect(),
    };
    // People write short numbers.
    vec![(value * 1000.0).round() / 1000.0]
}

/// Fraction of the rows of a run in which another is visibly elsewhere.
fn seen(wrong: &[Row], right: &[Row]) -> f64 {
    let key = |row: &Row| ((row.time * 1e6).round() as u64, row.ball);
    let right: std::collections::BTreeMap<_, _> = right.iter().map(|it| (key(it), it)).collect();
    let is_apart = |row: &&Row| {
        right.get(&key(row)).is_none_or(|other| {
            let apart = row.position.iter().zip(other.position).map(|(a, b)| (a - b).powi(2));
            apart.sum::<f64>().sqrt() > VISIBLE
        })
    };
    wrong.iter().filter(is_apart).count() as f64 / wrong.len() as f64
}

/// Whether a cause has a slip of the plan, or one of its numbers with its value.
fn has(cause: &Cause, slip: &str) -> bool {
    cause.mistakes.iter().any(|it| it.name() == slip)
}

fn has_number(cause: &Cause, name: &str, values: &[f64]) -> bool {
    let words = NUMBERS.iter().find(|it| it.0 == name).unwrap().1;
    cause.numbers.iter().filter(|it| it.quantity.starts_with(words)).any(|it| {
        let size = values.iter().fold(0.0_f64, |most, it| most.max(it.abs()));
        it.values.iter().zip(values).all(|(a, b)| (a - b).abs() < 0.01 * size)
    })
}

fn outcome(verdict: &Verdict, plan: &Plan, noise: f64) -> Outcome {
    let Some(best) = verdict.explanations.first() else { return Outcome::Missed };
    let parts = |cause: &Cause| {
        let slips = plan.slips.iter().filter(|it| has(cause, it)).count();
        slips + plan.numbers.iter().filter(|it| has_number(cause, it.0, &it.1)).count()
    };
    let planted = plan.slips.len() + plan.numbers.len();
    let causes = || std::iter::once(&best.cause).chain(&best.same_as);
    let size = |it: &Cause| it.mistakes.len() + it.numbers.len();
    if causes().any(|it| parts(it) == planted) {
        return Outcome::Named;
    }
    // Another explanation that writes the same run is none that is wrong.
    if best.fit.is_complete() && best.fit.rms < 2.0 * noise + 1e-4 {
        return Outcome::Named;
    }
    match () {
        () if causes().any(|it| parts(it) == size(it)) => Outcome::InPart,
        // The verdict says that the cause may be another.
        () if best.nearest => Outcome::Missed,
        () => Outcome::Wrong,
    }
}

/// Grades a plan, written in a random style.
fn graded(grader: &mut Grader, scene: &carom_scene::Scene, plan: &Plan, style: Table) -> Verdict {
    let text = table(&simulate(scene, plan, SECONDS), style, |t, x| (t, x));
    grader.grade(&read(&text)).verdict
}

fn style(random: &mut Pcg64, seed: u64) -> Table {
    let scatter = [0.0, 0.0, 1e-6, 1e-3][(4.0 * part(random)) as usize];
    let decimals = [None, None, Some(6), Some(4)][(4.0 * part(random)) as usize];
    let every = [1, 1, 2, 3][(4.0 * part(random)) as usize];
    Table { scatter, decimals, every, velocities: part(random) < 0.3, seed }
}

/// Outcome of a random run, with a text about it if it is not named.
fn random_outcome(seed: u64) -> (Outcome, String) {
    let mut random = random(seed);
    let name = format!("simtest{}", 1 + (6.0 * part(&mut random)) as usize);
    let scene = scene(&name);
    let kind = part(&mut random);
    let mut plan = Plan { single: part(&mut random) < 0.5, ..Plan::default() };
    if kind < 0.5 {
        let all: Vec<Mistake> = Mistake::all().collect();
        plan.slips.push(all[(all.len() as f64 * part(&mut random)) as usize].name());
    } else if kind < 0.9 {
        let (number, _) = NUMBERS[(NUMBERS.len() as f64 * part(&mut random)) as usize];
        plan.numbers.push((number, value(&mut random, &scene, number)));
    }
    let mut style = style(&mut random, seed);
    if plan.slips.contains(&"display-frames") {
        // A table of the display's frames has all of them.
        style.every = 1;
    }
    let mut grader = Grader::new(Course::of(&scene).unwrap(), TOLERANCE);
    let verdict = graded(&mut grader, &scene, &plan, style);
    let noise = style.scatter + style.decimals.map_or(0.0, |it| 10_f64.powi(-(it as i32)));
    let is_right = plan.slips.is_empty() && plan.numbers.is_empty();
    // Rounded as the plan, so that only its mistake makes a difference.
    let right = Plan { single: plan.single, ..Plan::default() };
    let part_seen = seen(&simulate(&scene, &plan, SECONDS), &simulate(&scene, &right, SECONDS));
    let outcome = if is_right {
        let is_it = verdict.same || verdict.scatter.is_some() && verdict.fit.is_complete();
        if is_it { Outcome::Named } else { Outcome::Wrong }
    } else {
        // What is hardly seen need not be named, but nothing else may be.
        match outcome(&verdict, &plan, noise) {
            Outcome::Missed if part_seen < ENOUGH => Outcome::Unseen,
            outcome => outcome,
        }
    };
    (outcome, format!("{seed}: {name} {plan:?} {style:?}: {outcome:?}\n{}", said(&verdict)))
}

/// Grades random runs on several threads; returns how many of those that can be seen are named, and
/// of how many.
fn named(seeds: std::ops::Range<u64>) -> [usize; 2] {
    let outcomes = on_threads(seeds.collect(), |seed| {
        let (outcome, text) = random_outcome(seed);
        if ![Outcome::Named, Outcome::Unseen].contains(&outcome) {
            println!("{text}");
        }
        outcome
    });
    let count = |is: fn(&Outcome) -> bool| outcomes.iter().filter(|it| is(it)).count();
    assert_eq!(count(|it| *it == Outcome::Wrong), 0, "some are named wrongly");
    [count(|it| *it == Outcome::Named), count(|it| *it != Outcome::Unseen)]
}

/// Does the same with each of some things, on six threads.
fn on_threads<T: Copy + Send, R: Send>(all: Vec<T>, work: impl Fn(T) -> R + Sync) -> Vec<R> {
    let chunk = all.len().div_ceil(6).max(1);
    std::thread::scope(|scope| {
        let work = &work;
        let start = |part: &'_ [T]| {
            let part = part.to_vec();
            scope.spawn(move || part.into_iter().map(work).collect::<Vec<R>>())
        };
        let threads: Vec<_> = all.chunks(chunk).map(start).collect();
        threads.into_iter().flat_map(|it| it.join().unwrap()).collect()
    })
}

#[test]
fn some_random_runs_are_named() {
    let [named, counted] = named(0..4);
    assert_eq!(named, counted);
}

#[test]
#[ignore = "minutes; `cargo xtask test --full` runs it"]
fn of_300_random_runs_95_percent_are_named_and_none_wrongly() {
    let [named, counted] = named(1000..1300);
    println!("{named} of {counted} named");
    assert!(100 * named >= 95 * counted, "{named} of {counted}");
    let figure =
        format!("{named} of {counted} random runs in which the cause can be seen are named.");
    assert!(include_str!("confusion.md").contains(&figure), "confusion.md should say: {figure}");
}

/// Outcome for a mistake together with a wrong number in SimTest3.
fn pair(grader: &mut Grader, mistake: Mistake, number: &'static str) -> Outcome {
    let scene = scene("simtest3");
    let mut random = random(mistake as u64);
    let numbers = vec![(number, value(&mut random, &scene, number))];
    let both = Plan { slips: vec![mistake.name()], numbers, single: false };
    let slip = Plan { numbers: Vec::new(), ..both.clone() };
    let alone = Plan { slips: Vec::new(), ..both.clone() };
    let run = simulate(&scene, &both, SECONDS);
    // Each of the two must be seen beside the other.
    let others = [Plan::default(), slip, alone];
    if others.iter().any(|it| seen(&run, &simulate(&scene, it, SECONDS)) < ENOUGH) {
        return Outcome::Unseen;
    }
    let every = if mistake == Mistake::DisplayFrames { 1 } else { 3 };
    let verdict = graded(grader, &scene, &both, Table { every, ..EXACT });
    let outcome = outcome(&verdict, &both, 0.0);
    if outcome != Outcome::Named {
        println!("{outcome:?}: {both:?}\n{}", said(&verdict));
    }
    outcome
}

/// Outcome for a mistake together with each wrong number.
fn row_of(mistake: Mistake) -> Vec<Outcome> {
    let mut grader = Grader::new(Course::of(&scene("simtest3")).unwrap(), TOLERANCE);
    NUMBERS.into_iter().map(|(number, _)| pair(&mut grader, mistake, number)).collect()
}

#[test]
#[ignore = "minutes; `cargo xtask test --full` runs it"]
fn mistakes_with_wrong_numbers_are_named_right() {
    let mistakes: Vec<Mistake> = Mistake::all().collect();
    let rows = on_threads(mistakes.clone(), row_of);
    let count = |of: Outcome| rows.iter().flatten().filter(|it| **it == of).count();
    let [named, in_part, missed] = [Outcome::Named, Outcome::InPart, Outcome::Missed].map(count);
    let wrong = count(Outcome::Wrong);
    let mut table =
        format!("| mistake | {} |\n", NUMBERS.map(|it| it.1.trim_end_matches(" of")).join(" | "));
    table += &format!("|---|{}\n", "---|".repeat(NUMBERS.len()));
    for (mistake, row) in mistakes.iter().zip(&rows) {
        let cells: Vec<&str> = row.iter().map(|it| it.text()).collect();
        table += &format!("| `{}` | {} |\n", mistake.name(), cells.join(" | "));
    }
    let all = named + in_part + missed;
    println!("{table}\n{named} of {all} named, {in_part} in part, {wrong} wrongly");
    assert!(wrong == 0 && 100 * named >= 95 * all, "{wrong} wrong: {table}");
}
