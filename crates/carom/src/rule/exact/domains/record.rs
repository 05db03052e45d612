//! Records: which events of a domain reported something, so that the reports of all can be put in order.

use crate::report::{ImpactGroup, StepReport};

/// An event that reported impacts.
#[derive(Debug, Clone, Copy)]
pub(super) struct Record {
    /// Time on the world's clock \[s\].
    time: f64,
    /// The sphere whose event it was, by index: what comes first at one time.
    index: u32,
    /// Its groups in the report of the domain: the first, and their number.
    groups: [usize; 2],
}

/// The reports of a domain, event by event.
#[derive(Debug, Default)]
pub(super) struct Records {
    pub report: StepReport,
    records: Vec<Record>,
}

impl Records {
    /// Forgets everything.
    pub fn clear(&mut self) {
        self.report.clear();
        self.records.clear();
    }

    /// Notes that the event of a sphere, by index, at `time` \[s\] reported the last of so many `groups`.
    pub fn note(&mut self, index: u32, time: f64, groups: usize) {
        let first = self.records.last().map_or(0, |last| last.groups.iter().sum());
        let count = groups - first;
        if count == 0 {
            return;
        }
        // Within a domain the order is that of its queue.
        let is_at_once = |last: &&Record| last.time == time;
        let before = self.records.last().filter(is_at_once).map_or(0, |last| last.index);
        self.records.push(Record { time, index: index.max(before), groups: [first, count] });
    }
}

/// Appends the reports of several domains in the order in which one queue would have answered their events.
pub(super) fn append_in_order(all: &[&Records], report: &mut StepReport) {
    let mut order: Vec<(Record, usize)> = Vec::new();
    for (number, records) in all.iter().enumerate() {
        order.extend(records.records.iter().map(|&record| (record, number)));
    }
    order.sort_by(|(one, _), (other, _)| {
        one.time.total_cmp(&other.time).then(one.index.cmp(&other.index))
    });
    report.groups.reserve(order.len());
    report.impacts.reserve(all.iter().map(|records| records.report.impacts.len()).sum());
    for (Record { groups: [first, count], .. }, number) in order {
        let from = &all[number].report;
        for group in &from.groups[first..first + count] {
            let first = report.impacts.len();
            report.impacts.extend(&from.impacts[group.first..group.first + group.count]);
            report.groups.push(ImpactGroup { first, ..*group });
        }
    }
}
