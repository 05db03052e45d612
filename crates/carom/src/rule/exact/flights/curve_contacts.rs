//! Persistent contacts of spheres that fly on curves: the forces that keep their gaps as they are.

use glam::DVec3;

use crate::integrate::gauss_radau::Values;
use crate::rule::exact::features::{Feature, NormalCurvature};

/// Most contacts whose forces are solved for at once: the work grows with the third power of their number.
pub(crate) const MOST_CONTACTS: usize = 32;
/// Contacts depend on each other where what one adds to the others is below this part of it.
const DEPENDENT: f64 = 1e-8;

/// A persistent contact of the sphere at a place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CurveContact {
    pub first: CurveBody,
    pub second: usize,
}

/// What a sphere touches.
#[derive(Debug, Clone, Copy)]
pub(crate) enum CurveBody {
    /// The sphere at a place.
    Sphere(usize),
    /// A part of a surface at rest.
    Feature(Feature),
}

impl CurveContact {
    /// Its place, if body 1 is a sphere.
    fn first_place(&self) -> Option<usize> {
        match self.first {
            CurveBody::Sphere(place) => Some(place),
            CurveBody::Feature(_) => None,
        }
    }

    /// Unit normal from body 1 to body 2, and how it turns, with the spheres at these positions \[m\].
    fn normal_at(&self, positions: &[DVec3]) -> (DVec3, NormalCurvature) {
        let center = positions[self.second];
        match &self.first {
            CurveBody::Sphere(first) => Feature::Point(positions[*first]).normal_at(center),
            CurveBody::Feature(feature) => feature.normal_at(center),
        }
    }
}

/// Contacts whose forces follow from where the spheres are.
///
/// With the normal `n`, the relative velocity `v` and the part `v_t` of it across `n`, the gap stays where
/// `n·(a2 − a1) + κ v_t² = 0`, with the curvature κ: `1/|x2 − x1|` between spheres. The accelerations without contacts
/// and the forces `λ n` give `A λ = -b` for all contacts, by Cholesky's method.
///
/// Source: Baraff, Computer Graphics 23, 223 (1989), section 5, with equalities.
pub(crate) struct CurveContacts {
    contacts: Vec<CurveContact>,
    /// One per contact.
    normals: Vec<DVec3>,
    /// How each normal turns.
    curvatures: Vec<NormalCurvature>,
    /// One per contact \[N\]
    pub forces: Vec<f64>,
    /// Those found first, before what rounding left is removed \[N\].
    first_forces: Vec<f64>,
    /// Cholesky's factor, by rows.
    factor: Vec<f64>,
}

impl CurveContacts {
    pub fn new(contacts: Vec<CurveContact>) -> Self {
        let count = contacts.len();
        Self {
            contacts,
            normals: vec![DVec3::ZERO; count],
            curvatures: vec![NormalCurvature::Flat; count],
            forces: vec![0.0; count],
            first_forces: vec![0.0; count],
            factor: vec![0.0; count * count],
        }
    }

    /// The contacts, with their forces \[N\].
    pub fn iter(&self) -> impl Iterator<Item = (&CurveContact, f64)> {
        self.contacts.iter().zip(self.forces.iter().copied())
    }

    /// Whether no contact of spheres at these positions \[m\] follows from the others; `mass_of` gives the mass of a
    /// sphere \[kg\].
    pub fn are_independent(
        &mut self,
        positions: &[DVec3],
        mass_of: impl Fn(usize) -> f64 + Copy,
    ) -> bool {
        self.find_normals(positions);
        self.factorize(mass_of)
    }

    /// Finds the forces and adds their accelerations \[m/s²\] to those `at` these positions \[m\] and velocities \[m/s\].
    pub fn add(
        &mut self,
        [positions, velocities]: [&[DVec3]; 2],
        mass_of: impl Fn(usize) -> f64 + Copy,
        at: &mut Values,
    ) {
        self.find_normals(positions);
        self.factorize(mass_of);
        // The second time removes what rounding left of the first: what rests does not drift.
        self.remove_openings(velocities, mass_of, at);
        self.first_forces.copy_from_slice(&self.forces);
        self.remove_openings(velocities, mass_of, at);
        self.forces.iter_mut().zip(&self.first_forces).for_each(|(force, first)| *force += first);
    }

