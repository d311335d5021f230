//! Pictures measured against a reference: RMSE, relMSE, PSNR, LDR-FLIP and HDR-FLIP, and a FLIP map as a picture.
//!
//! All of them take linear Rec. 709 pixels, row 0 on top, reference first. They say how many pixels are not finite and
//! leave those out (`NonFinite`) instead of letting one of them spoil the figure. Nothing here opens a file.
//!
//! The functions measure pictures and do not shape them, so they call std's `powf` and kin; figures may differ between
//! machines in the last bits.

mod error;
mod flip;
mod magma;
mod simple;

pub use error::CompareError;
pub use flip::{Exposures, FlipMap, PIXELS_PER_DEGREE, flip_hdr, flip_ldr};
pub use magma::magma;
pub use simple::{psnr, rel_mse, rmse};

use lumbre_core::Rgb;

/// A borrowed picture: linear Rec. 709 pixels, row by row, row 0 on top.
#[derive(Clone, Copy, Debug)]
pub struct ImageView<'a> {
    width: usize,
    height: usize,
    pixels: &'a [Rgb],
}

impl<'a> ImageView<'a> {
    /// A view of `width * height` pixels.
    ///
    /// # Errors
    /// `CompareError::Empty` when a side is 0, `CompareError::PixelCount` when `pixels` has another length.
    pub fn new(width: usize, height: usize, pixels: &'a [Rgb]) -> Result<Self, CompareError> {
        if width == 0 || height == 0 {
            return Err(CompareError::Empty { width, height });
        }
        if width.checked_mul(height) != Some(pixels.len()) {
            return Err(CompareError::PixelCount { width, height, pixels: pixels.len() });
        }
        Ok(ImageView { width, height, pixels })
    }

    /// The same for pixels kept as arrays `[r, g, b]`.
    ///
    /// # Errors
    /// As `new`.
    pub fn from_arrays(width: usize, height: usize, pixels: &'a [[f32; 3]]) -> Result<Self, CompareError> {
        Self::new(width, height, bytemuck::cast_slice(pixels))
    }

    /// Pixels per row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Number of rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// All pixels, row by row from the top.
    pub fn pixels(&self) -> &'a [Rgb] {
        self.pixels
    }
}

/// How many pixels have a component that is NaN or infinite.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NonFinite {
    /// In the reference.
    pub reference: usize,
    /// In the picture under test.
    pub test: usize,
    /// In at least one of the two: the number of pixels that were left out.
    pub either: usize,
}

/// One figure for a pair of pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Score {
    /// The figure, over the pixels that are finite in both pictures.
    pub value: f64,
    /// The pixels that were left out.
    pub nonfinite: NonFinite,
}

/// Checks that two pictures can be compared and counts the pixels that cannot.
fn check_pair(reference: ImageView, test: ImageView) -> Result<NonFinite, CompareError> {
    if (reference.width, reference.height) != (test.width, test.height) {
        return Err(CompareError::SizeMismatch {
            reference: (reference.width, reference.height),
            test: (test.width, test.height),
        });
    }
    let mut count = NonFinite::default();
    for (r, t) in reference.pixels.iter().zip(test.pixels) {
        count.reference += usize::from(!r.is_finite());
        count.test += usize::from(!t.is_finite());
        count.either += usize::from(!r.is_finite() || !t.is_finite());
    }
    if count.either == reference.pixels.len() {
        return Err(CompareError::NothingFinite);
    }
    Ok(count)
}
