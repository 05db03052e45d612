//! The equations of a block: no contact closes more than it may, none pulls, and friction obeys Coulomb's law.
//!
//! With the impulses λ of all contacts, along normals n and two directions across each, the velocities at the contacts
//! are `u = u₀ + G λ`. Each contact is open (λ = 0), sticks (uₙ = -b and no slip) or slides (uₙ = -b, and a tangential
//! impulse μ λₙ against the slip). With that known the equations are linear. Which it is follows from the impulses
//! that each contact would get next by itself, as long as that changes: Newton's method for the projections onto
//! Coulomb's cones (Alart and Curnier, Comput. Methods Appl. Mech. Eng. 92, 353 (1991)), with the direction of slip
//! from the step before.

use glam::DVec3;

use crate::contact_matrix::ContactMatrix;
use crate::contact_tangents::tangents;
use crate::rule::contact::contacts::coulomb::limited;
use crate::rule::contact::contacts::swept::FREE;

/// Number of steps, at most.
const MOST_STEPS: usize = 20;
/// Where the steps do not lead to the tolerance, impulses with errors up to this multiple of it are taken; others stay as
/// they were, since they might add energy.
const ACCEPTED: f64 = 1e6;
/// Errors of velocities of this part of the largest are rounding.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A sphere of a block.
#[derive(Debug, Clone, Copy)]
pub struct BlockSphere {
    /// 1/m \[1/kg\], 0 for one that sleeps.
    pub inverse_mass: f64,
    /// 1/(k m) \[1/kg\], with the inertia k m r².
    pub inverse_inertia: f64,
    pub velocity: DVec3,
    /// Velocity of its surface by spin, r w \[m/s\].
    pub spin: DVec3,
}

/// A contact of a block.
#[derive(Debug, Clone, Copy)]
pub struct BlockContact {
    /// Places of bodies 1 and 2; none for a surface.
    spheres: [Option<usize>; 2],
    /// The normal from body 1 to body 2, and two directions across it.
    axes: [DVec3; 3],
    /// Minus the least normal velocity \[m/s\].
    bias: f64,
    /// Velocity of the surface \[m/s\]; 0 for a pair.
    surface_velocity: DVec3,
    /// Slip at which friction ends \[m/s\].
    slip: DVec3,
    friction: f64,
    /// Impulses on body 2, along the axes \[N s\].
    impulses: [f64; 3],
}

/// What a contact does in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
enum State {
    Open,
    Sticks,
    /// The contact slides with a tangential impulse in this direction, along the second and third
    /// axis.
    Slides([f64; 2]),
}

impl BlockContact {
    /// Creates the contact of two bodies, with zero impulses.
    pub fn new(spheres: [Option<usize>; 2], normal: DVec3) -> Self {
        let [first, second] = tangents(normal);
        Self {
            spheres,
            axes: [normal, first, second],
            bias: 0.0,
            surface_velocity: DVec3::ZERO,
            slip: DVec3::ZERO,
            friction: 0.0,
            impulses: [0.0; 3],
        }
    }

    /// Sets minus the least normal velocity, the velocity of the surface, and the slip at which friction ends.
    pub fn with_bound(self, bias: f64, surface_velocity: DVec3, slip: DVec3) -> Self {
        Self { bias, surface_velocity, slip, ..self }
    }

    /// Sets the coefficient of friction.
    pub fn with_friction(self, friction: f64) -> Self {
        Self { friction, ..self }
    }

    /// Sets the impulses at hand.
    pub fn with_impulses(self, normal: f64, tangential: [f64; 3]) -> Self {
        let tangential = DVec3::from_array(tangential);
        let impulses = [normal, tangential.dot(self.axes[1]), tangential.dot(self.axes[2])];
        Self { impulses, ..self }
    }

    /// Whether the bodies separate faster than they are let go.
    pub fn bounces(&self) -> bool {
        self.bias < 0.0
    }

    /// The normal impulse \[N s\].
    pub fn normal_impulse(&self) -> f64 {
        self.impulses[0]
    }

    /// The impulse of friction on body 2 \[N s\].
    pub fn tangential(&self) -> DVec3 {
        self.impulses[1] * self.axes[1] + self.impulses[2] * self.axes[2]
    }

    /// Returns what a unit of an impulse changes: the velocity of body 2 along the first vector,
    /// less that of body 1, and the spins of both along the second one.
    fn directions(&self, axis: usize) -> [DVec3; 2] {
        let along = self.axes[axis];
        let turn = if axis == 0 { DVec3::ZERO } else { -self.axes[0].cross(along) };
        [along, turn]
    }

