//! Bounds on what files may ask for. Every size is checked against them before memory is taken for it.

use crate::IoError;
use std::path::Path;

/// Limits on untrusted input. The defaults let through any real scene that this machine class could draw.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of one file.
    pub max_file_bytes: u64,
    /// Bytes of a scene's JSON.
    pub max_json_bytes: u64,
    /// Bytes of all buffers of a scene.
    pub max_buffer_bytes: u64,
    /// Columns or rows of an image.
    pub max_image_side: u32,
    /// Bytes of one image once decoded.
    pub max_image_bytes: u64,
    /// Bytes of all images of a scene once decoded.
    pub max_total_image_bytes: u64,
    /// Triangles in the meshes of a scene, each mesh counted once.
    pub max_triangles: u64,
    /// Vertices in the meshes of a scene, each mesh counted once.
    pub max_vertices: u64,
    /// Elements of an accessor that has no data of its own (glTF fills it with zeros).
    pub max_zero_filled: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Limits {
            max_file_bytes: 8 << 30,
            max_json_bytes: 256 << 20,
            max_buffer_bytes: 16 << 30,
            max_image_side: 32_768,
            max_image_bytes: 4 << 30,
            max_total_image_bytes: 16 << 30,
            max_triangles: 500_000_000,
            max_vertices: 500_000_000,
            max_zero_filled: 1 << 20,
        }
    }
}

impl Limits {
    /// An error if `value` exceeds `limit`.
    pub(crate) fn check(
        path: &Path,
        place: &str,
        what: &'static str,
        value: u64,
        limit: u64,
    ) -> Result<(), IoError> {
        if value <= limit {
            return Ok(());
        }
        Err(IoError::Limit { path: path.into(), place: place.into(), what, value, limit })
    }

    /// Checks an image's size from its header; `bytes_per_pixel` is that of the decoded form.
    pub(crate) fn check_image(
        &self,
        path: &Path,
        (width, height): (u64, u64),
        bytes_per_pixel: u64,
    ) -> Result<(), IoError> {
        if width == 0 || height == 0 {
            return Err(IoError::data(path, "", format!("empty image of {width} x {height} pixels")));
        }
        Self::check(path, "", "image side", width.max(height), u64::from(self.max_image_side))?;
        let bytes = width.saturating_mul(height).saturating_mul(bytes_per_pixel);
        Self::check(path, "", "decoded image size", bytes, self.max_image_bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn image_sizes_are_checked_without_overflow() {
        let limits = Limits::default();
        let p = Path::new("a.png");
        assert!(limits.check_image(p, (4096, 4096), 4).is_ok());
        assert!(limits.check_image(p, (0, 7), 4).is_err());
        assert!(limits.check_image(p, (u64::MAX, u64::MAX), 16).is_err());
        let small = Limits { max_image_bytes: 100, ..Limits::default() };
        assert!(small.check_image(p, (5, 5), 4).is_ok());
        let e = small.check_image(p, (5, 6), 4).unwrap_err();
        assert_eq!(e.to_string(), "a.png: decoded image size 120 exceeds the limit of 100");
    }
}
