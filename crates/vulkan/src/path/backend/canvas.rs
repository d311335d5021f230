//! A picture that grows on the device while people look at it: its sums stay there, and what is read back is the picture as a display
//! wants it.

use super::{Target, VulkanBackend};
use crate::path::film::FilmOnGpu;
use crate::{Buffer, Post, Purpose, VulkanError};
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
    film: FilmOnGpu,
    post: Post,
    picture: Buffer,
    exposure: Buffer,
    /// The sums as they were last read, unless there have been samples since.
    host: Option<Film>,
}

impl VulkanBackend {
    /// An empty canvas of one pixel.
    ///
    /// # Errors
    /// If memory is out or the device is lost.
    pub fn canvas(&self) -> Result<Canvas<'_>, VulkanError> {
        let gpu = &self.gpu;
        Ok(Canvas {
            backend: self,
            size: [1, 1],
            film: FilmOnGpu::new(gpu, 1)?,
            post: Post::new(gpu, [1, 1])?,
            picture: Buffer::new(gpu, "picture on the host", 4, Purpose::Readback)?,
            exposure: Buffer::new(gpu, "exposure on the host", STATE_BYTES, Purpose::Readback)?,
            host: None,
        })
    }
}

impl Canvas<'_> {
    /// Forgets all samples, and gets ready for a picture of this size. The exposure is not forgotten.
    ///
    /// # Errors
    /// If memory is out or the device is lost.
    pub fn clear(&mut self, size: [u32; 2]) -> Result<(), VulkanError> {
        let gpu = &self.backend.gpu;
        let pixels = u64::from(size[0]) * u64::from(size[1]);
        self.host = None;
        // Views grow finer step by step: what is too large by less than that is kept.
        if self.film.pixels() < pixels || self.film.pixels() > 256 * pixels.max(1) {
            self.film = FilmOnGpu::new(gpu, pixels)?;
            self.picture = Buffer::new(gpu, "picture on the host", 4 * pixels, Purpose::Readback)?;
        }
        self.post.resize(gpu, size)?;
        self.size = size;
        self.film.empty(gpu)
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
        let target = Target { picture: self.size, crop: self.crop(), film: self.film.addresses() };
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
                self.film.read(&self.backend.gpu, &mut film)?;
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
        let [film, _] = self.film.addresses();
        self.backend.gpu.run("developing", |commands| {
            self.post.record(commands, film, self.size, self.crop(), look);
            commands.copy((self.post.display(), 0), (&self.picture, 0), bytes);
            commands.copy((self.post.exposure(), 0), (&self.exposure, 0), STATE_BYTES);
            Ok(())
        })?;
        let factor = pod_read_unaligned(&self.exposure.read()[..4]);
        Ok((self.picture.read()[..bytes as usize].to_vec(), factor))
    }

    /// Bytes that the sums take on the device.
    pub fn bytes(&self) -> u64 {
        Film::bytes(1, 1) * self.film.pixels()
    }
}
