//! Describes verdicts in words.

use crate::scatter::Scatter;
use crate::verdict::{Cause, Departure, DepartureContact, Explanation, Verdict};

impl Verdict {
    /// Result in one line.
    pub fn headline(&self) -> String {
        if self.same && self.form.is_empty() {
            return format!(
                "same as the course's rule, to {} digits (largest difference {:.1e} m)",
                self.digits.unwrap_or(0),
                self.fit.max
            );
        }
        let form = match self.form.as_slice() {
            [] => String::new(),
            form => format!(" in another form: {}", form.join("; ")),
        };
        if self.fit.is_complete() {
            let scatter = self.scatter.map_or("", |_| ", but for scatter");
            return format!("same as the course's rule{scatter}{form}");
        }
        let Some(departure) = &self.departure else {
            return match self.compared_until {
                Some(until) if self.fit.followed > 0 => format!(
                    "the same as the course's rule up to {until:.2} s; what follows is not compared"
                ),
                _ => "no row is at a time that can be compared with the course's rule".to_owned(),
            };
        };
        let Departure { time, ball, .. } = departure;
        format!("departs from the course's rule at {time:.2} s, ball {ball}{}", self.read_as())
    }

    /// Further lines of the verdict, each with a name.
    pub fn lines(&self) -> Vec<(&'static str, String)> {
        let mut lines = Vec::new();
        if let Some(scatter) = self.scatter {
            lines.push(("scatter", scatter.in_words()));
        }
        if let Some(departure) = &self.departure {
            lines.push(("where", departure.place()));
            lines.push(("contact", departure.touched()));
            lines.extend(departure.right().map(|it| ("right", it)));
        }
        match self.explanations.split_first() {
            Some((best, others)) => {
                lines.push((best.heading(), best.named()));
                lines.extend(best.ambiguous().map(|it| ("", it)));
                lines.extend(best.departs().map(|it| ("then", it)));
                if !best.cause.mistakes.is_empty() {
                    lines.push(("", best.sentence()));
                }
                for mistake in best.cause.mistakes.iter() {
                    lines.push(("program", mistake.wrong().to_owned()));
                    lines.push(("lecture", mistake.right().to_owned()));
                }
                lines.push(("fit", best.fit_in_words()));
                lines.extend(others.iter().map(|it| ("runner-up", it.in_a_line())));
            }
            None if self.departure.is_some() => lines
                .push(("mistake", "no known mistake and no wrong number explains it".to_owned())),
            None => {}
        }
        lines.extend(self.notes.iter().map(|note| ("note", note.clone())));
        lines
    }

    /// The form in which a run that departs was read, after a comma.
    fn read_as(&self) -> String {
        match self.form.as_slice() {
            [] => String::new(),
            form => format!(", read in another form: {}", form.join("; ")),
        }
    }
}

impl Scatter {
    fn in_words(&self) -> String {
        let Self { deviation, tolerance } = *self;
        format!("{} in each coordinate; --tolerance {tolerance} allows it", length(deviation))
    }
}

/// Writes a length in the unit that people would use.
pub(crate) fn length(meters: f64) -> String {
    let size = meters.abs();
    let (value, unit) = match size {
        _ if size < 1e-9 => return format!("{meters:.1e} m"),
        _ if size < 1e-6 => (1e9 * meters, "nm"),
        _ if size < 1e-3 * 0.9995 => (1e6 * meters, "µm"),
        _ if size < 1e-2 * 0.9995 => (1e3 * meters, "mm"),
        _ if size < 1.0 * 0.9995 => (1e2 * meters, "cm"),
        _ if size < 1e4 => (meters, "m"),
        _ => (1e-3 * meters, "km"),
    };
    let decimals = usize::from(value.abs() < 99.95);
    format!("{value:.decimals$} {unit}")
}

impl Departure {
    fn place(&self) -> String {
        let written = |[x, y, z]: [f64; 3]| format!("({x:.4}, {y:.4}, {z:.4})");
        let there = written(self.position);
        match (self.expected, self.distance) {
            (Some(expected), Some(distance)) => format!(
                "line {}: the ball is at {there}, {} from {}",
                self.line,
                length(distance),
                written(expected)
            ),
            _ => format!(
                "line {}: the ball is at {there}, but there is none under the rule",
                self.line
            ),
        }
    }

    fn touched(&self) -> String {
        match &self.contact {
            Some(contact) => {
                let only = if contact.only_by_mistake { ", where the rule has none" } else { "" };
                format!("{contact} at {:.2} s{only}", contact.time)
            }
            None => "none".to_owned(),
        }
    }

    /// Returns what the ball does right before.
    fn right(&self) -> Option<String> {
        match self.contacts_right {
            0 => None,
            1 => Some("the ball's first contact is right".to_owned()),
            right => Some(format!("the ball's first {right} contacts are right")),
        }
    }
}

