//! A picture that grows on the device while people look at it: its sums stay there, and what is read back is the picture as a display
//! wants it.

use super::{Target, VulkanBackend};
use crate::path::film::FilmOnGpu;
use crate::{Buffer, Gpu, Post, Purpose, VulkanError};
use bytemuck::pod_read_unaligned;
use lumbre_core::control::{Control, Progress};
use lumbre_core::film::{Crop, Film};
use lumbre_core::settings::View;
use lumbre_shaders::post::{PostLook, STATE_BYTES};
use std::ops::Range;

/// Sums on the device, and what develops them.
pub struct Canvas<'a> {
    backend: &'a VulkanBackend,
    size: [u32; 2],
    /// `None` only while it is dropped.
    kept: Option<Kept>,
    /// The sums as they were last read, unless there have been samples since.
    host: Option<Film>,
}

/// What a canvas leaves for the next: an edited scene gets a new one many times a second, and its exposure goes on from the last.
pub(super) struct Kept {
    film: FilmOnGpu,
    post: Post,
    picture: Buffer,
    exposure: Buffer,
}

impl Kept {
    fn new(gpu: &Gpu) -> Result<Self, VulkanError> {
        Ok(Kept {
            film: FilmOnGpu::new(gpu, 1)?,
            post: Post::new(gpu, [1, 1])?,
            picture: Buffer::new(gpu, "picture on the host", 4, Purpose::Readback)?,
            exposure: Buffer::new(gpu, "exposure on the host", STATE_BYTES, Purpose::Readback)?,
        })
    }
}

impl VulkanBackend {
    /// A canvas to be [cleared](Canvas::clear) before anything else. Exposure goes on from the last one of this backend.
    ///
    /// # Errors
    /// If memory is out or the device is lost.
    pub fn canvas(&self) -> Result<Canvas<'_>, VulkanError> {
        let kept = self.lock().canvas.take();
        let mut canvas = Canvas { backend: self, size: [1, 1], kept, host: None };
        if canvas.kept.is_none() {
            canvas.kept = Some(Kept::new(&self.gpu)?);
        }
        Ok(canvas)
    }
}

impl Drop for Canvas<'_> {
    fn drop(&mut self) {
        self.backend.lock().canvas = self.kept.take();
    }
}

impl Canvas<'_> {
    fn kept(&self) -> &Kept {
        self.kept.as_ref().expect("there until it is dropped")
    }

    /// Forgets all samples, and gets ready for a picture of this size. The exposure is not forgotten.
    ///
    /// # Errors
    /// If memory is out or the device is lost.
    pub fn clear(&mut self, size: [u32; 2]) -> Result<(), VulkanError> {
        let gpu = &self.backend.gpu;
        let pixels = u64::from(size[0]) * u64::from(size[1]);
        self.host = None;
        self.size = size;
        let kept = self.kept.as_mut().expect("there until it is dropped");
        // Views grow finer step by step: what is too large by less than that is kept.
        if kept.film.pixels() < pixels || kept.film.pixels() > 256 * pixels.max(1) {
            kept.film = FilmOnGpu::new(gpu, pixels)?;
            kept.picture = Buffer::new(gpu, "picture on the host", 4 * pixels, Purpose::Readback)?;
        }
        kept.post.resize(gpu, size)?;
        kept.film.empty(gpu)
    }

    fn crop(&self) -> Crop {
        Crop { origin: [0, 0], size: self.size }
    }

    /// Adds the samples of a range to every pixel: [`VulkanBackend::render`].
    ///
    /// # Errors
    /// If memory is out or the device is lost.
    pub fn add(
        &mut self,
        view: &View,
        samples: Range<u32>,
        control: &dyn Control,
    ) -> Result<Progress, VulkanError> {
        self.host = None;
        let target = Target { picture: self.size, crop: self.crop(), film: self.kept().film.addresses() };
        self.backend.add(&mut self.backend.lock(), view, &target, samples, control)
    }

    /// The sums.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn film(&mut self) -> Result<&Film, VulkanError> {
        let film = match self.host.take() {
            Some(film) => film,
            None => {
                let mut film = Film::new(self.size[0], self.size[1]);
                self.kept().film.read(&self.backend.gpu, &mut film)?;
                film
            }
        };
        Ok(self.host.insert(film))
    }

    /// The picture as a display wants it, four bytes a pixel, row 0 on top, and the factor of its exposure.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn develop(&mut self, look: &PostLook) -> Result<(Vec<u8>, f32), VulkanError> {
        let bytes = 4 * u64::from(self.size[0]) * u64::from(self.size[1]);
        let Kept { film, post, picture, exposure } = self.kept();
        let [film, _] = film.addresses();
        self.backend.gpu.run("developing", |commands| {
            post.record(commands, film, self.size, self.crop(), look);
            commands.copy((post.display(), 0), (picture, 0), bytes);
            commands.copy((post.exposure(), 0), (exposure, 0), STATE_BYTES);
            Ok(())
        })?;
        let factor = pod_read_unaligned(&exposure.read()[..4]);
        Ok((picture.read()[..bytes as usize].to_vec(), factor))
    }

    /// Bytes that the sums take on the device.
    pub fn bytes(&self) -> u64 {
        Film::bytes(1, 1) * self.kept().film.pixels()
    }
}
