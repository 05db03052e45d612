//! Frames of particle files.

use carom::{Boundary, DVec3, SOLID_BALL, World};

use super::columns::Columns;
use super::error::Problem;
use crate::recording::{rotation, slide::slide};

/// State of all particles at one time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ParticleFrame {
    /// Time \[s\], if the file has it.
    pub time: Option<f64>,
    /// Sides of the periodic box around the origin \[m\], infinite along open axes.
    pub sides: [f64; 3],
    /// Way along x by which the box above, along y, is beside this one \[m\], in steady shear.
    pub slide: Option<f64>,
    /// Numbers of the particles, ascending.
    pub ids: Vec<u64>,
    /// Centres \[m\].
    pub positions: Vec<[f64; 3]>,
    /// Velocities \[m/s\].
    pub velocities: Option<Vec<[f64; 3]>>,
    /// Radii \[m\].
    pub radii: Option<Vec<f64>>,
    /// Masses \[kg\].
    pub masses: Option<Vec<f64>>,
    /// Moments of inertia \[kg m²\], which only GSD files hold.
    pub inertias: Option<Vec<f64>>,
    /// Quaternions x, y, z, w.
    pub orientations: Option<Vec<[f64; 4]>>,
    /// Angular velocities along the axes \[rad/s\].
    pub angular_velocities: Option<Vec<[f64; 3]>>,
}

impl ParticleFrame {
    /// Returns the state of a world, with rotations or without.
    pub fn of(world: &World, has_rotation: bool) -> Self {
        let spheres = world.spheres();
        let all = 0..spheres.len();
        let vectors = |values: &[DVec3]| values.iter().map(DVec3::to_array).collect();
        let (radii, masses) = (spheres.radii().to_vec(), spheres.masses().to_vec());
        let factors = spheres.inertia_factors();
        let inertia = |index: usize| {
            let factor = factors.get(index).copied().unwrap_or(SOLID_BALL);
            factor * masses[index] * radii[index] * radii[index]
        };
        let rotations = has_rotation.then(|| all.clone());
        Self {
            time: Some(world.time()),
            sides: match world.settings().boundary {
                Boundary::Periodic { size } => size.to_array(),
                _ => [f64::INFINITY; 3],
            },
            slide: slide(world.settings(), world.time()),
            ids: spheres.ids().iter().map(|id| id.number()).collect(),
            positions: vectors(spheres.positions()),
            velocities: Some(vectors(spheres.velocities())),
            inertias: rotations.clone().map(|all| all.map(inertia).collect()),
            orientations: rotations
                .clone()
                .map(|all| all.map(|index| rotation::orientation(world, index)).collect()),
            angular_velocities: rotations
                .map(|all| all.map(|index| rotation::angular_velocity(world, index)).collect()),
            radii: Some(radii),
            masses: Some(masses),
        }
    }
}

/// The box of a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FrameBox {
    /// Lowest corner \[m\].
    pub low: DVec3,
    /// Highest corner \[m\].
    pub high: DVec3,
    /// Whether space repeats itself along each axis.
    pub is_periodic: [bool; 3],
    /// Way along x by which the box above, along y, is beside this one \[m\].
    pub slide: f64,
}

impl FrameBox {
    /// Returns the box of a frame: the periodic box, and along open axes what all spheres fill.
    pub fn of(frame: &ParticleFrame) -> Self {
        let radius = |index: usize| frame.radii.as_ref().map_or(0.0, |radii| radii[index]);
        let centers = || frame.positions.iter().copied().map(DVec3::from_array).enumerate();
        let low = centers().map(|(index, center)| center - radius(index)).reduce(DVec3::min);
        let high = centers().map(|(index, center)| center + radius(index)).reduce(DVec3::max);
        let size = DVec3::from_array(frame.sides);
        let is_finite = size.is_finite_mask();
        let is_periodic = frame.sides.map(f64::is_finite);
        let low = DVec3::select(is_finite, -0.5 * size, low.unwrap_or_default());
        let high = DVec3::select(is_finite, 0.5 * size, high.unwrap_or_default());
        Self { low, high, is_periodic, slide: frame.slide.unwrap_or(0.0) }
    }

    /// Returns whether any axis is periodic.
    pub fn repeats(&self) -> bool {
        self.is_periodic.contains(&true)
    }

    /// Returns the edges \[m\], infinite along open axes.
    pub fn period(&self) -> [f64; 3] {
        let size = (self.high - self.low).to_array();
        [0, 1, 2].map(|axis| if self.is_periodic[axis] { size[axis] } else { f64::INFINITY })
    }

    /// Returns the vector from the middle of the box to the origin \[m\], 0 along open axes.
    pub fn shift_to_origin(&self) -> DVec3 {
        let middle = (0.5 * (self.low + self.high)).to_array();
        DVec3::from_array(
            [0, 1, 2].map(|axis| if self.is_periodic[axis] { -middle[axis] } else { 0.0 }),
        )
    }

    /// Checks that the corners are finite and the periodic edges positive.
    pub fn check(&self) -> Result<(), Problem> {
        if !(self.low.is_finite() && self.high.is_finite()) {
            return Err("the corners of the box must be finite".into());
        }
        if (0..3).any(|axis| self.is_periodic[axis] && self.high[axis] <= self.low[axis]) {
            return Err("a periodic edge of the box must be longer than 0".into());
        }
        let is_sheared = self.slide != 0.0;
        if !self.slide.is_finite() || is_sheared && !(self.is_periodic[0] && self.is_periodic[1]) {
            return Err("a skewed box must be periodic along x and y".into());
        }
        Ok(())
    }
}

/// What a box is whose edges are skewed along other axes.
pub(super) const SKEWED: &str = "a box is read with skewed edges in steady shear only: y along x";

/// What the lines before the particles say.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Header {
    /// Number of particles.
    pub count: u64,
    /// Time \[s\], if the file has it.
    pub time: Option<f64>,
    /// The box, if the file has one.
    pub cell: Option<FrameBox>,
    /// What the columns of particles hold.
    pub columns: Columns,
}

/// A frame whose lines of particles are not yet read.
#[derive(Debug)]
pub(super) struct RawFrame {
    pub header: Header,
    /// Lines of the particles, as they stand in the file.
    pub rows: Vec<String>,
    /// Number of the first row of the frame in the file.
    pub first_row: u64,
    /// Position in the file after the last row of the frame \[bytes\].
    pub end: u64,
    /// Whether the last row of the frame ends with a line end.
    pub has_end: bool,
}
