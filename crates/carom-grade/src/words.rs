//! Describes verdicts in words.

use crate::verdict::{Departure, Explanation, Verdict};

impl Verdict {
    /// Result in one line.
    pub fn headline(&self) -> String {
        if self.same {
            return format!(
                "same as the course's rule, to {} digits (largest difference {:.1e} m)",
                self.digits.unwrap_or(0),
                self.fit.max
            );
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
        format!("departs from the course's rule at {time:.2} s, ball {ball}")
    }

    /// Further lines of the verdict, each with a name.
    pub fn lines(&self) -> Vec<(&'static str, String)> {
        let mut lines = Vec::new();
        if let Some(departure) = &self.departure {
            lines.push(("where", departure.place()));
            lines.push(("contact", departure.touched()));
        }
        match self.explanations.split_first() {
            Some((best, others)) if self.explained => {
                lines.push(("mistake", best.named()));
                lines.push(("", best.sentence()));
                for mistake in best.mistakes.iter() {
                    lines.push(("program", mistake.wrong().to_owned()));
                    lines.push(("lecture", mistake.right().to_owned()));
                }
                lines.push(("fit", best.fit_in_words()));
                lines.extend(others.iter().map(|it| ("runner-up", it.in_a_line())));
            }
            Some((best, _)) => {
                let nearest =
                    format!("no known mistake explains it; nearest is {}", best.in_a_line());
                lines.push(("mistake", nearest));
            }
            None if self.departure.is_some() => {
                lines.push(("mistake", "no known mistake explains it".to_owned()))
            }
            None => {}
        }
        lines.extend(self.notes.iter().map(|note| ("note", note.clone())));
        lines
    }
}

impl Departure {
    fn place(&self) -> String {
        let written = |[x, y, z]: [f64; 3]| format!("({x:.4}, {y:.4}, {z:.4})");
        let there = written(self.position);
        match (self.expected, self.distance) {
            (Some(expected), Some(distance)) => format!(
                "line {}: the ball is at {there}, {distance:.2e} m from {}",
                self.line,
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
                format!("{} of {} at {:.2} s{only}", contact.kind, contact.collider, contact.time)
            }
            None => "none".to_owned(),
        }
    }
}

impl Explanation {
    /// Names the mistakes, and those that this run does not distinguish from them.
    pub fn named(&self) -> String {
        let mut names = self.mistakes.to_string();
        for other in &self.same_as {
            names += &format!(", or {} (this run cannot tell)", other.name());
        }
        names
    }

    fn fit_in_words(&self) -> String {
        let fit = &self.fit;
        if self.share <= 0.0 {
            let after = self.distance_after;
            return format!(
                "follows no longer than the rule; {after:.1e} m off right after it departs"
            );
        }
        let until = fit.departure.map_or(String::new(), |it| format!(", until {:.2} s", it.time));
        format!("{} of {} rows{until}, residual {:.1e} m", fit.followed, fit.rows, fit.rms)
    }

    fn in_a_line(&self) -> String {
        format!("{} ({})", self.named(), self.fit_in_words())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::Fit;

    #[test]
    fn a_run_that_is_compared_in_part_is_called_neither_the_same_nor_wrong() {
        let fit = Fit {
            followed: 2,
            rows: 3,
            rms: 0.0,
            max: 0.0,
            max_relative: 0.0,
            max_velocity: None,
            departure: None,
            residual: 0.0,
        };
        let verdict = Verdict {
            scene: "long".to_owned(),
            same: fit.is_complete(),
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
