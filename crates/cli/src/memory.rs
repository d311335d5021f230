//! How much memory a picture will take, and how much there is: said before the work starts, not after an hour of it.

use crate::exit::{Code, Failure};
use lumbre::core::Film;
use std::fs;

/// Bytes that the planes of an output take while it is put together, per pixel.
pub(crate) const PNG_BYTES_PER_PIXEL: u64 = 12 + 3;
/// As above: 15 planes of floats, once as such and once as the file's rows.
pub(crate) const EXR_BYTES_PER_PIXEL: u64 = 2 * 15 * 4;

/// Fails with code 71 if the film of this size and `per_pixel` bytes more for the output exceed what is available or `limit`.
pub(crate) fn check(size: [u32; 2], per_pixel: u64, limit: Option<u64>) -> Result<(), Failure> {
    let [width, height] = size;
    let need = Film::bytes(width, height) + u64::from(width) * u64::from(height) * per_pixel;
    let there_is = |bytes: u64, what: &str| {
        let message = format!(
            "a picture of {width}x{height} pixels takes {} of memory, {what} {}",
            human(need),
            human(bytes)
        );
        if need > bytes { Err(Failure::new(Code::Memory, message)) } else { Ok(()) }
    };
    limit.map_or(Ok(()), |l| there_is(l, "--memory-limit is"))?;
    available().map_or(Ok(()), |a| there_is(a, "and there is"))
}

/// Bytes that can still be taken; `None` where the system does not say.
fn available() -> Option<u64> {
    let system = fs::read_to_string("/proc/meminfo").ok().and_then(|t| mem_available(&t));
    system.into_iter().chain(cgroup_room()).min()
}

/// `MemAvailable` of Linux's /proc/meminfo, bytes.
fn mem_available(meminfo: &str) -> Option<u64> {
    let line = meminfo.lines().find_map(|l| l.strip_prefix("MemAvailable:"))?;
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
        assert_eq!(mem_available(text), Some(8_000_000 * 1024));
        assert_eq!(mem_available("MemTotal: 5 kB\n"), None);
        assert_eq!(mem_available("MemAvailable: many kB\n"), None);
    }

    #[test]
    fn the_largest_picture_does_not_overflow_and_a_limit_holds() {
        let e = check([32_768, 32_768], EXR_BYTES_PER_PIXEL, Some(1 << 30)).unwrap_err();
        assert_eq!(e.code, Code::Memory);
        assert!(e.message.ends_with("--memory-limit is 1.0 GiB"), "{}", e.message);
        assert!(check([16, 16], PNG_BYTES_PER_PIXEL, Some(1 << 20)).is_ok());
        assert!(check([16, 16], PNG_BYTES_PER_PIXEL, Some(1 << 10)).is_err());
    }
}
