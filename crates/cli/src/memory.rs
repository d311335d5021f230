//! How much memory a picture will take, and how much there is: said before the work starts, not after an hour of it.

use crate::exit::{Code, Failure};
use lumbre::Estimator;
use lumbre::core::Film;
use lumbre::scene::CompiledScene;
use std::fs;

/// Bytes that the planes of an EXR take while it is put together, per pixel: 16 planes of floats, once as such and once as the
/// file's rows.
pub(crate) const EXR_BYTES_PER_PIXEL: u64 = 2 * 16 * 4;

/// What a picture takes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Picture {
    /// Of what is rendered.
    pub(crate) size: [u32; 2],
    /// While the most demanding output is put together.
    pub(crate) output_per_pixel: u64,
    /// Copies of the film that are there at a time.
    pub(crate) films: u64,
}

impl Picture {
    fn bytes(&self) -> u64 {
        let [width, height] = self.size;
        let pixels = u64::from(width) * u64::from(height);
        self.films * Film::bytes(width, height) + Estimator::bytes(pixels) + pixels * self.output_per_pixel
    }

    fn name(&self) -> String {
        format!("a picture of {}x{} pixels", self.size[0], self.size[1])
    }

    /// Fails with code 71 if film, error estimate and outputs exceed what is available or `limit`.
    pub(crate) fn check(&self, limit: Option<u64>) -> Result<(), Failure> {
        fits(self.bytes(), self.bytes(), &self.name(), limit)
    }

    /// The same for all that there will be once the scene, which is in memory by now, is built; `on_gpu`: not in this memory.
    pub(crate) fn check_with(
        &self,
        scene: &CompiledScene,
        on_gpu: bool,
        limit: Option<u64>,
    ) -> Result<(), Failure> {
        let building = if on_gpu { 0 } else { triangles(scene) * BUILD_BYTES_PER_TRIANGLE };
        let what = format!(
            "{} with this scene ({} of it, {} to build it)",
            self.name(),
            human(scene.bytes()),
            human(building)
        );
        let more = self.bytes() + building;
        fits(more + scene.bytes(), more, &what, limit)
    }
}

/// Bytes per triangle that building the acceleration structure takes at its peak, with the 50 or so that the structure keeps;
/// measured: 270 on a mesh of two million triangles.
const BUILD_BYTES_PER_TRIANGLE: u64 = 300;

/// Triangles that are built into trees: those of a mesh once, however often it is placed.
fn triangles(scene: &CompiledScene) -> u64 {
    scene.triangles.len() as u64
}

/// `all` against the limit that the user set, `more` against what the system has left.
fn fits(all: u64, more: u64, what: &str, limit: Option<u64>) -> Result<(), Failure> {
    let too_much = |need: u64, bytes: u64, whose: &str| {
        Failure::new(
            Code::Memory,
            format!("{what} takes {} of memory, {whose} {}", human(need), human(bytes)),
        )
    };
    match (limit, available()) {
        (Some(limit), _) if all > limit => Err(too_much(all, limit, "--memory-limit is")),
        (_, Some(there_is)) if more > there_is => Err(too_much(more, there_is, "and there is")),
        _ => Ok(()),
    }
}

/// Bytes that can still be taken; `None` where the system does not say. Linux says in files; macOS and Windows only through calls into
/// C, which this program does without: there `--memory-limit` is the guard.
pub(crate) fn available() -> Option<u64> {
    let system = fs::read_to_string("/proc/meminfo").ok().and_then(|t| kilobytes(&t, "MemAvailable:"));
    system.into_iter().chain(cgroup_room()).min()
}

/// The most that this process has held, bytes; `None` where the system does not say (as above).
pub(crate) fn peak() -> Option<u64> {
    of_process("VmHWM:")
}

/// What this process holds, bytes; `None` where the system does not say (as above).
pub(crate) fn held() -> Option<u64> {
    of_process("VmRSS:")
}

fn of_process(name: &str) -> Option<u64> {
    fs::read_to_string("/proc/self/status").ok().and_then(|t| kilobytes(&t, name))
}

/// A line of Linux's /proc/meminfo and its kin, bytes.
fn kilobytes(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|l| l.strip_prefix(name))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}

/// What a container's limit (cgroup v2, or v1) leaves, bytes.
fn cgroup_room() -> Option<u64> {
    let number = |path: &str| fs::read_to_string(path).ok()?.trim().parse::<u64>().ok();
    let room = |limit: &str, used: &str| Some(number(limit)?.saturating_sub(number(used)?));
    room("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current").or_else(|| {
        room("/sys/fs/cgroup/memory/memory.limit_in_bytes", "/sys/fs/cgroup/memory/memory.usage_in_bytes")
    })
}

/// A number of bytes for people.
pub(crate) fn human(bytes: u64) -> String {
    let b = bytes as f64;
    match bytes {
        0..1_048_576 => format!("{:.1} KiB", b / 1024.0),
        1_048_576..1_073_741_824 => format!("{:.1} MiB", b / 1_048_576.0),
        _ => format!("{:.1} GiB", b / 1_073_741_824.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meminfo_is_read() {
        let text = "MemTotal:       16000000 kB\nMemFree: 5 kB\nMemAvailable:    8000000 kB\n";
        assert_eq!(kilobytes(text, "MemAvailable:"), Some(8_000_000 * 1024));
        assert_eq!(kilobytes("MemTotal: 5 kB\n", "MemAvailable:"), None);
        assert_eq!(kilobytes("MemAvailable: many kB\n", "MemAvailable:"), None);
    }

    #[test]
    fn the_largest_picture_does_not_overflow_and_a_limit_holds() {
        let picture = |side, films| Picture { size: [side; 2], output_per_pixel: EXR_BYTES_PER_PIXEL, films };
        let e = picture(32_768, 2).check(Some(1 << 30)).unwrap_err();
        assert_eq!(e.code, Code::Memory);
        assert!(e.message.ends_with("--memory-limit is 1.0 GiB"), "{}", e.message);
        assert!(picture(16, 1).check(Some(1 << 20)).is_ok());
        assert!(picture(16, 1).check(Some(1 << 10)).is_err());
        assert!(picture(16, 2).bytes() > picture(16, 1).bytes());
    }

    #[test]
    fn the_scene_counts_against_the_limit() {
        use lumbre::core::math::Vec3;
        use lumbre::scene::{Mesh, Node, Primitive, Scene};
        let mut scene = Scene::default();
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
        let triangle = Primitive { positions, indices: vec![0, 1, 2], ..Primitive::default() };
        let mesh = Some(scene.add_mesh(Mesh { name: "one".into(), primitives: vec![triangle] }));
        scene.add_root(Node { mesh, ..Node::default() });
        let scene = lumbre::compile(&scene).unwrap().scene;
        assert_eq!(triangles(&scene), 1);
        let picture = Picture { size: [16, 16], output_per_pixel: 0, films: 1 };
        let all = picture.bytes() + scene.bytes() + triangles(&scene) * BUILD_BYTES_PER_TRIANGLE;
        assert!(picture.check_with(&scene, false, Some(all)).is_ok());
        let e = picture.check_with(&scene, false, Some(all - 1)).unwrap_err();
        assert!(picture.check_with(&scene, true, Some(all - 1)).is_ok(), "a GPU builds in its own memory");
        assert!(e.message.contains("with this scene"), "{}", e.message);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn linux_says_what_there_is() {
        assert!(available().is_some_and(|a| a > 1 << 20) && peak().is_some_and(|p| p > 1 << 20));
    }
}
