//! Surfaces at both ends of a sub-step.

mod of_collider;

pub(crate) mod flat;
pub(crate) mod top_speed;

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

use educe::Educe;
use glam::DVec3;

use self::of_collider::OfCollider;
use self::top_speed::TopSpeed;
use crate::band::Band;
use crate::bounds::Bounds;
use crate::detect::moving_surfaces::PlacedTree;
use crate::detect::sphere_surface;
use crate::detect::surface_tree::bounds;
use crate::round_solid::RoundSolid;
use crate::rule::periodic::image_shift;
use crate::surface::{Form, LastCarriage, Role, Surface, SurfaceMotion};
use crate::system::System;

/// Growth of the search distance when more images are needed; this is rare.
const IMAGES_FARTHER: f64 = 1.5;

/// The form and motion of a surface.
pub(crate) type Place<'a> = (&'a Form, &'a SurfaceMotion);

/// An image of a surface in a periodic box: the number of the surface, and boxes between both along each axis.
type ImageKey = (u32, [i8; 3]);

/// A surface that moves, at both ends of the sub-step.
#[derive(Debug, Clone)]
struct MovingPlace {
    number: u32,
    /// Place at the start; within the sub-step the surface moves as this says, between its places
    /// at both ends.
    start: (Form, SurfaceMotion),
    end: (Form, SurfaceMotion),
    /// Bounds for the frame of the speed of its origin \[m/s\] and of its angular velocity \[rad/s\], if it does not
    /// move steadily.
    fastest: Option<[f64; 2]>,
}

/// The places of all surfaces, by their number, and those of their images, by numbers that follow. Of surfaces that
/// move, only those near spheres have their present places.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Places {
    /// The surfaces when they changed last, which the colliders share.
    #[cfg_attr(feature = "serde", serde(skip))]
    starts: Arc<Vec<Surface>>,
    /// The forms of the images, in their order; a snapshot shares them.
    #[cfg_attr(feature = "serde", serde(skip))]
    of_images: Arc<Vec<Form>>,
    /// Whether spheres may come through a surface from behind.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub any_open: bool,
    /// Number of surfaces that are not images.
    own: usize,
    /// The numbers of moving surfaces that deflect spheres.
    moving: Vec<u32>,
    /// Places of the surfaces that are known, by number.
    #[cfg_attr(feature = "serde", serde(skip))]
    known: Vec<MovingPlace>,
    /// When the places at the start of the sub-step are computed, in the frame \[s\]: as at the end of the sub-step
    /// before, however sums round.
    #[cfg_attr(feature = "serde", serde(skip))]
    start: f64,
    /// The sub-step, in the frame \[s\].
    #[cfg_attr(feature = "serde", serde(skip))]
    times: [f64; 2],
    /// Length of the frame \[s\].
    #[cfg_attr(feature = "serde", serde(skip))]
    frame: f64,
    /// How fast the fastest surface turns \[rad/s\].
    #[cfg_attr(feature = "serde", serde(skip))]
    turning_rate: f64,
    /// The images that spheres may touch.
    images: Vec<(ImageKey, DVec3)>,
    /// Number of each image.
    number_of: BTreeMap<ImageKey, u32>,
    /// Largest distance from the box of known images \[m\].
    image_reach: f64,
}

impl Places {
    /// Whether it holds as many surfaces, none of which moves: as long as no collider changes, these.
    pub fn are_of(&self, surfaces: &[Surface]) -> bool {
        self.moving.is_empty() && self.holds(surfaces)
    }

    fn holds(&self, surfaces: &[Surface]) -> bool {
        self.starts.len() == surfaces.len() && self.of_images.len() == self.images.len()
    }

