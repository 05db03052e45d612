//! Persistent contacts of spheres that fly on curves: the forces that keep their gaps as they are, with Coulomb
//! friction.

use glam::DVec3;

use super::friction_state::FrictionState;
use super::moving_surface::{Carried, MovingSurface};
use crate::contact_matrix::ContactMatrix;
use crate::contact_tangents::tangents;
use crate::integrate::field::Values;
use crate::norm::Norm;
use crate::rule::exact::features::{Feature, NormalCurvature};

/// Most contacts whose forces are solved for at once: the work grows with the third power of their number.
pub(crate) const MOST_CONTACTS: usize = 64;
/// The third power of a number of forces that takes a unit of work.
const CUBE_PER_UNIT: u64 = 1000;

/// A persistent contact of the sphere at a place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CurveContact<'a> {
    pub first: CurveBody<'a>,
    pub second: usize,
    /// Shift from the centre of body 2 to its image beside body 1 \[m\].
    pub shift: DVec3,
    /// Coulomb's coefficient.
    pub friction: f64,
}

/// What a sphere touches.
#[derive(Debug, Clone, Copy)]
pub(crate) enum CurveBody<'a> {
    /// The sphere at a place.
    Sphere(usize),
    /// A part of a surface at rest.
    Feature(Feature),
    /// A part of a surface that moves, where the system says that it is.
    Moving(Feature, MovingSurface<'a>),
}

/// What a contact needs to know of a sphere.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContactSphere {
    /// \[m\]
    pub radius: f64,
    /// \[kg\]
    pub mass: f64,
    /// Moment of inertia, divided by m r².
    pub inertia_factor: f64,
}

/// The motion of spheres, by place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Moving<'a> {
    /// On the world's clock \[s\].
    pub time: f64,
    /// \[m\]
    pub positions: &'a [DVec3],
    /// \[m/s\]
    pub velocities: &'a [DVec3],
    /// \[rad/s\]
    pub angular_velocities: &'a [DVec3],
}

impl<'a> CurveBody<'a> {
    /// A part of a surface, which may move.
    pub fn part_of(feature: Feature, moving: Option<MovingSurface<'a>>) -> Self {
        moving.map_or(Self::Feature(feature), |surface| Self::Moving(feature, surface))
    }
}

impl<'a> Moving<'a> {
    /// The motion of `count` spheres at a time \[s\], given by that of all centres, then of all angles.
    pub fn of(time: f64, [positions, velocities]: [&'a [DVec3]; 2], count: usize) -> Self {
        let (velocities, angular_velocities) = velocities.split_at(count);
        Self { time, positions: &positions[..count], velocities, angular_velocities }
    }

    /// Angular velocity of a sphere \[rad/s\]; zero where no friction acts.
    fn turning(&self, place: usize) -> DVec3 {
        self.angular_velocities.get(place).copied().unwrap_or(DVec3::ZERO)
    }
}

/// A direction of the force of a contact, and the direction along which that force allows no acceleration.
#[derive(Debug, Clone, Copy)]
struct ForceDirection {
    /// Number of the contact.
    contact: usize,
    /// Normal of the contact.
    normal: DVec3,
    /// Force on body 2, per unit.
    force: DVec3,
    /// Unit vector along which body 2 does not accelerate relative to body 1.
    held: DVec3,
    /// Whether `held` is along the surfaces, which then do not slide; else it is the normal.
    is_along: bool,
}

impl<'a> CurveContact<'a> {
    /// Returns the place of body 1 if it is a sphere.
    pub fn first_place(&self) -> Option<usize> {
        match self.first {
            CurveBody::Sphere(place) => Some(place),
            CurveBody::Feature(_) | CurveBody::Moving(..) => None,
        }
    }

    /// Places of its spheres, with the sign of a force on body 2 there.
    pub fn ends(&self) -> impl Iterator<Item = (usize, f64)> + use<> {
        self.first_place().map(|first| (first, -1.0)).into_iter().chain([(self.second, 1.0)])
    }

