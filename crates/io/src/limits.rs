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
    /// Objects in a scene's JSON, of all kinds together: a few bytes of text become some hundred in memory.
    pub max_json_objects: u64,
    /// Lists and objects of a scene's JSON inside one another. The parser itself ends at [`Limits::JSON_DEPTH_BOUND`].
    pub max_json_depth: u64,
    /// Bytes of all buffers of a scene, and of all its encoded images.
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
    /// Meshes that the nodes place in the world.
    pub max_instances: u64,
    /// Nodes beneath one another.
    pub max_node_depth: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Limits {
            max_file_bytes: 8 << 30,
            max_json_bytes: 256 << 20,
            max_json_objects: 4 << 20,
            max_json_depth: 64,
            max_buffer_bytes: 16 << 30,
            max_image_side: 32_768,
            max_image_bytes: 4 << 30,
            max_total_image_bytes: 16 << 30,
            max_triangles: 500_000_000,
            max_vertices: 500_000_000,
            max_zero_filled: 1 << 20,
            max_instances: 16 << 20,
            max_node_depth: 1 << 20,
        }
    }
}

/// One of the fields of [`Limits`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Bound {
    /// [`Limits::max_file_bytes`].
    FileBytes,
    /// [`Limits::max_json_bytes`].
    JsonBytes,
    /// [`Limits::max_json_objects`].
    JsonObjects,
    /// [`Limits::max_json_depth`].
    JsonDepth,
    /// [`Limits::max_buffer_bytes`].
    BufferBytes,
    /// [`Limits::max_image_side`].
    ImageSide,
    /// [`Limits::max_image_bytes`].
    ImageBytes,
    /// [`Limits::max_total_image_bytes`].
    TotalImageBytes,
    /// [`Limits::max_triangles`].
    Triangles,
    /// [`Limits::max_vertices`].
    Vertices,
    /// [`Limits::max_zero_filled`].
    ZeroFilled,
    /// [`Limits::max_instances`].
    Instances,
    /// [`Limits::max_node_depth`].
    NodeDepth,
}

impl Bound {
    /// All of them.
    pub const ALL: [Bound; 13] = [
        Bound::FileBytes,
        Bound::JsonBytes,
        Bound::JsonObjects,
        Bound::JsonDepth,
        Bound::BufferBytes,
        Bound::ImageSide,
        Bound::ImageBytes,
        Bound::TotalImageBytes,
        Bound::Triangles,
        Bound::Vertices,
        Bound::ZeroFilled,
        Bound::Instances,
        Bound::NodeDepth,
    ];

    /// The name of the field, and what it counts.
    fn names(self) -> (&'static str, &'static str) {
        match self {
            Bound::FileBytes => ("max_file_bytes", "file size"),
            Bound::JsonBytes => ("max_json_bytes", "JSON size"),
            Bound::JsonObjects => ("max_json_objects", "number of JSON objects"),
            Bound::JsonDepth => ("max_json_depth", "depth of the JSON"),
            Bound::BufferBytes => ("max_buffer_bytes", "size of all buffers"),
            Bound::ImageSide => ("max_image_side", "image side"),
            Bound::ImageBytes => ("max_image_bytes", "decoded image size"),
            Bound::TotalImageBytes => ("max_total_image_bytes", "decoded size of all images"),
            Bound::Triangles => ("max_triangles", "number of triangles"),
            Bound::Vertices => ("max_vertices", "number of vertices"),
            Bound::ZeroFilled => ("max_zero_filled", "number of elements without data"),
            Bound::Instances => ("max_instances", "number of instances"),
            Bound::NodeDepth => ("max_node_depth", "depth of the nodes"),
        }
    }

    /// The name of the field of [`Limits`] that holds it.
    pub fn field(self) -> &'static str {
        self.names().0
    }

    /// What it counts, for messages.
    pub fn what(self) -> &'static str {
        self.names().1
    }
}