    /// Begins a frame of `h` \[s\]; shares the surfaces if they `changed`, or are not known.
    pub fn begin_frame(&mut self, surfaces: &Arc<Vec<Surface>>, h: f64, changed: bool) {
        self.known.clear();
        (self.start, self.times, self.frame) = (0.0, [0.0; 2], h);
        self.share(surfaces, changed);
        let moving = self.moving.iter().map(|&number| &surfaces[number as usize]);
        let rates = moving.map(|it| turning_rate(&it.form, &it.motion));
        self.turning_rate = rates.fold(0.0, f64::max);
    }

    /// Shares the surfaces if they `changed`, or are not known.
    fn share(&mut self, surfaces: &Arc<Vec<Surface>>, changed: bool) {
        if !changed && self.holds(surfaces) {
            return;
        }
        self.starts = Arc::clone(surfaces);
        let image = |((surface, _), shift): &(ImageKey, DVec3)| {
            Some(surfaces.get(*surface as usize)?.form.shifted(*shift))
        };
        self.of_images = Arc::new(self.images.iter().filter_map(image).collect());
        self.own = surfaces.len();
        self.any_open = surfaces.iter().any(|surface| surface.form.is_open());
        let moves =
            |(_, it): &(u32, &Surface)| it.role == Role::Deflects && !it.motion.is_at_rest();
        self.moving.clear();
        self.moving.extend((0..).zip(surfaces.iter()).filter(moves).map(|(number, _)| number));
    }

    /// Begins a sub-step between two times of the frame \[s\].
    pub fn begin_sub_step(&mut self, system: &System, times: [f64; 2]) {
        (self.start, self.times) = (self.times[1], times);
        let [begun, last] = [LastCarriage::default(), LastCarriage::default()];
        let mut mean = OfCollider::default();
        let mut known = std::mem::take(&mut self.known);
        known.iter_mut().for_each(|it| {
            let surface = self.surface(system, it.number, &begun);
            it.end = last.after(&surface, times[1]);
            let mean = mean.get(surface.collider, || surface.mean_motion(times));
            it.start.1 = mean.unwrap_or(it.start.1);
        });
        self.known = known;
    }

    /// Moves on to the next sub-step.
    pub fn end_sub_step(&mut self) {
        self.known.iter_mut().for_each(|it| std::mem::swap(&mut it.start, &mut it.end));
    }

    /// Computes the places of moving surfaces with these numbers, as far as they are not known.
    pub fn know(&mut self, system: &System, numbers: &[u32]) {
        let mut new: Vec<u32> =
            numbers.iter().copied().filter(|&it| self.moving_place(it).is_none()).collect();
        if new.is_empty() {
            return;
        }
        new.sort_unstable();
        new.dedup();
        let [begun, first, last] = [(); 3].map(|()| LastCarriage::default());
        let (mut mean, mut fastest) = (OfCollider::default(), OfCollider::default());
        let places = new.into_iter().map(|number| {
            let surface = self.surface(system, number, &begun);
            let mut start = first.after(&surface, self.start);
            let end = last.after(&surface, self.times[1]);
            let mean = mean.get(surface.collider, || surface.mean_motion(self.times));
            start.1 = mean.unwrap_or(start.1);
            let fastest = fastest.get(surface.collider, || {
                let bounds = surface.course.as_ref()?.bounds(0.0, self.frame);
                Some([bounds.speed, bounds.spin])
            });
            MovingPlace { number, start, end, fastest }
        });
        let places: Vec<MovingPlace> = places.collect();
        self.known.extend(places);
        self.known.sort_unstable_by_key(|it| it.number);
    }

