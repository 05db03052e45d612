//! Records the states of all spheres in a run, frame by frame.

use std::collections::{BTreeMap, TryReserveError};
use std::sync::Arc;

use carom::{SphereId, StepReport, World};

use crate::failure::Failure;
use crate::quantity::Quantity;
use crate::tables::Table;

/// The parts of each state that are recorded.
#[derive(Debug, Clone)]
pub struct Selection {
    /// `None`: centres and velocities, and orientations and angular velocities if spheres can
    /// rotate.
    pub quantities: Option<Vec<Quantity>>,
    /// Whether numbers are rounded to single precision.
    pub is_single: bool,
    /// Whether impacts are recorded, too.
    pub has_impacts: bool,
    /// Whether events of sensors are recorded, too.
    pub has_sensor_events: bool,
}

/// Rows of states, one for each recorded frame.
#[derive(Debug)]
pub struct Recording {
    /// Times \[s\].
    pub times: Vec<f64>,
    /// Recorded quantities of each sphere of each row.
    motion: Vec<(Quantity, Numbers)>,
    /// Working memory for one row.
    row: Vec<f64>,
    /// The spheres of each row, ascending.
    members: Vec<Arc<[SphereId]>>,
    /// Last radius \[m\] and mass \[kg\] of every sphere of any row.
    known: BTreeMap<SphereId, [f64; 2]>,
    /// Impacts of all frames, also of frames that are not recorded, if impacts are selected.
    impacts: Table,
    has_impacts: bool,
    /// Events of sensors in all frames, if they are selected.
    sensor_events: Table,
    has_sensor_events: bool,
}

/// The recorded rows, each with space for every sphere of any row.
#[derive(Debug)]
pub struct States {
    /// Ids, ascending.
    pub ids: Vec<SphereId>,
    /// Radii \[m\].
    pub radii: Vec<f64>,
    /// Masses \[kg\].
    pub masses: Vec<f64>,
    /// Quantities that change from row to row; NaN for a sphere that does not exist in a row.
    pub motion: Vec<(Quantity, Numbers)>,
}

/// Numbers in double or in single precision.
#[derive(Debug)]
pub enum Numbers {
    Double(Vec<f64>),
    Single(Vec<f32>),
}

impl Recording {
    /// Makes an empty recording with memory for `rows` states of a world.
    ///
    /// # Errors
    /// [`Failure`] if there is no memory for them.
    pub fn new(world: &World, selection: &Selection, rows: u64) -> Result<Self, Failure> {
        let all: &[Quantity] = match &selection.quantities {
            Some(quantities) => quantities,
            None if world.has_spin() => &Quantity::MOTION,
            None => &WITHOUT_SPIN,
        };
        let spheres = world.spheres().len();
        let (mut times, mut members) = (Vec::new(), Vec::new());
        let count = usize::try_from(rows).unwrap_or(usize::MAX);
        times.try_reserve_exact(count).map_err(no_room)?;
        members.try_reserve_exact(count).map_err(no_room)?;
        // Memory is requested for all at once: a system may promise each part memory that it does
        // not have in total.
        let widths: usize = all.iter().map(|it| it.width()).sum();
        let size = if selection.is_single { size_of::<f32>() } else { size_of::<f64>() };
        let bytes = count.checked_mul(size * widths * spheres);
        let is_room = bytes.is_some_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok());
        if !is_room {
            let gigabytes = rows as f64 * (size * widths * spheres) as f64 / 1e9;
            return Err(Failure::memory(format_args!(
                "{rows} states of {spheres} spheres take {gigabytes:.1} GB, more than there is: record \
                 fewer (every=10), less of each (quantities=[\"positions\"]), or in single precision \
                 (dtype=\"float32\")"
            )));
        }
        let mut motion: Vec<_> =
            all.iter().map(|&it| (it, Numbers::new(selection.is_single))).collect();
        for (quantity, numbers) in &mut motion {
            let count = count.checked_mul(quantity.width() * spheres);
            numbers.reserve(count.unwrap_or(usize::MAX)).map_err(no_room)?;
        }
        Ok(Self {
            times,
            motion,
            row: Vec::new(),
            members,
            known: BTreeMap::new(),
            impacts: Table::default(),
            has_impacts: selection.has_impacts,
            sensor_events: Table::default(),
            has_sensor_events: selection.has_sensor_events,
        })
    }

    /// Appends the state of a world.
    ///
    /// # Errors
    /// [`Failure`] if there is no memory for it.
    pub fn push(&mut self, world: &World) -> Result<(), Failure> {
        let spheres = world.spheres();
        for (quantity, numbers) in &mut self.motion {
            self.row.resize(quantity.width() * spheres.len(), 0.0);
            quantity.write(spheres, &mut self.row);
            numbers.extend(&self.row).map_err(no_room)?;
        }
        self.times.push(world.time());
        let last = self.members.last().filter(|last| ***last == *spheres.ids());
        let members = last.map_or_else(|| spheres.ids().into(), Arc::clone);
        if !self.members.last().is_some_and(|last| Arc::ptr_eq(last, &members)) {
            let properties = spheres.radii().iter().zip(spheres.masses());
            let known = spheres.ids().iter().zip(properties);
            self.known.extend(known.map(|(id, (radius, mass))| (*id, [*radius, *mass])));
        }
        self.members.push(members);
        Ok(())
    }

    /// Appends the impacts and the events of sensors of a frame that started at `start` \[s\], as
    /// far as they are recorded.
    ///
    /// # Errors
    /// [`Failure`] if there is no memory for them.
    pub fn push_events(&mut self, start: f64, report: &StepReport) -> Result<(), Failure> {
        let StepReport { impacts, sensor_events, .. } = report;
        if self.has_impacts {
            self.impacts.reserve_impacts(impacts.len()).map_err(no_impact_room)?;
            self.impacts.push_impacts(start, impacts);
        }
        if self.has_sensor_events {
            let reserved = self.sensor_events.reserve_sensor_events(sensor_events.len());
            reserved.map_err(no_sensor_event_room)?;
            self.sensor_events.push_sensor_events(start, sensor_events);
        }
        Ok(())
    }

    /// Returns times, states, impacts, and events of sensors.
    ///
    /// # Errors
    /// [`Failure`] if there is no memory for them.
    pub fn finish(self) -> Result<(Vec<f64>, States, [Table; 2]), Failure> {
        let ids: Vec<SphereId> = self.known.keys().copied().collect();
        let is_whole = self.members.iter().all(|members| **members == *ids);
        let mut motion = self.motion;
        motion.iter_mut().for_each(|(_, numbers)| numbers.shrink_to_fit());
        if !is_whole {
            for (quantity, numbers) in &mut motion {
                numbers.spread(quantity.width(), &self.members, &ids).map_err(no_room)?;
            }
        }
        let states = States {
            radii: self.known.values().map(|[radius, _]| *radius).collect(),
            masses: self.known.values().map(|[_, mass]| *mass).collect(),
            motion,
            ids,
        };
        Ok((self.times, states, [self.impacts, self.sensor_events]))
    }
}