    /// Unit normal from body 1 to body 2, how it turns, and what the motion of a surface adds.
    fn measure(&self, moving: Moving) -> (DVec3, NormalCurvature, Carried) {
        let center = match self.shift {
            DVec3::ZERO => moving.positions[self.second],
            shift => moving.positions[self.second] + shift,
        };
        let at_rest = |feature: &Feature| {
            let (normal, curvature) = feature.normal_at(center);
            (normal, curvature, Carried::default())
        };
        match &self.first {
            CurveBody::Sphere(first) => at_rest(&Feature::Point(moving.positions[*first])),
            CurveBody::Feature(feature) => at_rest(feature),
            CurveBody::Moving(feature, surface) => {
                let state = surface.at(moving.time);
                let (normal, curvature) = feature.normal_at(state.placement.point_back(center));
                let turning = moving.turning(self.second);
                let carried = state.carried([center, moving.velocities[self.second], turning]);
                let placement = &state.placement;
                (placement.direction(normal), curvature.turned(placement), carried)
            }
        }
    }

    /// Adds the accelerations by a force on body 2 \[N\], and the angular ones behind them where it has a torque.
    pub fn push(
        &self,
        (normal, force): (DVec3, DVec3),
        has_torque: bool,
        spheres: &[ContactSphere],
        accelerations: &mut [DVec3],
    ) {
        for (place, sign) in self.ends() {
            let ContactSphere { radius, mass, inertia_factor } = spheres[place];
            accelerations[place] += (sign / mass) * force;
            if has_torque {
                let turning = normal.cross(force) / (inertia_factor * mass * radius);
                accelerations[spheres.len() + place] -= turning;
            }
        }
    }

    /// Adds what a force of this size \[N\] may add to the accelerations, and to the angular ones behind them.
    fn add_sizes(
        &self,
        force: f64,
        has_torque: bool,
        spheres: &[ContactSphere],
        sizes: &mut [f64],
    ) {
        for (place, _) in self.ends() {
            let ContactSphere { radius, mass, inertia_factor } = spheres[place];
            sizes[place] += force / mass;
            if has_torque {
                sizes[spheres.len() + place] += force / (inertia_factor * mass * radius);
            }
        }
    }

    /// Returns the value of body 2 less that of body 1, of values by place.
    fn difference(&self, of: &[DVec3]) -> DVec3 {
        of[self.second] - self.first_place().map_or(DVec3::ZERO, |first| of[first])
    }

    /// The sum of radius times these angular values by place.
    fn surface_turning(&self, spheres: &[ContactSphere], of: &[DVec3]) -> DVec3 {
        self.ends().map(|(place, _)| spheres[place].radius * of[place]).sum()
    }
}

/// Contacts whose forces follow from how the spheres move.
///
/// With the normal `n`, the relative velocity `v` and the part `v_t` of it across `n`, the gap stays where
/// `n·(a2 − a1) + κ v_t² = 0`, with the curvature κ: `1/|x2 − x1|` between spheres. Where the surfaces slide with the
/// slip `s = v_t − (r1 ω1 + r2 ω2) × n`, friction is `−μ N s/|s|`; where they do not, `s' = 0` across `n`, too. That
/// makes as many linear equations as there are forces.
///
/// Source: Baraff, Computer Graphics 23, 223 (1989), section 5, with equalities; with friction, Glocker and Pfeiffer,
/// Nonlinear Dynamics 7, 471 (1995).
pub(crate) struct CurveContacts<'a> {
    pub contacts: Vec<CurveContact<'a>>,
    /// One per contact: those that have a sphere in common with it, ascending.
    linked: Vec<Vec<usize>>,
    /// One per contact.
    pub states: Vec<FrictionState>,
    /// One per contact: friction beyond the largest that counts as rounding \[N\].
    pub slack: Vec<f64>,
    /// One per contact.
    pub normals: Vec<DVec3>,
    /// How each normal turns.
    curvatures: Vec<NormalCurvature>,
    /// What the motion of a surface adds to each contact.
    carried: Vec<Carried>,
    directions: Vec<ForceDirection>,
    /// Number of the first direction of each contact, and of all directions.
    first_directions: Vec<usize>,
    matrix: ContactMatrix,
    /// Forces along the directions \[N\].
    parts: Vec<f64>,
    /// One per contact: normal force and friction on body 2 \[N\].
    pub forces: Vec<(f64, DVec3)>,
    /// Units of work spent so far.
    pub work: u64,
}