    /// Whether a sphere takes part in both contacts.
    fn shares_sphere_with(&self, other: &Self) -> bool {
        self.spheres.iter().flatten().any(|sphere| other.spheres.contains(&Some(*sphere)))
    }

    /// Returns what a unit of an impulse of another contact adds to the velocity along an axis
    /// \[1/kg\].
    fn coupling(&self, axis: usize, other: &Self, of_other: usize, spheres: &[BlockSphere]) -> f64 {
        let [along, turn] = self.directions(axis);
        let [other_along, other_turn] = other.directions(of_other);
        let (straight, turning) = (along.dot(other_along), turn.dot(other_turn));
        let mut sum = 0.0;
        for (body, own) in self.spheres.iter().enumerate() {
            for (other_body, others) in other.spheres.iter().enumerate() {
                let Some(place) = own.filter(|_| own == others) else { continue };
                let sign = if body == other_body { 1.0 } else { -1.0 };
                let sphere = &spheres[place];
                sum += sign * sphere.inverse_mass * straight + sphere.inverse_inertia * turning;
            }
        }
        sum
    }

    /// Returns how far the velocities at the contact are above its bound and the slip at which
    /// friction ends \[m/s\].
    fn excess(&self, spheres: &[BlockSphere]) -> [f64; 3] {
        let mut velocity = -self.surface_velocity;
        let mut spin = DVec3::ZERO;
        for (place, sign) in self.spheres.into_iter().zip([-1.0, 1.0]) {
            if let Some(place) = place {
                velocity += sign * spheres[place].velocity;
                spin += spheres[place].spin;
            }
        }
        let slip = velocity - spin.cross(self.axes[0]) - self.slip;
        [velocity.dot(self.axes[0]) + self.bias, slip.dot(self.axes[1]), slip.dot(self.axes[2])]
    }

    /// Adds impulses to both bodies.
    fn push(&self, spheres: &mut [BlockSphere], change: [f64; 3]) {
        for (axis, change) in change.into_iter().enumerate() {
            let [along, turn] = self.directions(axis);
            for (place, sign) in self.spheres.into_iter().zip([-1.0, 1.0]) {
                let Some(place) = place else { continue };
                let sphere = &mut spheres[place];
                sphere.velocity += sign * sphere.inverse_mass * change * along;
                sphere.spin += sphere.inverse_inertia * change * turn;
            }
        }
    }

    /// What the contact does next, by the impulses that it would get by itself, and by how much its velocities miss that
    /// \[m/s\]. `excess` is that of [`Self::excess`], `mobility` what a unit of a normal and of a tangential impulse adds
    /// to the velocity \[1/kg\].
    fn next(&self, excess: [f64; 3], mobility: [f64; 2]) -> (State, f64) {
        let [normal, across @ ..] = self.impulses;
        let own = (normal - excess[0] / mobility[0]).max(0.0);
        let missed = mobility[0] * (own - normal).abs();
        if own == 0.0 {
            return (
                State::Open,
                missed.max(mobility[1] * (across[0] * across[0] + across[1] * across[1]).sqrt()),
            );
        }
        let wanted = DVec3::new(
            across[0] - excess[1] / mobility[1],
            across[1] - excess[2] / mobility[1],
            0.0,
        );
        let most = self.friction * normal.max(0.0);
        let allowed = limited(wanted, most);
        let change = (allowed - DVec3::new(across[0], across[1], 0.0)).length();
        let missed = missed.max(mobility[1] * change);
        if wanted.length() <= most {
            return (State::Sticks, missed);
        }
        let direction = wanted / wanted.length();
        (State::Slides([direction.x, direction.y]), missed)
    }
}