/// Quantities that are recorded if nothing rotates.
const WITHOUT_SPIN: [Quantity; 2] = [Quantity::Positions, Quantity::Velocities];

fn no_room(_: TryReserveError) -> Failure {
    Failure::memory("there is no memory for so many states: record fewer (every=10)")
}

fn no_impact_room(_: TryReserveError) -> Failure {
    Failure::memory("there is no memory for so many impacts: leave them out (impacts=False)")
}

fn no_sensor_event_room(_: TryReserveError) -> Failure {
    let problem = "there is no memory for so many events of sensors: leave them out \
                   (sensor_events=False)";
    Failure::memory(problem)
}

impl Numbers {
    fn new(is_single: bool) -> Self {
        if is_single { Self::Single(Vec::new()) } else { Self::Double(Vec::new()) }
    }

    fn reserve(&mut self, count: usize) -> Result<(), TryReserveError> {
        match self {
            Self::Double(numbers) => numbers.try_reserve_exact(count),
            Self::Single(numbers) => numbers.try_reserve_exact(count),
        }
    }

    /// Frees memory for rows that were not recorded.
    fn shrink_to_fit(&mut self) {
        match self {
            Self::Double(numbers) => numbers.shrink_to_fit(),
            Self::Single(numbers) => numbers.shrink_to_fit(),
        }
    }

    fn extend(&mut self, row: &[f64]) -> Result<(), TryReserveError> {
        match self {
            Self::Double(numbers) => {
                numbers.try_reserve(row.len())?;
                numbers.extend_from_slice(row);
            }
            Self::Single(numbers) => {
                numbers.try_reserve(row.len())?;
                numbers.extend(row.iter().map(|&number| number as f32));
            }
        }
        Ok(())
    }

    /// Converts rows with the spheres of each row into rows with all `ids`.
    fn spread(
        &mut self,
        width: usize,
        members: &[Arc<[SphereId]>],
        ids: &[SphereId],
    ) -> Result<(), TryReserveError> {
        match self {
            Self::Double(numbers) => *numbers = spread(numbers, f64::NAN, width, members, ids)?,
            Self::Single(numbers) => *numbers = spread(numbers, f32::NAN, width, members, ids)?,
        }
        Ok(())
    }
}

/// Converts rows of `width` numbers for the spheres of each row into rows with all `ids`; spheres
/// that a row does not have get `missing`.
fn spread<T: Copy>(
    values: &[T],
    missing: T,
    width: usize,
    members: &[Arc<[SphereId]>],
    ids: &[SphereId],
) -> Result<Vec<T>, TryReserveError> {
    let count = width * ids.len() * members.len();
    let mut all = Vec::new();
    all.try_reserve_exact(count)?;
    all.resize(count, missing);
    let mut values = values.chunks_exact(width);
    for (row, members) in members.iter().enumerate() {
        for (id, value) in members.iter().zip(&mut values) {
            // Every sphere of a row is among the ids.
            let column = ids.partition_point(|other| other < id);
            let place = width * (row * ids.len() + column);
            all[place..place + width].copy_from_slice(value);
        }
    }
    Ok(all)
}
