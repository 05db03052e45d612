//! Ids, looks and friction of the spheres in a world.

use carom::{SphereId, Spheres};
use carom_scene::scene::Finish;
use carom_scene::{Coat, Paint, Palette};

use crate::frictions::Frictions;

/// Ids, looks and friction of the spheres of a world in order, for JavaScript.
///
/// A sphere gets its look when it is added, and keeps it.
#[derive(Debug, Clone, Default)]
pub struct Members {
    /// Ids as JavaScript's numbers, which are exact up to 2^53.
    ids: Vec<f64>,
    /// Red, green and blue of each sphere, in \[0, 1\] (sRGB).
    colors: Vec<f32>,
    finishes: Vec<Finish>,
    frictions: Frictions,
}

impl Members {
    /// Returns the ids, ascending.
    pub fn ids(&self) -> &[f64] {
        &self.ids
    }

    /// Returns the colours, three numbers each.
    pub fn colors(&self) -> &[f32] {
        &self.colors
    }

    /// Returns the coefficients of friction.
    pub fn frictions(&self) -> &Frictions {
        &self.frictions
    }

    /// Updates the coefficients of friction after a change of spheres; those before `index` are
    /// unchanged.
    pub fn follow_frictions(&mut self, spheres: &Spheres, index: usize) {
        self.frictions.follow(spheres, index);
    }

    /// Adds a sphere; its id must be the largest so far.
    pub fn add(&mut self, id: SphereId, Coat { color, finish }: Coat) {
        self.push(id.number() as f64, color.map(|part| part as f32), finish);
    }

    /// Removes the sphere at an index.
    pub fn remove(&mut self, index: usize) {
        self.ids.remove(index);
        self.colors.drain(3 * index..3 * index + 3);
        self.finishes.remove(index);
    }

    /// Returns colour and finish of the sphere at an index.
    pub fn look(&self, index: usize) -> Paint {
        // The shortest decimal for this number, as it was written in the scene.
        let part = |part: f32| part.to_string().parse().unwrap_or(f64::from(part));
        let color = [0, 1, 2].map(|i| part(self.colors[3 * index + i]));
        Paint { color: Some(color), finish: self.finishes[index] }
    }

    /// Sets the finish of the sphere at an index, and its colour if there is one.
    pub fn paint(&mut self, index: usize, Paint { color, finish }: Paint) {
        let parts = self.colors[3 * index..].iter_mut().zip(color.into_iter().flatten());
        parts.for_each(|(part, value)| *part = value as f32);
        self.finishes[index] = finish;
    }

    /// Adds and removes what emitters emitted and retired, so that the lists match `spheres`.
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