    /// A surface as it is when the frame begins.
    fn surface<'a>(
        &self,
        system: &System<'a>,
        number: u32,
        begun: &LastCarriage,
    ) -> Cow<'a, Surface> {
        let surface = &system.surfaces[number as usize];
        match system.moved_for {
            Some(time) => Cow::Owned(begun.moved(surface, time)),
            None => Cow::Borrowed(surface),
        }
    }

    fn moving_place(&self, number: u32) -> Option<&MovingPlace> {
        let place = self.known.binary_search_by_key(&number, |it| it.number).ok()?;
        Some(&self.known[place])
    }

    /// The surfaces that move, where they are at the start of the sub-step, and how fast they are in the frame.
    pub fn trees_at_start<'a>(&self, system: &System<'a>) -> Vec<(PlacedTree<'a>, TopSpeed)> {
        if self.moving.is_empty() {
            return Vec::new();
        }
        let begun = system.moved_for.unwrap_or(0.0);
        let with_speed = |tree: PlacedTree<'a>| {
            let [speed, spin] = tree.fastest([begun, self.frame]);
            (tree, TopSpeed { speed, spin, origin: tree.origin })
        };
        let last = LastCarriage::default();
        system.moving_after(begun + self.start, &last).map(with_speed).collect()
    }

    /// Finds the images of bounded surfaces at rest that come nearer than `reach` \[m\] to the periodic box with
    /// these edges \[m\]. Those that are known keep their numbers.
    pub fn find_images(&mut self, surfaces: &[Surface], period: DVec3, reach: f64) {
        if period == DVec3::INFINITY || reach <= self.image_reach {
            return;
        }
        self.image_reach = IMAGES_FARTHER * reach;
        let Self { own, of_images, images, number_of, image_reach, .. } = self;
        let of_images = Arc::make_mut(of_images);
        let near = Bounds::around(DVec3::ZERO, 0.5 * period).widened(*image_reach);
        for (number, surface) in (0..).zip(surfaces) {
            let bounds = bounds(&surface.form).filter(|_| surface.motion.is_at_rest());
            let Some(Bounds { min, max }) = bounds else { continue };
            for offset in offsets(period, 1) {
                let shift = image_shift(offset.map(i32::from), period);
                let is_near = Bounds { min: min + shift, max: max + shift }.overlap(&near);
                if is_near && !number_of.contains_key(&(number, offset)) {
                    number_of.insert((number, offset), (*own + of_images.len()) as u32);
                    images.push(((number, offset), shift));
                    of_images.push(surface.form.shifted(shift));
                }
            }
        }
    }

    /// Forgets all images, because the surfaces changed.
    pub fn forget_images(&mut self) {
        self.images.clear();
        self.number_of.clear();
        self.image_reach = 0.0;
    }

    /// The image of a surface at an offset in boxes, if it is known.
    pub fn number_of_image(&self, surface: u32, offset: [i8; 3]) -> Option<u32> {
        self.number_of.get(&(surface, offset)).copied()
    }

    /// The surface of which this is the image, with the offset from it \[m\]; of a surface itself, its own number.
    pub fn image(&self, number: u32) -> (u32, DVec3) {
        match self.images.get((number as usize).wrapping_sub(self.own)) {
            Some(&((surface, _), shift)) if number as usize >= self.own => (surface, shift),
            _ => (number, DVec3::ZERO),
        }
    }

    /// The surface of which this is the image; of a surface itself, its own number.
    pub fn surface_of(&self, number: u32) -> u32 {
        self.image(number).0
    }

    /// Returns the number of surfaces, images included.
    pub fn len(&self) -> usize {
        self.own + self.images.len()
    }

    /// Returns whether some surfaces move.
    pub fn are_moving(&self) -> bool {
        !self.moving.is_empty()
    }

    /// The numbers of all that are at rest, images included, and of the moving ones that are known.
    pub fn all_known(&self) -> impl Iterator<Item = u32> {
        let moves = |it: &u32| self.moving.binary_search(it).is_ok();
        let at_rest = (0..self.len() as u32).filter(move |it| !moves(it));
        at_rest.chain(self.known.iter().map(|it| it.number))
    }

    /// The numbers of all images, and of the moving surfaces that are known.
    pub fn images_and_moving(&self) -> impl Iterator<Item = u32> {
        let images = self.own as u32..self.len() as u32;
        images.chain(self.known.iter().map(|it| it.number))
    }

    /// A surface at the start of the sub-step.
    pub fn at_start(&self, surface: u32) -> Place<'_> {
        match self.moving_place(surface) {
            Some(MovingPlace { start: (form, motion), .. }) => (form, motion),
            None => self.begun(surface),
        }
    }

    /// A surface at the end of the sub-step.
    pub fn at_end(&self, surface: u32) -> Place<'_> {
        match self.moving_place(surface) {
            Some(MovingPlace { end: (form, motion), .. }) => (form, motion),
            None => self.begun(surface),
        }
    }

    /// A surface when the surfaces changed last.
    fn begun(&self, number: u32) -> Place<'_> {
        let Some(image) = (number as usize).checked_sub(self.own) else {
            return self.starts[number as usize].place();
        };
        let ((surface, _), _) = self.images[image];
        (&self.of_images[image], &self.starts[surface as usize].motion)
    }

    /// Returns the fastest turning rate of the surfaces \[rad/s\].
    pub fn turning_rate(&self) -> f64 {
        self.turning_rate
    }

    /// A bound of the speed \[m/s\] of a surface up to a distance `arm` \[m\] from its origin, in `left` \[s\].
    pub fn fastest_within(&self, number: u32, arm: f64, left: f64) -> f64 {
        let (_, motion) = self.at_start(number);
        match self.moving_place(number).and_then(|it| it.fastest) {
            Some([speed, spin]) => speed + spin * (arm + speed * left),
            None => motion.velocity.length() + motion.angular_velocity.length() * arm,
        }
    }

    /// The highest speed \[m/s\] with which one of these moving surfaces may approach a sphere with this centre \[m\],
    /// radius \[m\] and velocity \[m/s\] within a time \[s\].
    pub fn approach(
        &self,
        numbers: &[u32],
        (center, radius): (DVec3, f64),
        velocity: DVec3,
        time: f64,
    ) -> f64 {
        let speed = |&number: &u32| {
            let MovingPlace { start: (form, motion), fastest, .. } = self.moving_place(number)?;
            let arm = (center - motion.origin).length() + radius;
            let speed = match *fastest {
                Some([speed, spin]) => speed + velocity.length() + spin * (arm + speed * time),
                None => {
                    let turning = motion.angular_velocity.length() * arm;
                    (motion.velocity - velocity).length() + turning
                }
            };
            let separation = sphere_surface(form, center, radius)?;
            (separation.distance <= speed * time).then_some(speed)
        };
        numbers.iter().filter_map(speed).fold(0.0, f64::max)
    }
}

/// The image offsets beside the periodic box with these edges \[m\].
pub(crate) fn offsets(period: DVec3, beside: i8) -> impl Iterator<Item = [i8; 3]> {
    let along = |axis: usize, most: i8| if period[axis].is_finite() { -most..=most } else { 0..=0 };
    let [x, y, z] = [along(0, beside), along(1, 1), along(2, 1)];
    let all = x.flat_map(move |x| {
        let z = z.clone();
        y.clone().flat_map(move |y| z.clone().map(move |z| [x, y, z]))
    });
    all.filter(|&offset| offset != [0; 3])
}

/// Returns how fast a surface changes by turning, or how fast its motion does \[rad/s\].
pub(crate) fn turning_rate(form: &Form, motion: &SurfaceMotion) -> f64 {
    if let Some(drive) = motion.drive {
        return drive.rate;
    }
    match form {
        // Of a collider of its own, about its centre.
        Form::Sphere { .. } => 0.0,
        Form::HalfSpace { normal, .. } => motion.angular_velocity.cross(*normal).length(),
        Form::Band(Band { axis, .. }) | Form::Round(RoundSolid { axis, .. }) => {
            motion.angular_velocity.cross(*axis).length()
        }
        _ => motion.angular_velocity.length(),
    }
}
