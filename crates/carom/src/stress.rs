//! The stress of the spheres of a world, over a time.

use std::collections::BTreeSet;

use glam::{DMat3, DVec3};

use crate::collider::{Shape, Sides};
use crate::error::{Error, Subject};
use crate::report::BodyPair;
use crate::settings::Boundary;
use crate::shear::Shear;
use crate::sum::Sum;
use crate::validate;
use crate::world::World;

/// Mean stress in a volume over a time \[Pa\], positive where it presses. In two dimensions it is that in an area \[N/m\].
///
/// Column k of each tensor is the momentum that goes through an area across axis k, for area and time. Source: Irving
/// and Kirkwood, J. Chem. Phys. 18, 817 (1950); for contacts Love, *A Treatise on the Mathematical Theory of
/// Elasticity* (1927), note B; `docs/physics/stress.md` has the formulas.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Stress {
    /// Number of dimensions, 2 or 3.
    pub dimensions: u32,
    /// Stress of motion: Σ m v v / V, mean over the ends of frames. Along periodic axes v is relative to the centre of
    /// mass, and in a box in steady shear to the mean flow.
    pub kinetic: DMat3,
    /// Stress of impacts, and of events at the edges of wells: Σ j l / (V t), with impulses j and the vectors l between the centres of the bodies.
    pub collisional: DMat3,
    /// Stress of persistent contacts: Σ F l / V, with the forces F at the ends of frames; under the rule `contact` in a
    /// box in steady shear their mean over frames.
    pub contact: DMat3,
}

impl Stress {
    /// Sum of all parts \[Pa\].
    pub fn total(&self) -> DMat3 {
        self.kinetic + self.collisional + self.contact
    }

    /// Pressure \[Pa\], or in two dimensions \[N/m\]: the trace divided by the number of dimensions.
    pub fn pressure(&self) -> f64 {
        let total = self.total();
        (total.x_axis.x + total.y_axis.y + total.z_axis.z) / f64::from(self.dimensions)
    }
}

/// Measures the stress of a world over frames.
///
/// ```
/// use carom::{Boundary, DVec3, Settings, Sphere, StressMeter, World};
///
/// let size = DVec3::splat(4.0);
/// let settings = Settings::default().with_boundary(Boundary::Periodic { size });
/// let mut world = World::new(settings)?;
/// world.add_sphere(Sphere::new(DVec3::ZERO, 0.5).with_velocity(DVec3::X))?;
/// world.add_sphere(Sphere::new(DVec3::new(2.0, 0.0, 0.0), 0.5).with_velocity(-DVec3::X))?;
/// let mut meter = StressMeter::new(&world);
/// for _ in 0..4 {
///     world.step(0.5)?;
///     meter.add_frame(&world);
/// }
/// let stress = meter.stress(None)?;
/// // Two masses of 1 kg at 1 m/s in 64 m³; two impacts of 2 N s over 1 m in 2 s.
/// assert_eq!((stress.kinetic.x_axis.x, stress.collisional.x_axis.x), (2.0 / 64.0, 2.0 / 64.0));
/// # Ok::<(), carom::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct StressMeter {
    /// Time of the world at the last measurement \[s\].
    last: f64,
    /// Σ m v v at the last measurement \[J\].
    last_kinetic: DMat3,
    /// Time measured \[s\].
    time: f64,
    /// Integrals over that time \[J s\].
    kinetic: Tensor,
    collisional: Tensor,
    contact: Tensor,
    /// Volume of the box around the spheres \[m³\], where there is one.
    volume: Option<f64>,
    /// Number of dimensions.
    dimensions: u32,
}

impl StressMeter {
    /// Begins to measure at the present state of a world.
    pub fn new(world: &World) -> Self {
        Self {
            last: world.time(),
            last_kinetic: kinetic(world),
            time: 0.0,
            kinetic: Tensor::default(),
            collisional: Tensor::default(),
            contact: Tensor::default(),
            volume: volume_around(world),
            dimensions: world.settings().dimensions,
        }
    }

    /// Adds the last step of the world. Call it after each step.
    pub fn add_frame(&mut self, world: &World) {
        let length = world.time() - self.last;
        let kinetic = kinetic(world);
        self.kinetic.add(0.5 * length * (self.last_kinetic + kinetic));
        add_impacts(world, length, &mut self.collisional);
        add_contacts(world, length, &mut self.contact);
        (self.last, self.last_kinetic) = (world.time(), kinetic);
        self.time += length;
    }

    /// Time measured so far \[s\].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Volume of the periodic box, or of the first closed container \[m³\], or its area in two dimensions \[m²\]; `None`
    /// without such a box.
    pub fn volume(&self) -> Option<f64> {
        self.volume
    }

    /// Returns the mean stress in a volume \[m³\]: by default the periodic box, or the first closed container.
    ///
    /// # Errors
    /// [`Error::Invalid`] if no frame was added, or where the volume is not known.
    pub fn stress(&self, volume: Option<f64>) -> Result<Stress, Error> {
        let volume = volume.or(self.volume).unwrap_or(f64::INFINITY);
        let requirement = "positive and finite; outside of closed boxes it has to be given";
        let is_known = volume > 0.0 && volume.is_finite();
        validate::require(is_known, "volume", requirement, volume)
            .and_then(|()| validate::positive("time", self.time))
            .map_err(|invalid| invalid.about(Subject::Query))?;
        let mean = |integral: &Tensor| integral.value() * (1.0 / (volume * self.time));
        Ok(Stress {
            dimensions: self.dimensions,
            kinetic: mean(&self.kinetic),
            collisional: mean(&self.collisional),
            contact: mean(&self.contact),
        })
    }
}

