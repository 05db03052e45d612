//! Where pictures are made.

use carom_render::{Camera, Drawing, Framing, GpuError, Offscreen, Picture, caption, stamp};

use super::args::Look;
use super::error::ShootError;
use super::footage::{Footage, Words};

/// Draws footage as the user wants to see it.
#[derive(Debug)]
pub struct Studio {
    look: Look,
    offscreen: Offscreen,
    drawing: Drawing,
}

impl Studio {
    /// A studio on a graphics device of its own.
    ///
    /// # Errors
    /// [`GpuError`] if there is no device, or none for pictures of this size.
    pub fn new(look: Look) -> Result<Self, GpuError> {
        let offscreen = Offscreen::new(look.size, look.quality)?;
        Ok(Self { look, offscreen, drawing: Drawing::default() })
    }

    /// Width and height of its pictures in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.look.size
    }

    /// A camera for footage, by what is to be seen from this time \[s\] on.
    ///
    /// # Errors
    /// As [`Footage::draw`].
    pub fn camera(&mut self, footage: &mut dyn Footage, time: f64) -> Result<Camera, ShootError> {
        footage.draw(time, &mut self.drawing)?;
        let [width, height] = self.look.size.map(f64::from);
        let framing = Framing::of_run(Framing::of_scene(footage.scene()), &self.drawing);
        self.drawing.framing = Some(framing);
        let aspect = width / height;
        let of_scene = Camera::of_scene(footage.scene()).map(|camera| camera.in_picture(aspect));
        Ok(self.look.camera.camera(of_scene, &framing.whole, aspect))
    }

    /// Footage at a time \[s\].
    ///
    /// # Errors
    /// As [`Footage::draw`], and if the device fails.
    pub fn picture(
        &mut self,
        footage: &mut dyn Footage,
        time: f64,
        camera: &Camera,
    ) -> Result<Picture, ShootError> {
        let Words { stamp: now, caption: large } = footage.draw(time, &mut self.drawing)?;
        let mut picture = self.offscreen.draw(&self.drawing, camera)?;
        if !self.look.no_stamp {
            stamp(&mut picture, &format!("{}   {now}", footage.title()));
            large.into_iter().for_each(|text| caption(&mut picture, text));
        }
        Ok(picture)
    }
}
