//! What an import did not understand.

use std::fmt;

/// What of a scene was not understood, or has no counterpart: one line of the report.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Omission {
    /// The object, by the names from the root of the scene, like `Maze/Wall`; the file where it is
    /// about no object.
    pub object: String,
    /// Which part of it.
    pub component: String,
    /// Why it is left out, or what it is taken for.
    pub reason: String,
    /// How many objects this holds for; `object` is the first of them.
    pub count: usize,
}

impl fmt::Display for Omission {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { object, component, reason, count } = self;
        match count {
            1 => write!(f, "{object}: {component}: {reason}"),
            _ => write!(f, "{object} and {} more: {component}: {reason}", count - 1),
        }
    }
}

/// Adds a line to a report, or counts it where the like is there.
pub(crate) fn omit(
    report: &mut Vec<Omission>,
    object: &str,
    component: &str,
    reason: impl Into<String>,
) {
    /// Lines of a report. What is beyond is counted in the last one.
    const MOST: usize = 1000;
    let reason = reason.into();
    let same = report.iter_mut().find(|it| it.component == component && it.reason == reason);
    if let Some(same) = same {
        same.count += 1;
    } else if report.len() < MOST {
        let (object, component) = (object.to_owned(), component.to_owned());
        report.push(Omission { object, component, reason, count: 1 });
    } else if report.len() == MOST {
        let reason = "the report is cut here".to_owned();
        let (object, component) = (object.to_owned(), "more".to_owned());
        report.push(Omission { object, component, reason, count: 1 });
    } else if let Some(last) = report.last_mut() {
        last.count += 1;
    }
}
