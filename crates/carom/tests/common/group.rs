//! Groups of touching spheres, made without detection.

use carom::DVec3;
use carom::ImpactLaw;
use carom::respond::{GroupResponse, TouchingContact, resolve};

use super::{Numbers, vec};

#[derive(Clone)]
pub struct Group {
    pub contacts: Vec<TouchingContact>,
    pub masses: Vec<f64>,
    pub velocities: Vec<DVec3>,
}

pub fn pair(first: usize, second: usize, normal: DVec3, restitution: f64) -> TouchingContact {
    let surface_velocity = DVec3::ZERO;
    TouchingContact { first: Some(first), second, normal, surface_velocity, restitution }
}

pub fn surface(second: usize, normal: DVec3, restitution: f64) -> TouchingContact {
    let surface_velocity = DVec3::ZERO;
    TouchingContact { first: None, second, normal, surface_velocity, restitution }
}

impl Group {
    /// Balls in a row along x, each touching the next.
    pub fn row(masses: &[f64], speeds: &[f64], e: f64) -> Self {
        let contacts = (1..masses.len()).map(|i| pair(i - 1, i, DVec3::X, e)).collect();
        let velocities = speeds.iter().map(|speed| vec(*speed, 0.0, 0.0)).collect();
        Self { contacts, masses: masses.to_vec(), velocities }
    }

    /// Spheres whose centres are nearly two radii apart touch; those near the floor touch it.
    pub fn touching(centres: &[DVec3], floor: bool, slack: f64, e: impl Fn(usize) -> f64) -> Self {
        let mut contacts = Vec::new();
        for (j, b) in centres.iter().enumerate() {
            if floor && b.y < 0.5 + slack {
                contacts.push(surface(j, DVec3::Y, e(contacts.len())));
            }
            for (i, a) in centres[..j].iter().enumerate() {
                if (*b - *a).length() < 1.0 + slack {
                    contacts.push(pair(i, j, (*b - *a).normalize(), e(contacts.len())));
                }
            }
        }
        let (masses, velocities) = (vec![1.0; centres.len()], vec![DVec3::ZERO; centres.len()]);
        Self { contacts, masses, velocities }
    }

    /// A random heap: each sphere falls onto what is there already, roughly.
    pub fn heap(count: usize, numbers: &mut Numbers, e: impl Fn(usize) -> f64) -> Self {
        // About four layers deep.
        let width = (count as f64 / 4.0).sqrt();
        let mut centres: Vec<DVec3> = Vec::new();
        while centres.len() < count {
            let (x, z) = (numbers.between(0.0, width), numbers.between(0.0, width));
            let height = |below: &DVec3| {
                let (dx, dz) = (x - below.x, z - below.z);
                let room = 1.0 - dx * dx - dz * dz;
                if room > 0.0 { below.y + room.sqrt() } else { 0.5 }
            };
            let y = centres.iter().map(height).fold(0.5, f64::max);
            centres.push(vec(x, y, z));
        }
        let mut group = Self::touching(&centres, true, 0.2, e);
        for velocity in &mut group.velocities {
            *velocity = numbers.vector() - 0.5 * DVec3::Y;
        }
        group
    }

    /// A close packing, shaken a little: up to twelve neighbours each, most contacts redundant.
    pub fn packing(side: usize, numbers: &mut Numbers, e: impl Fn(usize) -> f64) -> Self {
        let (row, layer) = (0.75f64.sqrt(), (2.0f64 / 3.0).sqrt());
        let mut centres = Vec::new();
        for k in 0..side {
            for j in 0..side {
                for i in 0..side {
                    let (x, y, z) = (i as f64, k as f64, j as f64);
                    let shift = 0.5 * ((j + k) % 2) as f64;
                    let centre = vec(x + shift, 0.5 + layer * y, row * z + (k % 2) as f64 / 3.0);
                    centres.push(centre + 0.05 * numbers.vector());
                }
            }
        }
        let mut group = Self::touching(&centres, true, 0.2, e);
        for velocity in &mut group.velocities {
            *velocity = numbers.vector() - 0.5 * DVec3::Y;
        }
        group
    }

    pub fn energy(&self) -> f64 {
        self.masses.iter().zip(&self.velocities).map(|(m, v)| 0.5 * m * v.dot(*v)).sum()
    }

    pub fn momentum(&self) -> DVec3 {
        self.masses.iter().zip(&self.velocities).map(|(m, v)| *m * *v).sum()
    }

    pub fn opening(&self, contact: &TouchingContact) -> f64 {
        let first = contact.first.map_or(contact.surface_velocity, |i| self.velocities[i]);
        (self.velocities[contact.second] - first).dot(contact.normal)
    }

    pub fn worst_closing(&self) -> f64 {
        self.contacts.iter().map(|contact| -self.opening(contact)).fold(0.0, f64::max)
    }

    pub fn resolve(&mut self, law: ImpactLaw) -> GroupResponse {
        resolve(law, &self.contacts, &self.masses, &mut self.velocities)
    }

    pub fn speeds(&self) -> Vec<f64> {
        self.velocities.iter().map(|v| v.x).collect()
    }
}