impl<'a> CurveContacts<'a> {
    /// Contacts without friction up to the choice of their states. The work is least where those of neighbours are
    /// beside each other.
    pub fn new(contacts: Vec<CurveContact<'a>>) -> Self {
        let count = contacts.len();
        let shares = |one: &CurveContact, other: &CurveContact| {
            one.ends().any(|(place, _)| other.ends().any(|it| it.0 == place))
        };
        let linked_with = |one: &CurveContact| {
            (0..count).filter(|&other| shares(one, &contacts[other])).collect()
        };
        Self {
            linked: contacts.iter().map(linked_with).collect(),
            contacts,
            states: vec![FrictionState::None; count],
            slack: vec![0.0; count],
            normals: vec![DVec3::ZERO; count],
            curvatures: vec![NormalCurvature::Flat; count],
            carried: vec![Carried::default(); count],
            directions: Vec::new(),
            first_directions: Vec::new(),
            matrix: ContactMatrix::default(),
            parts: Vec::new(),
            forces: vec![(0.0, DVec3::ZERO); count],
            work: 0,
        }
    }

    /// Whether friction acts in some contact.
    pub fn have_friction(&self) -> bool {
        self.contacts.iter().any(|contact| contact.friction > 0.0)
    }

    /// Whether no contact of spheres in this motion follows from the others, without friction.
    pub fn are_independent(&mut self, moving: Moving, spheres: &[ContactSphere]) -> bool {
        self.measure(moving);
        self.states.fill(FrictionState::None);
        self.find_directions(None, spheres);
        self.fill_matrix(spheres)
    }

    /// Whether the forces found last hold the contacts. Where friction jams bodies, forces that press would draw them
    /// together: no finite ones hold them, and the slip ends at once.
    ///
    /// Source: Painlevé, C. R. Acad. Sci. 121, 112 (1895); Génot and Brogliato, Eur. J. Mech. A 18, 653 (1999).
    pub fn are_jammed(&self) -> bool {
        !self.matrix.is_definite()
    }

    /// Finds the forces and adds their accelerations \[m/s²\] to those `at` this motion: first those of all centres, then
    /// the angular ones \[rad/s²\].
    pub fn add(&mut self, moving: Moving, spheres: &[ContactSphere], at: &mut Values) {
        self.measure(moving);
        self.find_directions(Some(moving), spheres);
        self.fill_matrix(spheres);
        self.forces.fill((0.0, DVec3::ZERO));
        // The second time removes what rounding left of the first: what rests does not drift.
        for _ in 0..2 {
            self.remove_accelerations(moving, spheres, at);
        }
        self.add_turning_sizes(spheres, &mut at.sizes);
    }

    /// Makes the size of an angular acceleration at least that of the centre's acceleration by the radius: friction follows
    /// from what acts on the centres, and rounding of that is no rate of change.
    fn add_turning_sizes(&self, spheres: &[ContactSphere], sizes: &mut [f64]) {
        let rough = self.contacts.iter().filter(|contact| contact.friction > 0.0);
        for (place, _) in rough.flat_map(CurveContact::ends) {
            let least = sizes[place] / spheres[place].radius;
            let size = &mut sizes[spheres.len() + place];
            *size = size.max(least);
        }
    }

