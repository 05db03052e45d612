//! Links: the contacts of an island.

use glam::DVec3;

use super::body::Body;
use crate::detect::sphere_surface;
use crate::friction::ContactFriction;
use crate::restitution::ContactRestitution;
use crate::rule::contact::contacts::batch::{Impulses, get};
use crate::rule::contact::contacts::coulomb::{limited, slip};
use crate::rule::contact::places::Places;
use crate::rule::contact::slabs::incidence::Origin;
use crate::rule::contact::slots::Slots;
use crate::rule::contact::solver::Solver;
use crate::rule::contact::sub_step::SubStep;

/// The role of a link in a flight or an impact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Nothing.
    Off,
    /// The link keeps its bodies apart.
    Bears,
    /// The bodies of the link may meet; it acts from then on.
    Awaited,
}

/// A contact of a sphere, which is body 2, with another one or a surface, which is body 1.
#[derive(Debug, Clone, Copy)]
pub struct Link {
    pub origin: Origin,
    /// The slots of the spheres; twice the same with a surface.
    pub slots: [u32; 2],
    /// The place of body 1 in the island, if it is a sphere.
    pub first: Option<usize>,
    pub second: usize,
    pub surface: u32,
    /// Offset from body 2 to its image that body 1 touches \[m\].
    pub shift: DVec3,
    /// Velocity of that image relative to body 2 \[m/s\].
    pub slide: DVec3,
    radius_sum: f64,
    restitution: ContactRestitution,
    friction: ContactFriction,
    /// Impulse before the sub-step \[N s\].
    carried: f64,
    /// Whether the link pressed in the sub-step, or in the flight before.
    pub bears: bool,
    /// Whether its surface moves, kicks or is a belt, which no cascade follows.
    pub is_driven: bool,
    pub role: Role,
    pub normal: DVec3,
    pub point: DVec3,
    pub gap: f64,
    /// Minus the least normal velocity \[m/s\].
    pub bias: f64,
    /// Slip after an impact \[m/s\].
    slip: DVec3,
    /// When its bodies meet in the flight \[s\].
    pub time: f64,
    /// Speed of approach of an impact \[m/s\]; 0 without one.
    pub approach: f64,
    pub impulses: Impulses,
    /// How long the last flight took \[s\].
    pub last: f64,
}

impl Link {
    /// Creates the link of a contact of the solver, without its bodies.
    pub fn of(solver: &Solver, origin: Origin) -> Self {
        let none = Self::unknown(origin);
        match origin {
            Origin::Pair { slab, batch, lane } => {
                let slab = Origin::slab(&solver.slabs, slab);
                let (batch, lane) = (batch as usize, lane as usize);
                let batches = &slab.batches;
                let (rough, rolling) = (batches.frictions.get(batch), batches.rollings.get(batch));
                let carried = batches.approaches[batch].previous[lane];
                Self {
                    slots: slab.slots_of(batch, lane).map(|slot| slot as u32),
                    shift: batches.shift(batch, lane),
                    slide: DVec3::new(batches.slide(batch, lane), 0.0, 0.0),
                    radius_sum: batches.approaches[batch].radius_sum[lane],
                    restitution: batches.restitution(batch, lane),
                    friction: ContactFriction {
                        sliding: rough.map_or(0.0, |it| it.sliding[lane]),
                        rolling: rolling.map_or(0.0, |it| it.rolling[lane]),
                        spinning: rolling.map_or(0.0, |it| it.spinning[lane]),
                        tangential_restitution: rough
                            .map_or(0.0, |it| it.tangential_restitution[lane]),
                        cushion: 0.0,
                    },
                    carried,
                    bears: carried > 0.0 || batches.pairs[batch].impulse[lane] > 0.0,
                    normal: DVec3::from_array(get(&batches.pairs[batch].normal, lane)),
                    ..none
                }
            }
            Origin::Surface { slab, contact } => {
                let slab = Origin::slab(&solver.slabs, slab);
                let contact = &slab.surfaces[contact as usize];
                let slot = slab.start + contact.slot as usize;
                let radius = solver.slots.position[slot].number();
                let ContactFriction { rolling, spinning, .. } = contact.friction;
                let (rolling, spinning) = (radius * rolling, radius * spinning);
                let carried = contact.impulses.previous;
                Self {
                    slots: [slot as u32; 2],
                    surface: contact.surface,
                    radius_sum: radius,
                    restitution: contact.material_restitution(),
                    friction: ContactFriction { rolling, spinning, ..contact.friction },
                    carried,
                    bears: carried > 0.0,
                    is_driven: contact.kick > 0.0
                        || contact.belt != DVec3::ZERO
                        || !solver.places.at_start(contact.surface).1.is_at_rest(),
                    ..none
                }
            }
        }
    }

