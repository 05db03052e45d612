//! Islands: groups of spheres whose frames are cut by the same contacts.

use crate::detect::ContactState;
use crate::detect::contact::Contact;
use crate::force_work::ForceWork;
use crate::report::{Impact, StepReport};

/// Marks a sphere that belongs to no island.
const NONE: u32 = u32::MAX;

/// A group of spheres that goes through the frame together.
#[derive(Debug, Clone, Default)]
pub(super) struct Island {
    /// Indices of its spheres, ascending; empty once it has become part of another island.
    pub members: Vec<u32>,
    /// Whether its way through the frame is known.
    pub settled: bool,
    /// Whether it was given up on its way.
    pub unfinished: bool,
    /// What happened on its way.
    pub impacts: Vec<Impact>,
    /// Work of putting spheres onto surfaces \[J\].
    pub correction: f64,
    /// Work of nonconservative forces.
    pub work: ForceWork,
}

impl Island {
    fn is_unsettled(&self) -> bool {
        !self.settled && !self.members.is_empty()
    }
}

/// A division of the spheres into islands and lone ones.
#[derive(Debug, Clone, Default)]
pub(super) struct Islands {
    list: Vec<Island>,
    island_numbers: Vec<u32>,
}

impl Islands {
    /// Every one of `count` spheres alone.
    pub fn reset(&mut self, count: usize) {
        self.list.clear();
        self.island_numbers.clear();
        self.island_numbers.resize(count, NONE);
    }

    /// All spheres in one island.
    pub fn join_all(&mut self) {
        let members = 0..self.island_numbers.len() as u32;
        self.island_numbers.fill(0);
        self.list.push(Island { members: members.collect(), ..Island::default() });
    }

    /// Joins spheres that intersect, and those that intersect a surface into islands of their
    /// own. An island that gains spheres is no longer settled.
    ///
    /// Contacts within an island that is settled already are left: it did what it could.
    pub fn join(&mut self, contacts: &[Contact]) {
        for contact in contacts {
            if contact.state == ContactState::Intersecting {
                let mut spheres = contact.spheres();
                let first = spheres.next().map(|sphere| self.island_of(sphere));
                let second = spheres.next().map(|sphere| self.island_of(sphere));
                if let (Some(a), Some(b)) = (first, second) {
                    self.merge(a, b);
                }
            }
        }
    }

    fn island_of(&mut self, sphere: u32) -> u32 {
        let island = &mut self.island_numbers[sphere as usize];
        if *island == NONE {
            *island = self.list.len() as u32;
            self.list.push(Island { members: vec![sphere], ..Island::default() });
        }
        *island
    }

    fn merge(&mut self, a: u32, b: u32) {
        if a == b {
            return;
        }
        let size = |island: u32| self.list[island as usize].members.len();
        let (into, from) = if size(a) >= size(b) { (a, b) } else { (b, a) };
        let gained = std::mem::take(&mut self.list[from as usize]).members;
        for &sphere in &gained {
            self.island_numbers[sphere as usize] = into;
        }
        let island = &mut self.list[into as usize];
        island.members.extend(gained);
        island.settled = false;
    }

    /// Islands whose way through the frame is to be found (again), ready for it.
    pub fn unsettled(&mut self) -> impl Iterator<Item = &mut Island> {
        let mut unsettled: Vec<_> =
            self.list.iter_mut().filter(|island| island.is_unsettled()).collect();
        for island in &mut unsettled {
            island.members.sort_unstable();
            island.impacts.clear();
            island.correction = 0.0;
            island.work = ForceWork::default();
            island.unfinished = false;
        }
        unsettled.into_iter()
    }

    /// Whether any island's way through the frame is to be found.
    pub fn any_unsettled(&self) -> bool {
        self.list.iter().any(Island::is_unsettled)
    }

    /// Reports what happened on all ways, in order of time.
    pub fn report(&self, report: &mut StepReport) {
        for island in &self.list {
            report.impacts.extend_from_slice(&island.impacts);
            report.energy_account.correction += island.correction;
            report.energy_account.add_force_work(island.work);
            report.unfinished_islands += u32::from(island.unfinished);
        }
        report.impacts.sort_by(|a, b| a.time.total_cmp(&b.time));
    }

    /// Whether a sphere belongs to an island.
    pub fn contain(&self, sphere: u32) -> bool {
        self.island_numbers[sphere as usize] != NONE
    }

    /// Spheres that belong to islands, ascending.
    pub fn members(&self) -> impl Iterator<Item = u32> {
        (0..self.island_numbers.len() as u32).filter(|&sphere| self.contain(sphere))
    }
}