    /// Adds the accelerations \[m/s²\] of the forces under which no gap opens or closes, and nothing that rolls slides.
    fn remove_accelerations(&mut self, moving: Moving, spheres: &[ContactSphere], at: &mut Values) {
        let mut parts = std::mem::take(&mut self.parts);
        parts.clear();
        let held =
            |it: &ForceDirection| -self.acceleration_along(it, moving, spheres, &at.accelerations);
        parts.extend(self.directions.iter().map(held));
        self.matrix.solve(&mut parts);
        for (it, &part) in self.directions.iter().zip(&parts) {
            let (normal, force) = (it.normal, part * it.force);
            let (of_normal, friction) = &mut self.forces[it.contact];
            let along_normal = force.dot(normal);
            *of_normal += along_normal;
            *friction += force - along_normal * normal;
            let has_torque = self.states[it.contact] != FrictionState::None;
            let contact = &self.contacts[it.contact];
            contact.push((normal, force), has_torque, spheres, &mut at.accelerations);
            contact.add_sizes(force.norm(), has_torque, spheres, &mut at.sizes);
        }
        self.parts = parts;
    }

    /// The acceleration along a direction that the contacts hold \[m/s²\].
    fn acceleration_along(
        &self,
        direction: &ForceDirection,
        moving: Moving,
        spheres: &[ContactSphere],
        accelerations: &[DVec3],
    ) -> f64 {
        let number = direction.contact;
        match direction.is_along {
            true => direction.held.dot(self.sliding(number, moving, spheres, accelerations)),
            false => self.opening(number, moving, accelerations),
        }
    }

    /// The acceleration of the gap of a contact \[m/s²\].
    pub fn opening(&self, number: usize, moving: Moving, accelerations: &[DVec3]) -> f64 {
        let (contact, normal) = (&self.contacts[number], self.normals[number]);
        let relative = contact.difference(accelerations) - self.carried[number].acceleration;
        let across = self.across(number, moving);
        relative.dot(normal) + self.curvatures[number].acceleration(across)
    }

    /// The acceleration of the slip of a contact, where there is none \[m/s²\], besides its part along the normal.
    pub fn sliding(
        &self,
        number: usize,
        moving: Moving,
        spheres: &[ContactSphere],
        accelerations: &[DVec3],
    ) -> DVec3 {
        let (contact, normal) = (&self.contacts[number], self.normals[number]);
        let Carried { acceleration, spin_change, belt, .. } = self.carried[number];
        let relative = contact.difference(accelerations) - acceleration;
        let angular = contact.surface_turning(spheres, &accelerations[spheres.len()..]);
        let turning = (angular - spheres[contact.second].radius * spin_change).cross(normal);
        let rate = self.curvatures[number].rate(self.across(number, moving));
        relative - turning - self.spin(number, moving, spheres).cross(rate)
            + belt.dot(normal) * rate
    }

    /// The relative velocity in a contact across its normal \[m/s\].
    pub fn across(&self, number: usize, moving: Moving) -> DVec3 {
        let (contact, normal) = (&self.contacts[number], self.normals[number]);
        let velocity = contact.difference(moving.velocities) - self.carried[number].velocity;
        velocity - velocity.dot(normal) * normal
    }

    /// The sum of radius times angular velocity, as seen from a surface that turns \[m/s\].
    pub fn spin(&self, number: usize, moving: Moving, spheres: &[ContactSphere]) -> DVec3 {
        let contact = &self.contacts[number];
        let spin = contact.surface_turning(spheres, moving.angular_velocities);
        spin - spheres[contact.second].radius * self.carried[number].spin
    }

    /// The velocity with which body 2 of a contact slides along body 1 \[m/s\].
    pub fn slip(&self, number: usize, moving: Moving, spheres: &[ContactSphere]) -> DVec3 {
        let (normal, belt) = (self.normals[number], self.carried[number].belt);
        let beside = self.across(number, moving) - (belt - belt.dot(normal) * normal);
        beside - self.spin(number, moving, spheres).cross(normal)
    }