    /// A link of which only the origin is known.
    fn unknown(origin: Origin) -> Self {
        Self {
            origin,
            slots: [0; 2],
            first: None,
            second: 0,
            surface: 0,
            shift: DVec3::ZERO,
            slide: DVec3::ZERO,
            radius_sum: 0.0,
            restitution: ContactRestitution::default(),
            friction: ContactFriction::default(),
            carried: 0.0,
            bears: false,
            is_driven: false,
            role: Role::Off,
            normal: DVec3::Y,
            point: DVec3::ZERO,
            gap: 0.0,
            bias: 0.0,
            slip: DVec3::ZERO,
            time: f64::INFINITY,
            approach: 0.0,
            impulses: Impulses::default(),
            last: 0.0,
        }
    }

    /// This link of bodies at other places.
    pub fn between(self, first: Option<usize>, second: usize) -> Self {
        Self { first, second, ..self }
    }

    /// The gap of two spheres at the start of the sub-step \[m\].
    pub fn gap_between(&self, slots: &Slots) -> f64 {
        let [first, second] = self.slots.map(|slot| slots.position[slot as usize].vector());
        (second - first + self.shift).length() - self.radius_sum
    }

    /// Whether the link pressed before the sub-step.
    pub fn pressed(&self) -> bool {
        self.carried > 0.0
    }

    /// Measures normal and gap. Returns whether there are any.
    pub fn measure(&mut self, bodies: &[Body], places: &Places) -> bool {
        let second = &bodies[self.second];
        let Some(first) = self.first else {
            let (form, _) = places.at_start(self.surface);
            let separation = sphere_surface(form, second.position, second.radius);
            if let Some(it) = separation {
                (self.normal, self.gap, self.point) = (it.normal, it.distance, it.point);
            }
            return separation.is_some();
        };
        let first = &bodies[first];
        let offset = second.position - first.position + self.shift_at(second.elapsed);
        let length = offset.length();
        if length > 0.0 {
            self.normal = offset / length;
        }
        self.gap = length - self.radius_sum;
        let part = self.radius_sum / (first.radius + second.radius);
        self.point = first.position + part * first.radius * self.normal;
        true
    }

    /// Offset from body 2 to its image that body 1 touches, after a time of the sub-step \[s\] \[m\].
    pub fn shift_at(&self, elapsed: f64) -> DVec3 {
        self.shift + elapsed * self.slide
    }

    /// The impulse on body 2, normal and tangential \[N s\].
    pub fn impulse(&self) -> DVec3 {
        self.impulses.normal * self.normal + DVec3::from_array(self.impulses.tangential)
    }

    /// Work of the impulses on the image beyond that on body 2 \[J\].
    pub fn image_work(&self) -> f64 {
        self.slide.dot(self.impulse())
    }

    /// The relative vector of body 2 to body 1, where `of` returns that of one body.
    fn relative(&self, bodies: &[Body], of: impl Fn(&Body) -> DVec3) -> DVec3 {
        of(&bodies[self.second]) - self.first.map_or(DVec3::ZERO, |first| of(&bodies[first]))
    }

    /// The speed of approach along the normal \[m/s\].
    pub fn closing(&self, bodies: &[Body]) -> f64 {
        -self.velocity(bodies).dot(self.normal)
    }

    /// The relative velocity \[m/s\].
    pub fn velocity(&self, bodies: &[Body]) -> DVec3 {
        self.relative(bodies, |body| body.velocity) + self.slide
    }

    /// Acceleration of approach along the normal by forces \[m/s²\].
    pub fn pressing(&self, bodies: &[Body]) -> f64 {
        -self.relative(bodies, Body::free_acceleration).dot(self.normal)
    }

    /// The length beside which paths count as long \[m\].
    pub fn size(&self) -> f64 {
        self.radius_sum
    }

    /// Speed of approach above which the bodies bounce \[m/s\].
    pub fn threshold(&self, bodies: &[Body], sub_step: &SubStep) -> f64 {
        let second = &bodies[self.second];
        let along = |body: &Body| body.acceleration.dot(self.normal);
        match self.first.map(|first| &bodies[first]) {
            None => {
                let pressing = (-along(second)).max(0.0);
                if second.bears {
                    sub_step.shaken_speed(pressing)
                } else {
                    sub_step.surface_impact_speed(pressing)
                }
            }
            Some(first) if first.bears || second.bears => {
                let most = along(first).abs().max(along(second).abs());
                sub_step.shaken_speed(most).max(sub_step.impact_speed)
            }
            Some(_) => sub_step.impact_speed,
        }
    }

    /// Begins a flight or an impact in this role, without impulses.
    pub fn set(&mut self, role: Role, bias: f64) {
        (self.role, self.bias) = (role, bias);
        (self.approach, self.slip) = (0.0, DVec3::ZERO);
        self.impulses = Impulses::default();
    }