/// Volume of the periodic box, or of the first closed container \[m³\]; in two dimensions its area \[m²\].
fn volume_around(world: &World) -> Option<f64> {
    let in_space = |size: DVec3| match world.settings().dimensions {
        2 => size.with_z(1.0),
        _ => size,
    };
    if let Boundary::Periodic { size } = world.settings().boundary {
        let size = in_space(size);
        return size.is_finite().then(|| size.element_product());
    }
    world.colliders().find_map(|(_, collider)| match collider.shape {
        Shape::Container { size, open: Sides::NONE } if !collider.trigger => {
            Some(in_space(size).element_product())
        }
        _ => None,
    })
}

/// Exact sums of the parts of tensors.
#[derive(Debug, Clone, Default)]
struct Tensor([Sum; 9]);

impl Tensor {
    fn add(&mut self, part: DMat3) {
        for (sum, value) in self.0.iter_mut().zip(part.to_cols_array()) {
            sum.add(value);
        }
    }

    fn value(&self) -> DMat3 {
        DMat3::from_cols_array(&std::array::from_fn(|part| self.0[part].value()))
    }
}

/// Tensor a b, whose column k is a times part k of b.
fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(b.x * a, b.y * a, b.z * a)
}

/// Σ m v v \[J\], with velocities that along periodic axes are relative to the centre of mass.
fn kinetic(world: &World) -> DMat3 {
    let spheres = world.spheres();
    let shear = Shear::of(world.settings());
    let flow = |place: DVec3| shear.map_or(DVec3::ZERO, |shear| shear.velocity_at(place));
    let own: Vec<DVec3> =
        spheres.velocities().iter().zip(spheres.positions()).map(|(v, &x)| *v - flow(x)).collect();
    let total: f64 = spheres.masses().iter().copied().collect::<Sum>().value();
    let is_periodic = world.settings().boundary.period().is_finite_mask();
    let mut momentum = [Sum::default(); 3];
    for (&mass, &velocity) in spheres.masses().iter().zip(&own) {
        let parts = (mass * velocity).to_array();
        momentum.iter_mut().zip(parts).for_each(|(sum, part)| sum.add(part));
    }
    let momentum = DVec3::from_array(momentum.map(|sum| sum.value()));
    let drift = if total > 0.0 { momentum / total } else { DVec3::ZERO };
    let drift = DVec3::select(is_periodic, drift, DVec3::ZERO);
    let mut tensor = Tensor::default();
    for (&mass, &velocity) in spheres.masses().iter().zip(&own) {
        tensor.add(outer(mass * (velocity - drift), velocity - drift));
    }
    tensor.value()
}

/// Distance from the centre of body 1 to that of body 2 \[m\], or to the surface of a collider, at a time before the
/// end of the frame \[s\].
fn reach(world: &World, between: &BodyPair, before_end: f64) -> f64 {
    let spheres = world.spheres();
    let radius = |id| {
        // A sphere that an emitter took out since has left no radius.
        let Some(index) = spheres.index_of(id) else { return 0.0 };
        let speed = spheres.growth_speeds().get(index).copied().unwrap_or(0.0);
        spheres.radii()[index] - speed * before_end
    };
    match *between {
        BodyPair::Spheres(first, second) => {
            world.distance_factor([first, second]) * (radius(first) + radius(second))
        }
        BodyPair::Collider { sphere, .. } => radius(sphere),
    }
}

/// Adds the impacts of a frame of a length \[s\].
fn add_impacts(world: &World, length: f64, sum: &mut Tensor) {
    for impact in &world.report().impacts {
        let way = reach(world, &impact.between, length - impact.time) * impact.normal;
        sum.add(outer(impact.impulse * impact.normal + impact.tangential_impulse, way));
    }
    for event in &world.report().well_events {
        sum.add(outer(event.impulse * event.normal, event.distance * event.normal));
    }
}

/// Adds the persistent contacts at the end of a frame of a length \[s\]. Those of bodies with an impact in it count from
/// the next one on.
fn add_contacts(world: &World, length: f64, sum: &mut Tensor) {
    if let Some(virial) = world.report().virial {
        let mut of_impacts = Tensor::default();
        add_impacts(world, length, &mut of_impacts);
        return sum.add(virial - of_impacts.value());
    }
    let contacts = world.contacts();
    if contacts.is_empty() {
        return;
    }
    let met: BTreeSet<BodyPair> = world.report().impacts.iter().map(|it| it.between).collect();
    for contact in contacts.iter().filter(|contact| !met.contains(&contact.between)) {
        let way = reach(world, &contact.between, 0.0) * contact.normal;
        let force = contact.normal_force * contact.normal + contact.tangential_force;
        sum.add(outer(length * force, way));
    }
}