    /// Power of the moving surface of a contact on its sphere, with the forces found last \[W\].
    pub fn power_of_surface(&self, number: usize, spheres: &[ContactSphere]) -> f64 {
        let Carried { velocity, spin, belt, .. } = self.carried[number];
        let (normal, (normal_force, friction)) = (self.normals[number], self.forces[number]);
        let arm = spheres[self.contacts[number].second].radius * normal;
        let at_point = velocity - spin.cross(arm);
        normal_force * normal.dot(velocity) + friction.dot(at_point + belt)
    }

    /// Finds the normals, and what surfaces that move add.
    pub fn measure(&mut self, moving: Moving) {
        for (number, contact) in self.contacts.iter().enumerate() {
            (self.normals[number], self.curvatures[number], self.carried[number]) =
                contact.measure(moving);
        }
    }

    /// Fills in and factorizes the matrix. Returns whether all forces are independent.
    fn fill_matrix(&mut self, spheres: &[ContactSphere]) -> bool {
        let Self { contacts, linked, directions, first_directions, matrix, work, .. } = self;
        matrix.begin(directions.len());
        *work += (directions.len() as u64).pow(3) / CUBE_PER_UNIT;
        for (row, held) in directions.iter().enumerate() {
            let one = &contacts[held.contact];
            for &other in &linked[held.contact] {
                let columns = first_directions[other]..first_directions[other + 1];
                for (column, force) in columns.clone().zip(&directions[columns]) {
                    let value = coupling((one, held), (&contacts[other], force), spheres);
                    matrix.set(row, column, value);
                }
            }
        }
        matrix.factorize()
    }

    /// Finds the directions of the forces, by the states of friction.
    fn find_directions(&mut self, moving: Option<Moving>, spheres: &[ContactSphere]) {
        let mut directions = std::mem::take(&mut self.directions);
        directions.clear();
        self.first_directions.clear();
        for (contact, &normal) in self.normals.iter().enumerate() {
            self.first_directions.push(directions.len());
            let friction = self.contacts[contact].friction;
            let of_normal =
                ForceDirection { contact, normal, force: normal, held: normal, is_along: false };
            match (self.states[contact], moving) {
                (FrictionState::Slides { direction, least, .. }, Some(moving)) => {
                    let slip = self.slip(contact, moving, spheres);
                    let along = direction - direction.dot(normal) * normal;
                    let against = friction * continued(along / along.norm(), slip, least);
                    directions.push(ForceDirection { force: normal - against, ..of_normal });
                }
                (FrictionState::Rolls, Some(_)) => {
                    directions.push(of_normal);
                    let along =
                        |held| ForceDirection { force: held, held, is_along: true, ..of_normal };
                    directions.extend(tangents(normal).map(along));
                }
                _ => directions.push(of_normal),
            }
        }
        self.first_directions.push(directions.len());
        self.directions = directions;
    }
}

/// The acceleration along the held direction of one contact for a unit of another one's force \[1/kg\].
fn coupling(
    (one, held): (&CurveContact, &ForceDirection),
    (other, force): (&CurveContact, &ForceDirection),
    spheres: &[ContactSphere],
) -> f64 {
    let mut sum = 0.0;
    for (place, sign) in one.ends() {
        for (_, other_sign) in other.ends().filter(|it| it.0 == place) {
            let ContactSphere { mass, inertia_factor, .. } = spheres[place];
            sum += sign * other_sign * held.held.dot(force.force) / mass;
            if held.is_along {
                let turning = force.normal.cross(force.force).cross(held.normal);
                sum += held.held.dot(turning) / (inertia_factor * mass);
            }
        }
    }
    sum
}

/// The direction of a slip \[m/s\] that would be along `direction` if it were that of the start, which turns with the
/// surface. It goes on smoothly through a slip of zero, and below the `least` slip it is that direction.
fn continued(direction: DVec3, slip: DVec3, least: f64) -> DVec3 {
    let speed = slip.norm();
    if speed <= least {
        return direction;
    }
    let sign = if slip.dot(direction) < 0.0 { -1.0 } else { 1.0 };
    slip * (sign / speed)
}