/// Solves for the impulses of all contacts, from those at hand. Returns whether they changed: velocities were off by
/// more than a tolerance \[m/s\] and than rounding, and the equations are solved now.
pub fn solve(contacts: &mut [BlockContact], spheres: &mut [BlockSphere], tolerance: f64) -> bool {
    let mobilities: Vec<[f64; 2]> =
        contacts.iter().map(|it| [0, 1].map(|axis| it.coupling(axis, it, axis, spheres))).collect();
    let (mut states, mut error) = next_states(contacts, spheres, &mobilities);
    let speeds = spheres.iter().map(|it| it.velocity.length().max(it.spin.length()));
    let tolerance = tolerance.max(ROUNDING * speeds.fold(0.0, f64::max));
    if error <= tolerance {
        return false;
    }
    let before = (contacts.to_vec(), spheres.to_vec());
    let mut best = None;
    let couplings = couplings(contacts, spheres);
    let known = free_excess(contacts, spheres);
    let mut matrix = ContactMatrix::default();
    for _ in 0..MOST_STEPS {
        let impulses = impulses_of(contacts, &states, (&couplings, &known), &mut matrix);
        apply(contacts, spheres, &impulses);
        let (next, missed) = next_states(contacts, spheres, &mobilities);
        if missed < error {
            error = missed;
            best = Some((contacts.to_vec(), spheres.to_vec()));
        }
        if error <= tolerance {
            break;
        }
        states = next;
    }
    let solved = best.filter(|_| error <= ACCEPTED * tolerance);
    let (of_contacts, of_spheres) = solved.as_ref().unwrap_or(&before);
    contacts.copy_from_slice(of_contacts);
    spheres.copy_from_slice(of_spheres);
    solved.is_some()
}

/// Returns the next state of each contact, and the largest distance of velocities from it \[m/s\].
fn next_states(
    contacts: &[BlockContact],
    spheres: &[BlockSphere],
    mobilities: &[[f64; 2]],
) -> (Vec<State>, f64) {
    let mut largest = 0.0_f64;
    let both = contacts.iter().zip(mobilities);
    let states = both.map(|(contact, &mobility)| {
        if contact.bias >= FREE {
            return State::Open;
        }
        let (state, missed) = contact.next(contact.excess(spheres), mobility);
        largest = largest.max(missed);
        state
    });
    let states = states.collect();
    (states, largest)
}

/// Returns what a unit of each impulse adds to each velocity \[1/kg\], row by row.
fn couplings(contacts: &[BlockContact], spheres: &[BlockSphere]) -> Vec<f64> {
    let mut values = Vec::with_capacity(9 * contacts.len() * contacts.len());
    for contact in contacts {
        for axis in 0..3 {
            for other in contacts {
                let coupled = |it| contact.coupling(axis, other, it, spheres);
                let is_coupled = contact.shares_sphere_with(other);
                values.extend((0..3).map(|it| if is_coupled { coupled(it) } else { 0.0 }));
            }
        }
    }
    values
}

/// Returns how far the velocities at each contact would be above its bounds without the present
/// impulses \[m/s\].
fn free_excess(contacts: &[BlockContact], spheres: &[BlockSphere]) -> Vec<f64> {
    let mut free = spheres.to_vec();
    for contact in contacts {
        contact.push(&mut free, contact.impulses.map(|it| -it));
    }
    contacts.iter().flat_map(|contact| contact.excess(&free)).collect()
}

/// The impulses with which each contact does what its state says \[N s\].
fn impulses_of(
    contacts: &[BlockContact],
    states: &[State],
    (couplings, known): (&[f64], &[f64]),
    matrix: &mut ContactMatrix,
) -> Vec<f64> {
    let count = 3 * contacts.len();
    let mut impulses = vec![0.0; count];
    matrix.begin(count);
    for (number, (contact, state)) in contacts.iter().zip(states).enumerate() {
        for axis in 0..3 {
            let row = 3 * number + axis;
            let slides = match state {
                State::Slides(direction) if axis > 0 => Some(direction[axis - 1]),
                _ => None,
            };
            let holds = *state != State::Open && slides.is_none();
            if holds {
                let values = &couplings[row * count..(row + 1) * count];
                values.iter().enumerate().for_each(|(column, &it)| matrix.set(row, column, it));
                impulses[row] = -known[row];
            } else {
                matrix.set(row, row, 1.0);
            }
            if let Some(direction) = slides {
                matrix.set(row, 3 * number, -contact.friction * direction);
            }
        }
    }
    matrix.factorize();
    matrix.solve(&mut impulses);
    impulses
}

/// Replaces the impulses of all contacts.
fn apply(contacts: &mut [BlockContact], spheres: &mut [BlockSphere], impulses: &[f64]) {
    for (contact, impulses) in contacts.iter_mut().zip(impulses.chunks_exact(3)) {
        let [normal, first, second] = contact.impulses;
        let change = [impulses[0] - normal, impulses[1] - first, impulses[2] - second];
        contact.push(spheres, change);
        contact.impulses = [impulses[0], impulses[1], impulses[2]];
    }
}
