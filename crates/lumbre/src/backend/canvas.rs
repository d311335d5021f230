//! Sums of a picture that people look at while it grows.

use super::{Backend, RenderError};
use crate::look::Look;
use lumbre_core::Film;
use lumbre_core::control::{Control, Progress};
use lumbre_core::settings::View;
use std::ops::Range;

/// Sums of samples, kept where the device has them, so that a frame costs no more than what is shown of it.
pub trait Canvas {
    /// Forgets all samples, and gets ready for a picture of this size.
    ///
    /// # Errors
    /// If the device fails or has no room for it.
    fn clear(&mut self, size: [u32; 2]) -> Result<(), RenderError>;

    /// Adds the samples of a range to every pixel: [`Backend::render`]. Fewer samples than that were done if it was cancelled; the
    /// picture is then uneven, and fit for nothing but [`clear`](Self::clear).
    ///
    /// # Errors
    /// If the device fails.
    fn add(
        &mut self,
        view: &View,
        samples: Range<u32>,
        control: &dyn Control,
    ) -> Result<Progress, RenderError>;

    /// The sums.
    ///
    /// # Errors
    /// If the device fails.
    fn film(&mut self) -> Result<&Film, RenderError>;

    /// What the device itself makes of them for a display; `None`: it is left to those who read [`film`](Self::film). Automatic exposure
    /// is multiplied by `offset` and goes `ease` (0 to 1) of the way from the last picture's to this one's.
    ///
    /// # Errors
    /// If the device fails.
    fn develop(&mut self, _look: &Look, _offset: f32, _ease: f32) -> Result<Option<Developed>, RenderError> {
        Ok(None)
    }

    /// Bytes that the sums take.
    fn bytes(&self) -> u64;
}

/// A picture for a display.
#[derive(Clone, Debug)]
pub struct Developed {
    /// Red, green, blue, alpha of each pixel, sRGB, not multiplied by alpha; row 0 on top.
    pub rgba: Vec<u8>,
    /// The factor of its exposure.
    pub factor: f32,
}

/// Sums in the program's own memory, for any backend.
pub(super) struct HostCanvas<'a, B: ?Sized> {
    backend: &'a B,
    film: Film,
}

impl<'a, B: Backend + ?Sized> HostCanvas<'a, B> {
    pub(super) fn new(backend: &'a B) -> Self {
        HostCanvas { backend, film: Film::new(0, 0) }
    }
}

impl<B: Backend + ?Sized> Canvas for HostCanvas<'_, B> {
    fn clear(&mut self, size: [u32; 2]) -> Result<(), RenderError> {
        self.film = Film::new(size[0], size[1]);
        Ok(())
    }

    fn add(
        &mut self,
        view: &View,
        samples: Range<u32>,
        control: &dyn Control,
    ) -> Result<Progress, RenderError> {
        self.backend.render(view, samples, &mut self.film, control)
    }

    fn film(&mut self) -> Result<&Film, RenderError> {
        Ok(&self.film)
    }

    fn bytes(&self) -> u64 {
        Film::bytes(self.film.width(), self.film.height())
    }
}