impl std::fmt::Display for DepartureContact {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} of {}", self.kind, self.collider)
    }
}

impl std::fmt::Display for Cause {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mistakes = self.mistakes.iter().map(|it| it.name().to_owned());
        let all: Vec<String> =
            mistakes.chain(self.numbers.iter().map(ToString::to_string)).collect();
        f.write_str(&all.join(" + "))
    }
}

impl Explanation {
    /// Names the mistakes and wrong numbers, and how far they explain the run.
    pub fn named(&self) -> String {
        match &self.then {
            Some(then) => format!("{} until {:.2} s", self.cause, then.time),
            None => self.cause.to_string(),
        }
    }

    /// Names the explanation in a table, where no heading says what it is.
    pub fn in_a_table(&self) -> String {
        if self.nearest { format!("nearest: {}", self.named()) } else { self.named() }
    }

    /// Returns the heading of the named causes.
    fn heading(&self) -> &'static str {
        match (self.nearest, self.cause.mistakes.is_empty()) {
            (true, _) => "nearest",
            (false, true) => "number",
            (false, false) => "mistake",
        }
    }

    /// Names the causes that this run does not distinguish from the best.
    fn ambiguous(&self) -> Option<String> {
        let others: Vec<String> = self.same_as.iter().map(ToString::to_string).collect();
        let others = others.join(", or ");
        (!others.is_empty()).then(|| format!("or {others}: this run cannot tell them apart"))
    }

    /// Returns where the run departs from the named causes.
    fn departs(&self) -> Option<String> {
        let then = self.then.as_ref()?;
        let place = match (&then.contact, then.number) {
            (Some(contact), number) => format!("at contact {number}, {contact}"),
            (None, 0) => "before its first contact".to_owned(),
            (None, number) => format!("after contact {number}"),
        };
        Some(format!("departs from that, too, at {:.2} s: ball {}, {place}", then.time, then.ball))
    }

    fn fit_in_words(&self) -> String {
        let fit = &self.fit;
        let far = if self.nearest { ", far off: the cause may be another" } else { "" };
        format!("{} of {} rows, residual {}{far}", fit.followed, fit.rows, length(fit.rms))
    }

    fn in_a_line(&self) -> String {
        let other = self.ambiguous().map_or(String::new(), |it| format!(", {it}"));
        format!("{}{other} ({})", self.in_a_table(), self.fit_in_words())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::Fit;

    fn fit(followed: usize, rows: usize, rms: f64) -> Fit {
        Fit {
            followed,
            rows,
            rms,
            max: rms,
            max_relative: rms,
            max_velocity: None,
            departure: None,
            residual: rms,
        }
    }

    #[test]
    fn what_leaves_much_more_than_the_tolerance_is_called_the_nearest() {
        let scene = carom_scene::Library::new().find("simtest3", &[]).unwrap().0;
        let course = crate::course::Course::of(&scene).unwrap();
        let explanation = |rms: f64, tolerance: f64| {
            let program = crate::mistake::Mistake::NoDrag.into();
            let candidate = crate::estimate::Candidate { program, fit: fit(90, 90, rms) };
            Explanation::new(candidate, &fit(10, 90, 0.0), tolerance, &course)
        };
        // Single precision leaves some millimetres, up to a centimetre, of a right program.
        let close = explanation(1.3e-2, 5e-4);
        assert_eq!((close.heading(), close.in_a_table().as_str()), ("mistake", "no-drag"));
        let far = explanation(6.1e-2, 5e-4);
        assert_eq!((far.heading(), far.in_a_table().as_str()), ("nearest", "nearest: no-drag"));
        assert!(far.fit_in_words().ends_with("residual 6.1 cm, far off: the cause may be another"));
        // Where positions scatter by centimetres, it is as close as may be.
        assert_eq!(explanation(6.1e-2, 0.1).heading(), "mistake");
    }

    #[test]
    fn a_run_that_is_compared_in_part_is_called_neither_the_same_nor_wrong() {
        let fit = fit(2, 3, 0.0);
        let verdict = Verdict {
            scene: "long".to_owned(),
            same: fit.is_complete(),
            form: Vec::new(),
            scatter: None,
            tolerance: 5e-4,
            balls: 1,
            time: [1.0, 900.0],
            compared_until: Some(400.0),
            fit,
            digits: Some(15),
            departure: None,
            explained: false,
            explanations: Vec::new(),
            notes: Vec::new(),
        };
        let said = "the same as the course's rule up to 400.00 s; what follows is not compared";
        assert_eq!(verdict.headline(), said);
        assert!(verdict.lines().is_empty());
    }
}
