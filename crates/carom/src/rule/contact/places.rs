//! Surfaces at both ends of a sub-step.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec3;

use crate::band::Band;
use crate::bounds::Bounds;
use crate::detect::sphere_surface;
use crate::detect::surface_tree::bounds;
use crate::round_solid::RoundSolid;
use crate::rule::periodic::image_shift;
use crate::surface::{Form, Role, Surface, SurfaceMotion};

/// Growth of the search distance when more images are needed; this is rare.
const IMAGES_FARTHER: f64 = 1.5;

/// The form and motion of a surface.
pub(super) type Place = (Form, SurfaceMotion);

/// An image of a surface in a periodic box: the number of the surface, and boxes between both along each axis.
type ImageKey = (u32, [i8; 3]);

/// The places of all surfaces, by their number, and those of their images, by numbers that follow.
#[derive(Debug, Clone, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Places {
    /// At the start of the sub-step. A snapshot shares those of surfaces at rest.
    #[cfg_attr(feature = "serde", serde(skip))]
    starts: Arc<Vec<Place>>,
    /// How many of them are not images.
    own: usize,
    /// At its end; empty where all are at rest.
    #[cfg_attr(feature = "serde", serde(skip))]
    ends: Vec<Place>,
    /// The numbers of moving surfaces that deflect spheres.
    moving: Vec<u32>,
    /// Number, and bounds for the frame of the speed of the origin \[m/s\] and of the angular velocity \[rad/s\],
    /// of the surfaces that do not move steadily; ascending.
    #[cfg_attr(feature = "serde", serde(skip))]
    fastest: Vec<(u32, [f64; 2])>,
    /// The images that spheres may touch.
    images: Vec<(ImageKey, DVec3)>,
    /// Their numbers.
    number_of: BTreeMap<ImageKey, u32>,
    /// Largest distance from the box of known images \[m\].
    image_reach: f64,
}

impl Places {
    /// Whether it holds as many surfaces, none of which moves: as long as no collider changes, these.
    pub fn are_of(&self, surfaces: &[Surface]) -> bool {
        self.moving.is_empty() && self.starts.len() == surfaces.len() + self.images.len()
    }

    /// Copies the surfaces for a frame of `h` \[s\] that begins.
    pub fn begin_frame(&mut self, surfaces: &[Surface], h: f64) {
        let starts = Arc::make_mut(&mut self.starts);
        place_all(surfaces, 0.0, starts);
        place_images(surfaces, &self.images, starts);
        self.own = surfaces.len();
        self.ends.clear();
        let moves =
            |(_, it): &(u32, &Surface)| it.role == Role::Deflects && !it.motion.is_at_rest();
        self.moving.clear();
        self.moving.extend((0..).zip(surfaces).filter(moves).map(|(number, _)| number));
        self.fastest.clear();
        self.fastest.extend(self.moving.iter().filter_map(|&number| {
            let bounds = surfaces[number as usize].course.as_ref()?.bounds(0.0, h);
            Some((number, [bounds.speed, bounds.spin]))
        }));
    }

    /// Computes the places of moving surfaces at the end of a sub-step, between two times of the frame \[s\].
    /// Surfaces that do not move steadily do so within the sub-step, between their places at both ends.
    pub fn begin_sub_step(&mut self, surfaces: &[Surface], times: [f64; 2]) {
        if !self.moving.is_empty() {
            place_all(surfaces, times[1], &mut self.ends);
            place_images(surfaces, &self.images, &mut self.ends);
            for &number in &self.moving {
                let mean = surfaces[number as usize].mean_motion(times);
                let (_, motion) = &mut Arc::make_mut(&mut self.starts)[number as usize];
                *motion = mean.unwrap_or(*motion);
            }
        }
    }

    /// Moves on to the next sub-step.
    pub fn end_sub_step(&mut self) {
        if !self.moving.is_empty() {
            std::mem::swap(Arc::make_mut(&mut self.starts), &mut self.ends);
        }
    }

