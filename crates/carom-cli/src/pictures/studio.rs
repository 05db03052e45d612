//! Makes pictures of footage.

use carom_render::{
    Camera, Drawing, Framing, GpuError, Offscreen, Picture, Readback, caption, missing_characters,
    stamp,
};

use super::args::PictureOptions;
use super::error::ShootError;
use super::footage::{Footage, Words};

/// Draws footage with the camera, size and quality that the user chose.
#[derive(Debug)]
pub struct Studio {
    look: PictureOptions,
    offscreen: Offscreen,
    drawing: Drawing,
}

/// A picture that the graphics device is drawing.
#[derive(Debug)]
pub struct Shot {
    readback: Readback,
    title: String,
    words: Words,
}

impl Studio {
    /// Creates a studio with its own graphics device.
    ///
    /// # Errors
    /// [`GpuError`] if there is no device, or the device does not support pictures of this size.
    pub fn new(look: PictureOptions) -> Result<Self, GpuError> {
        let offscreen = Offscreen::new(look.size, look.quality)?;
        Ok(Self { look, offscreen, drawing: Drawing::default() })
    }

    /// Width and height of its pictures \[pixels\].
    pub fn size(&self) -> [u32; 2] {
        self.look.size
    }

    /// Returns a remark about characters of a title that no font draws, which pictures lack.
    pub fn remark(&self, title: &str) -> Option<String> {
        let missing = if self.look.no_stamp { String::new() } else { missing_characters(title) };
        (!missing.is_empty())
            .then(|| format!("the stamp lacks {missing}: no font of this machine draws that"))
    }

    /// Chooses a camera for footage that starts at `time` \[s\].
    ///
    /// # Errors
    /// The same as those of [`Footage::draw`].
    pub fn camera(&mut self, footage: &mut dyn Footage, time: f64) -> Result<Camera, ShootError> {
        footage.draw(time, &mut self.drawing)?;
        let [width, height] = self.look.size.map(f64::from);
        let framing = Framing::of_run(Framing::of_scene(footage.scene()), &self.drawing);
        self.drawing.framing = Some(framing);
        let aspect = width / height;
        let of_scene = Camera::of_scene(footage.scene()).map(|camera| camera.in_picture(aspect));
        Ok(self.look.camera.camera(of_scene, &framing.whole, aspect))
    }

    /// Draws the picture of footage at `time` \[s\].
    ///
    /// # Errors
    /// The same as those of [`Footage::draw`], and errors of the graphics device.
    pub fn picture(
        &mut self,
        footage: &mut dyn Footage,
        time: f64,
        camera: &Camera,
    ) -> Result<Picture, ShootError> {
        let shot = self.begin(footage, time, camera)?;
        Ok(self.finish(shot)?)
    }

    /// Starts to draw the picture of footage at `time` \[s\], without waiting for it.
    ///
    /// # Errors
    /// The same as those of [`Self::picture`].
    pub fn begin(
        &mut self,
        footage: &mut dyn Footage,
        time: f64,
        camera: &Camera,
    ) -> Result<Shot, ShootError> {
        let words = footage.draw(time, &mut self.drawing)?;
        let readback = self.offscreen.begin(&self.drawing, camera)?;
        Ok(Shot { readback, title: footage.title().to_owned(), words })
    }

    /// Waits for a picture that [`Self::begin`] started.
    ///
    /// # Errors
    /// [`GpuError`] if the graphics device fails.
    pub fn finish(&self, shot: Shot) -> Result<Picture, GpuError> {
        let Shot { readback, title, words } = shot;
        let mut picture = self.offscreen.finish(readback)?;
        if !self.look.no_stamp {
            stamp(&mut picture, &format!("{title}   {}", words.stamp));
            words.caption.into_iter().for_each(|text| caption(&mut picture, text));
        }
        Ok(picture)
    }
}