/// What is left of a limit while something is added up.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Room {
    bound: Bound,
    used: u64,
    limit: u64,
}

impl From<u64> for Room {
    /// So many bytes for one file.
    fn from(limit: u64) -> Self {
        Room { bound: Bound::FileBytes, used: 0, limit }
    }
}

impl Room {
    /// How much still fits.
    pub(crate) fn left(self) -> u64 {
        self.limit - self.used.min(self.limit)
    }

    /// The narrower of the two.
    pub(crate) fn min(self, other: Room) -> Room {
        if other.left() < self.left() { other } else { self }
    }

    /// An error if `more` does not fit.
    pub(crate) fn check(self, path: &Path, place: &str, more: u64) -> Result<(), IoError> {
        let (value, limit) = (self.used.saturating_add(more), self.limit);
        if value <= limit {
            return Ok(());
        }
        Err(IoError::Limit { path: path.into(), place: place.into(), bound: self.bound, value, limit })
    }

    /// Takes `more` of it, or fails and takes nothing.
    pub(crate) fn take(&mut self, path: &Path, place: &str, more: u64) -> Result<(), IoError> {
        self.check(path, place, more)?;
        self.used += more;
        Ok(())
    }
}

impl Limits {
    /// The deepest nesting that the JSON parser follows, whatever `max_json_depth` says.
    pub const JSON_DEPTH_BOUND: u64 = 127;

    /// The value of a limit.
    pub fn of(&self, bound: Bound) -> u64 {
        match bound {
            Bound::FileBytes => self.max_file_bytes,
            Bound::JsonBytes => self.max_json_bytes,
            Bound::JsonObjects => self.max_json_objects,
            Bound::JsonDepth => self.max_json_depth,
            Bound::BufferBytes => self.max_buffer_bytes,
            Bound::ImageSide => self.max_image_side.into(),
            Bound::ImageBytes => self.max_image_bytes,
            Bound::TotalImageBytes => self.max_total_image_bytes,
            Bound::Triangles => self.max_triangles,
            Bound::Vertices => self.max_vertices,
            Bound::ZeroFilled => self.max_zero_filled,
            Bound::Instances => self.max_instances,
            Bound::NodeDepth => self.max_node_depth,
        }
    }

    /// All of a limit, before anything is added up.
    pub(crate) fn room(&self, bound: Bound) -> Room {
        Room { bound, used: 0, limit: self.of(bound) }
    }

    /// An error if `value` exceeds the limit.
    pub(crate) fn hold(&self, bound: Bound, path: &Path, place: &str, value: u64) -> Result<(), IoError> {
        self.room(bound).check(path, place, value)
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
        self.hold(Bound::ImageSide, path, "", width.max(height))?;
        let bytes = width.saturating_mul(height).saturating_mul(bytes_per_pixel);
        self.hold(Bound::ImageBytes, path, "", bytes)
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
        assert_eq!(e.bound().map(Bound::field), Some("max_image_bytes"));
    }

    #[test]
    fn room_runs_out_and_says_of_what() {
        let limits = Limits { max_buffer_bytes: 100, max_file_bytes: 70, ..Limits::default() };
        let p = Path::new("a.gltf");
        let mut room = limits.room(Bound::BufferBytes);
        room.take(p, "", 60).unwrap();
        let e = room.take(p, "/buffers/1", 41).unwrap_err();
        assert_eq!(e.to_string(), "a.gltf: /buffers/1: size of all buffers 101 exceeds the limit of 100");
        assert!(room.check(p, "", u64::MAX).is_err());
        assert_eq!(room.left(), 40);
        assert_eq!(room.min(limits.room(Bound::FileBytes)).bound, Bound::BufferBytes);
        assert_eq!(limits.room(Bound::BufferBytes).min(70.into()).bound, Bound::FileBytes);
        room.take(p, "", 40).unwrap();
        assert_eq!(room.left(), 0);
    }
}
