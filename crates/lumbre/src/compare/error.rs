//! Why two pictures could not be compared.

/// Why two pictures could not be compared.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CompareError {
    /// The pictures differ in size, given as (width, height).
    #[error("the reference is {}x{} pixels, the other picture {}x{}", reference.0, reference.1, test.0, test.1)]
    SizeMismatch {
        /// Size of the reference.
        reference: (usize, usize),
        /// Size of the picture under test.
        test: (usize, usize),
    },
    /// A picture without pixels.
    #[error("a picture of {width}x{height} has no pixels")]
    Empty {
        /// Pixels per row.
        width: usize,
        /// Number of rows.
        height: usize,
    },
    /// The slice does not hold one element per pixel.
    #[error("a picture of {width}x{height} was given {pixels} pixels")]
    PixelCount {
        /// Pixels per row.
        width: usize,
        /// Number of rows.
        height: usize,
        /// Length of the slice.
        pixels: usize,
    },
    /// No pixel is finite in both pictures.
    #[error("no pixel is finite in both pictures")]
    NothingFinite,
    /// The viewing distance makes no sense.
    #[error("{0} pixels per degree: expected a finite number from 1 to 1000")]
    PixelsPerDegree(String),
}
