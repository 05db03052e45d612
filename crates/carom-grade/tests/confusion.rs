mod common;
use carom_grade::*;
use common::*;

#[test]
fn explore() {
    for scene in SCENES {
        let mut grader = grader(scene);
        let style = Style { noise: 1e-6, velocities: false, ..Style::default() };
        let right = planted(&grader, Mistakes::NONE, 20.0, style);
        let t = std::time::Instant::now();
        let v = grader.grade(&right).verdict;
        println!("{scene}: same {} max {:.2e} dec {:?} {:?} {:?}", v.same, v.fit.max, v.decimals, v.departure, t.elapsed());
        for mistake in Mistake::all() {
            let t = std::time::Instant::now();
            let rec = planted(&grader, mistake.into(), 20.0, style);
            let v = grader.grade(&rec).verdict;
            let first = v.explanations.first();
            let ok = first.is_some_and(|it| it.mistakes == mistake.into() || it.same_as.contains(&mistake));
            let show: Vec<String> = v.explanations.iter().map(|e| format!("{}={:?} {:.3} {:.1e}", e.mistakes, e.same_as, e.fit.part(), e.fit.rms)).collect();
            println!("  {} {:28} same {} {:?} | {:?} {:?} {:?}", if ok {"ok "} else if v.same {"== "} else {"BAD"}, mistake.name(), v.same, v.departure.map(|d| (d.time, d.distance, d.contact.map(|c| c.kind))), show, v.notes, t.elapsed());
        }
    }
}