    /// Adds the accelerations \[m/s²\] of the forces under which no gap opens or closes.
    fn remove_openings(
        &mut self,
        velocities: &[DVec3],
        mass_of: impl Fn(usize) -> f64,
        at: &mut Values,
    ) {
        for (number, contact) in self.contacts.iter().enumerate() {
            let normal = self.normals[number];
            let first = |of: &[DVec3]| contact.first_place().map_or(DVec3::ZERO, |it| of[it]);
            let velocity = velocities[contact.second] - first(velocities);
            let across = velocity - velocity.dot(normal) * normal;
            let acceleration = at.accelerations[contact.second] - first(&at.accelerations);
            let turning = self.curvatures[number].acceleration(across);
            self.forces[number] = -(acceleration.dot(normal) + turning);
        }
        self.solve();
        for ((contact, &normal), &force) in
            self.contacts.iter().zip(&self.normals).zip(&self.forces)
        {
            let ends = contact.first_place().map(|first| (first, -force)).into_iter();
            for (place, force) in ends.chain([(contact.second, force)]) {
                let part = force / mass_of(place);
                at.accelerations[place] += part * normal;
                at.sizes[place] += part.abs();
            }
        }
    }

    fn find_normals(&mut self, positions: &[DVec3]) {
        for (number, contact) in self.contacts.iter().enumerate() {
            (self.normals[number], self.curvatures[number]) = contact.normal_at(positions);
        }
    }

    /// The acceleration of a gap for a unit of force at another contact \[1/kg\].
    fn coupling(&self, one: usize, other: usize, mass_of: impl Fn(usize) -> f64) -> f64 {
        let [a, b] = [one, other].map(|number| &self.contacts[number]);
        let ends = |it: &CurveContact| [(Some(it.second), 1.0), (it.first_place(), -1.0)];
        let mut sum = 0.0;
        for (place, sign) in ends(a) {
            for (other, other_sign) in ends(b) {
                if let Some(place) = place.filter(|_| place == other) {
                    sum += sign * other_sign / mass_of(place);
                }
            }
        }
        if sum == 0.0 { 0.0 } else { sum * self.normals[one].dot(self.normals[other]) }
    }

    /// Factorizes the matrix of couplings. Returns whether all contacts are independent; one that is not gets no force.
    fn factorize(&mut self, mass_of: impl Fn(usize) -> f64 + Copy) -> bool {
        let count = self.contacts.len();
        let mut are_independent = true;
        for row in 0..count {
            for column in 0..=row {
                let known: f64 = (0..column)
                    .map(|k| self.factor[row * count + k] * self.factor[column * count + k])
                    .sum();
                let coupling = self.coupling(row, column, mass_of);
                let rest = coupling - known;
                let diagonal = self.factor[column * count + column];
                self.factor[row * count + column] = if row == column {
                    let is_dependent = rest <= DEPENDENT * coupling;
                    are_independent &= !is_dependent;
                    if is_dependent { 0.0 } else { rest.sqrt() }
                } else if diagonal > 0.0 {
                    rest / diagonal
                } else {
                    0.0
                };
            }
        }
        are_independent
    }

    /// Solves for the forces in place.
    fn solve(&mut self) {
        let count = self.contacts.len();
        let Self { forces, factor, .. } = self;
        let quotient =
            |rest: f64, diagonal: f64| if diagonal > 0.0 { rest / diagonal } else { 0.0 };
        for row in 0..count {
            let known: f64 = (0..row).map(|k| factor[row * count + k] * forces[k]).sum();
            forces[row] = quotient(forces[row] - known, factor[row * count + row]);
        }
        for row in (0..count).rev() {
            let known: f64 = (row + 1..count).map(|k| factor[k * count + row] * forces[k]).sum();
            forces[row] = quotient(forces[row] - known, factor[row * count + row]);
        }
    }
}
