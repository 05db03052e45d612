//! The spheres in a world, their looks, and what they say of friction.

use carom::{SphereId, Spheres};
use carom_scene::scene::Finish;
use carom_scene::{Coat, Paint, Palette};

use crate::frictions::Frictions;

/// Ids, looks and friction of the spheres of a world, in their order, as JavaScript reads them.
///
/// A sphere gets its look when it comes into the world, and keeps it.
#[derive(Debug, Clone, Default)]
pub struct Members {
    /// Ids, as JavaScript's numbers: exact up to 2^53.
    ids: Vec<f64>,
    /// Red, green and blue of each, in \[0, 1\] (sRGB).
    colors: Vec<f32>,
    finishes: Vec<Finish>,
    frictions: Frictions,
}

impl Members {
    /// Ids, ascending.
    pub fn ids(&self) -> &[f64] {
        &self.ids
    }

    /// Three parts of each colour.
    pub fn colors(&self) -> &[f32] {
        &self.colors
    }

    /// Coefficients of friction.
    pub fn frictions(&self) -> &Frictions {
        &self.frictions
    }

    /// Has the coefficients of friction follow a change of spheres: those before `index` are as they
    /// were.
    pub fn follow_frictions(&mut self, spheres: &Spheres, index: usize) {
        self.frictions.follow(spheres, index);
    }

    /// Adds a sphere that was added in code; its id must be the largest so far.
    pub fn add(&mut self, id: SphereId, Coat { color, finish }: Coat) {
        self.push(id.number() as f64, color.map(|part| part as f32), finish);
    }

    /// Takes out the sphere at an index.
    pub fn remove(&mut self, index: usize) {
        self.ids.remove(index);
        self.colors.drain(3 * index..3 * index + 3);
        self.finishes.remove(index);
    }

    /// Colour and finish of the sphere at an index.
    pub fn look(&self, index: usize) -> Paint {
        // The shortest decimal that is this number: what was written in the scene.
        let part = |part: f32| part.to_string().parse().unwrap_or(f64::from(part));
        let color = [0, 1, 2].map(|i| part(self.colors[3 * index + i]));
        Paint { color: Some(color), finish: self.finishes[index] }
    }

    /// Gives the sphere at an index this finish, and this colour if there is one.
    pub fn paint(&mut self, index: usize, Paint { color, finish }: Paint) {
        let parts = self.colors[3 * index..].iter_mut().zip(color.into_iter().flatten());
        parts.for_each(|(part, value)| *part = value as f32);
        self.finishes[index] = finish;
    }

    /// Follows what emitters added and retired: `spheres` are those of now.
    pub fn follow(&mut self, spheres: &Spheres, palette: &Palette) {
        let before = std::mem::take(self);
        // Both lists are ascending.
        let mut place = 0;
        for (index, id) in spheres.ids().iter().enumerate() {
            let number = id.number() as f64;
            while before.ids.get(place).is_some_and(|&id| id < number) {
                place += 1;
            }
            let known = before.ids.get(place) == Some(&number);
            let (color, finish) = match before.colors.get(3 * place..3 * place + 3) {
                Some(&[red, green, blue]) if known => ([red, green, blue], before.finishes[place]),
                _ => {
                    let (radius, mass) = (spheres.radii()[index], spheres.masses()[index]);
                    let Coat { color, finish } = palette.sphere(id.number(), radius, mass);
                    (color.map(|part| part as f32), finish)
                }
            };
            self.push(number, color, finish);
        }
        self.frictions.follow(spheres, 0);
    }

    fn push(&mut self, number: f64, color: [f32; 3], finish: Finish) {
        self.ids.push(number);
        self.colors.extend(color);
        self.finishes.push(finish);
    }
}