    /// Finds the images of bounded surfaces at rest that come nearer than `reach` \[m\] to the periodic box with
    /// these edges \[m\]. Those that are known keep their numbers.
    pub fn find_images(&mut self, surfaces: &[Surface], period: DVec3, reach: f64) {
        if period == DVec3::INFINITY || reach <= self.image_reach {
            return;
        }
        self.image_reach = IMAGES_FARTHER * reach;
        let Self { starts, ends, images, number_of, image_reach, .. } = self;
        let starts = Arc::make_mut(starts);
        let near = Bounds::around(DVec3::ZERO, 0.5 * period).widened(*image_reach);
        for (number, surface) in (0..).zip(surfaces) {
            let bounds = bounds(&surface.form).filter(|_| surface.motion.is_at_rest());
            let Some(Bounds { min, max }) = bounds else { continue };
            for offset in offsets(period) {
                let shift = image_shift(offset.map(i32::from), period);
                let is_near = Bounds { min: min + shift, max: max + shift }.overlap(&near);
                if is_near && !number_of.contains_key(&(number, offset)) {
                    number_of.insert((number, offset), starts.len() as u32);
                    images.push(((number, offset), shift));
                    let place = (surface.form.shifted(shift), surface.motion);
                    // Once a sub-step has begun, the ends of all surfaces are known.
                    if !ends.is_empty() {
                        ends.push(place.clone());
                    }
                    starts.push(place);
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

    /// How many there are, with images.
    pub fn len(&self) -> usize {
        self.own + self.images.len()
    }

    /// The numbers of those that move, ascending.
    pub fn moving(&self) -> &[u32] {
        &self.moving
    }

    /// All surfaces at the start of the sub-step.
    pub fn starts(&self) -> &[Place] {
        &self.starts
    }

    /// A surface at the start of the sub-step.
    pub fn at_start(&self, surface: u32) -> &Place {
        &self.starts[surface as usize]
    }

    /// A surface at the end of the sub-step.
    pub fn at_end(&self, surface: u32) -> &Place {
        let ends = if self.ends.is_empty() { &self.starts } else { &self.ends };
        &ends[surface as usize]
    }

    /// How fast the fastest of them turns \[rad/s\].
    pub fn turning_rate(&self) -> f64 {
        let places = self.moving.iter().map(|&number| self.at_start(number));
        places.map(|(form, motion)| turning_rate(form, motion)).fold(0.0, f64::max)
    }

    /// Bounds for the frame of the speed of the origin of a surface \[m/s\] and of its angular velocity \[rad/s\], if
    /// it does not move steadily.
    fn fastest_of(&self, number: u32) -> Option<[f64; 2]> {
        let place = self.fastest.binary_search_by_key(&number, |it| it.0).ok()?;
        Some(self.fastest[place].1)
    }

    /// A bound of the speed \[m/s\] of a surface up to a distance `arm` \[m\] from its origin, in `left` \[s\].
    pub fn fastest_within(&self, number: u32, arm: f64, left: f64) -> f64 {
        let (_, motion) = self.at_start(number);
        match self.fastest_of(number) {
            Some([speed, spin]) => speed + spin * (arm + speed * left),
            None => motion.velocity.length() + motion.angular_velocity.length() * arm,
        }
    }

    /// The highest speed \[m/s\] with which a moving surface may approach a sphere with this centre \[m\], radius
    /// \[m\] and velocity \[m/s\] within a time \[s\].
    pub fn approach(&self, (center, radius): (DVec3, f64), velocity: DVec3, time: f64) -> f64 {
        let speed = |&number: &u32| {
            let (form, motion) = self.at_start(number);
            let arm = (center - motion.origin).length() + radius;
            let speed = match self.fastest_of(number) {
                Some([speed, spin]) => speed + velocity.length() + spin * (arm + speed * time),
                None => {
                    let turning = motion.angular_velocity.length() * arm;
                    (motion.velocity - velocity).length() + turning
                }
            };
            let separation = sphere_surface(form, center, radius)?;
            (separation.distance <= speed * time).then_some(speed)
        };
        self.moving.iter().filter_map(speed).fold(0.0, f64::max)
    }
}

/// The image offsets beside the periodic box with these edges \[m\].
pub(super) fn offsets(period: DVec3) -> impl Iterator<Item = [i8; 3]> {
    let along = |axis: usize| if period[axis].is_finite() { -1..=1 } else { 0..=0 };
    let [x, y, z] = [0, 1, 2].map(along);
    let all = x.flat_map(move |x| {
        let z = z.clone();
        y.clone().flat_map(move |y| z.clone().map(move |z| [x, y, z]))
    });
    all.filter(|&offset| offset != [0; 3])
}

fn place_images(surfaces: &[Surface], images: &[(ImageKey, DVec3)], places: &mut Vec<Place>) {
    places.extend(images.iter().map(|&((surface, _), shift)| {
        let surface = &surfaces[surface as usize];
        (surface.form.shifted(shift), surface.motion)
    }));
}

fn place_all(surfaces: &[Surface], time: f64, places: &mut Vec<Place>) {
    places.clear();
    places.extend(surfaces.iter().map(|surface| surface.after(time)));
}

/// How fast a surface changes by turning, or how fast its motion does \[rad/s\].
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