    /// Makes the link an impact with this speed of approach \[m/s\], which ends with restitution.
    pub fn strike(&mut self, bodies: &[Body], approach: f64) {
        self.set(Role::Bears, -self.restitution.at(approach) * approach);
        self.approach = approach;
        if self.friction.reverses() {
            let slip = self.slip_of(bodies);
            let restitution = self.restitution.at(approach);
            // Only surfaces are compliant, so the masses of a first sphere do not matter.
            let masses = [bodies[self.second].inverse_mass, bodies[self.second].inverse_inertia];
            let change = (1.0 + restitution) * approach;
            self.slip = self.friction.slip_after(slip, (change, restitution), masses);
        }
    }

    fn slip_of(&self, bodies: &[Body]) -> DVec3 {
        let velocity = self.velocity(bodies);
        let spin = bodies[self.second].spin + self.first.map_or(DVec3::ZERO, |it| bodies[it].spin);
        slip(velocity, self.normal, spin)
    }

    /// Applies the impulses that this link needs with the others as they are, if it acts. Returns the largest
    /// change of an impulse \[N s\].
    pub fn solve(&mut self, bodies: &mut [Body]) -> f64 {
        let [mut inverse_mass, mut inverse_inertia] =
            [bodies[self.second].inverse_mass, bodies[self.second].inverse_inertia];
        if let Some(first) = self.first {
            inverse_mass += bodies[first].inverse_mass;
            inverse_inertia += bodies[first].inverse_inertia;
        }
        let Impulses { normal: impulse, tangential, .. } = self.impulses;
        let solved = (impulse - (self.bias - self.closing(bodies)) / inverse_mass).max(0.0);
        if solved == 0.0 && impulse == 0.0 {
            return 0.0;
        }
        self.impulses.normal = solved;
        let change = solved - impulse;
        let mut across = DVec3::ZERO;
        if self.friction.sliding > 0.0 {
            let kept = DVec3::from_array(tangential);
            let excess = self.slip_of(bodies) - self.slip;
            let wanted = kept - excess / (inverse_mass + inverse_inertia);
            let limited = limited(wanted, self.friction.sliding * solved);
            self.impulses.tangential = limited.to_array();
            across = limited - kept;
        }
        self.push(bodies, change * self.normal + across, self.normal.cross(across));
        if self.friction.rolling > 0.0 || self.friction.spinning > 0.0 {
            self.solve_rolling(bodies);
        }
        change.abs().max(across.length())
    }

    fn push(&self, bodies: &mut [Body], impulse: DVec3, turn: DVec3) {
        let second = &mut bodies[self.second];
        second.velocity += second.inverse_mass * impulse;
        second.spin -= second.inverse_inertia * turn;
        if let Some(first) = self.first {
            let first = &mut bodies[first];
            first.velocity -= first.inverse_mass * impulse;
            first.spin -= first.inverse_inertia * turn;
        }
    }

    /// Applies angular impulses against rolling and spinning to both bodies.
    fn solve_rolling(&mut self, bodies: &mut [Body]) {
        let angular_velocity = |body: &Body| body.spin / body.radius;
        let softness = |body: &Body| body.inverse_inertia / (body.radius * body.radius);
        let inverse =
            softness(&bodies[self.second]) + self.first.map_or(0.0, |it| softness(&bodies[it]));
        if inverse == 0.0 {
            return;
        }
        let kept = DVec3::from_array(self.impulses.angular);
        let wanted = kept - self.relative(bodies, angular_velocity) / inverse;
        let along = wanted.dot(self.normal) * self.normal;
        let solved = limited(wanted - along, self.friction.rolling * self.impulses.normal)
            + limited(along, self.friction.spinning * self.impulses.normal);
        self.impulses.angular = solved.to_array();
        let change = solved - kept;
        let turn =
            |body: &mut Body, by: DVec3| body.spin += body.inverse_inertia / body.radius * by;
        turn(&mut bodies[self.second], change);
        if let Some(first) = self.first {
            turn(&mut bodies[first], -change);
        }
    }

    /// The impulses with which the link starts the next sub-step: those of the last flight, as in a whole sub-step.
    pub fn kept(&self, bodies: &[Body], sub_step: &SubStep) -> Impulses {
        if self.role != Role::Bears || self.impulses.normal == 0.0 || self.last <= 0.0 {
            return Impulses::default();
        }
        let masses = [self.first, Some(self.second)].into_iter().flatten();
        let inverse_mass: f64 = masses.map(|it| bodies[it].inverse_mass).sum();
        let most = self.carried.max(sub_step.growth / inverse_mass);
        let part = (sub_step.h / self.last).min(most / self.impulses.normal);
        let of = |vector: [f64; 3]| vector.map(|it| part * it);
        let normal = part * self.impulses.normal;
        Impulses {
            normal,
            previous: normal,
            tangential: of(self.impulses.tangential),
            angular: of(self.impulses.angular),
        }
    }
}
