//! Images and how they are looked up.

use crate::ImageId;

/// Texels. The colour space is a matter of use: a material decodes base colour and emission from sRGB and reads all else as it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Name or path, for messages.
    pub name: String,
    /// Columns, at least 1.
    pub width: u32,
    /// Rows, at least 1; row 0 is the top, v = 0.
    pub height: u32,
    /// `width * height` texels of R, G, B, A.
    pub rgba8: Vec<u8>,
}

/// What lies outside 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Wrap {
    /// The image again.
    #[default]
    Repeat,
    /// The image again, mirrored.
    MirroredRepeat,
    /// The edge texel.
    ClampToEdge,
}

/// How texels are joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Filter {
    /// Bilinear.
    #[default]
    Linear,
    /// The texel that is hit.
    Nearest,
}

/// An image with a way to look it up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texture {
    /// The image.
    pub image: ImageId,
    /// Along u.
    pub wrap_s: Wrap,
    /// Along v.
    pub wrap_t: Wrap,
    /// Filter.
    pub filter: Filter,
}
