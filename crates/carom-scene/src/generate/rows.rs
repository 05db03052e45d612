//! Staggered rows, of spheres or of colliders.

use std::borrow::Cow;

use carom::DVec3;

use super::count::{MOST_SPHERES, check_count};
use crate::error::Problem;
use crate::requirement::{check, check_vector};
use crate::scene::values::vector;
use crate::scene::{Collider, Generator, Scene, StaggeredRows};

/// More colliders than this in one generator are a slip of the keyboard.
const MOST_COLLIDERS: u64 = 1_000_000;

impl StaggeredRows {
    /// Centres \[m\] with the numbers of row and place, from 1.
    pub(super) fn centers(&self, path: &str) -> Result<Vec<(DVec3, [u32; 2])>, Problem> {
        check(self.rows > 0, &format!("{path}.rows"), || "must be at least 1, not 0".into())?;
        let counts_path = format!("{path}.counts");
        check(self.counts.iter().all(|&count| count > 0), &counts_path, || {
            format!("must be at least 1 each, not {:?}", self.counts)
        })?;
        let (most, made) = match (&self.sphere, &self.collider) {
            (Some(_), None) => (MOST_SPHERES, "spheres"),
            (None, Some(_)) => (MOST_COLLIDERS, "colliders"),
            (None, None) => return Err(Problem::new(path, "needs `sphere` or `collider`")),
            (Some(_), Some(_)) => {
                let text = "`sphere` says already what there is";
                return Err(Problem::new(format!("{path}.collider"), text));
            }
        };
        check_count(self.places(), (most, made), &counts_path)?;
        check_vector(self.start, &format!("{path}.start"))?;
        check_vector(self.step, &format!("{path}.step"))?;
        check_vector(self.row_step, &format!("{path}.row_step"))?;
        let [start, step, row_step] = [self.start, self.step, self.row_step].map(vector);
        let rows = (0..self.rows).zip(self.counts.iter().cycle());
        let place = |row: u32, count: u32, i: u32| {
            let shift = 0.5 * (f64::from(self.counts[0]) - f64::from(count));
            let center = start + f64::from(row) * row_step + (shift + f64::from(i)) * step;
            (center, [row + 1, i + 1])
        };
        Ok(rows.flat_map(|(row, &count)| (0..count).map(move |i| place(row, count, i))).collect())
    }

    /// Its colliders, one by one.
    fn colliders(&self, template: &Collider, path: &str) -> Result<Vec<Collider>, Problem> {
        let colliders = self.centers(path)?.into_iter().map(|(center, [row, place])| {
            let name = match template.name.as_str() {
                "" => String::new(),
                name => format!("{name} {row}-{place}"),
            };
            let position = (center + vector(template.position)).to_array();
            Collider { name, position, ..template.clone() }
        });
        Ok(colliders.collect())
    }
}

impl Generator {
    /// The colliders it stands for, one by one.
    pub(crate) fn colliders(&self, path: &str) -> Result<Vec<Collider>, Problem> {
        match (self, self.collider()) {
            (Self::StaggeredRows(rows), Some(template)) => rows.colliders(template, path),
            _ => Ok(Vec::new()),
        }
    }
}

impl Scene {
    /// All colliders, in the order in which its world has them: the single ones, then those of
    /// generators. A generator that makes no sense makes none.
    pub fn all_colliders(&self) -> Cow<'_, [Collider]> {
        if self.generators.iter().all(|generator| generator.collider().is_none()) {
            return Cow::Borrowed(&self.colliders);
        }
        let generated = self.generators.iter().filter_map(|generator| generator.colliders("").ok());
        Cow::Owned(self.colliders.iter().cloned().chain(generated.flatten()).collect())
    }
}
