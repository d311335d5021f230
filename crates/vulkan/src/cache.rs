//! What drivers remember of pipelines, kept on disk: making one again then takes a tenth of the time.
//!
//! A cache is never needed: a missing, foreign or damaged file, or a folder that cannot be written, is no cache and no error. All scenes on
//! a device share one, so that what one has made the next finds, and none writes over what another has learned.

use crate::gpu::{Gpu, Shared, lock};
use ash::vk;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// Bytes of the header that Vulkan defines: its length, version, vendor, device, and the UUID of driver and device.
const HEADER: usize = 32;
/// A larger file is none of ours.
const MOST: u64 = 256 << 20;

/// A pipeline cache.
pub struct PipelineCache {
    gpu: Gpu,
    /// `None`: the device's.
    own: Option<Kept>,
}

/// A cache and its file.
pub(crate) struct Kept {
    raw: vk::PipelineCache,
    path: Option<PathBuf>,
    was_there: bool,
    /// What the file holds, as far as is known; locked while it is written.
    written: Mutex<Vec<u8>>,
}

impl PipelineCache {
    /// The cache of this device, in the user's folder for caches; the same for all that ask.
    pub fn open(gpu: &Gpu) -> Self {
        PipelineCache { gpu: gpu.clone(), own: None }
    }

    /// One of its own, in another folder; `None`: in memory only.
    pub fn open_in(gpu: &Gpu, folder: Option<&Path>) -> Self {
        PipelineCache { gpu: gpu.clone(), own: Some(Kept::open(&gpu.0, folder)) }
    }

    fn kept(&self) -> &Kept {
        let users = || folder(|name| std::env::var_os(name).map(PathBuf::from));
        let shared = || self.gpu.0.cache.get_or_init(|| Kept::open(&self.gpu.0, users().as_deref()));
        self.own.as_ref().unwrap_or_else(shared)
    }

    pub(crate) fn raw(&self) -> vk::PipelineCache {
        self.kept().raw
    }

    /// Whether there was something on disk.
    pub fn was_there(&self) -> bool {
        self.kept().was_there
    }

    /// Writes it to disk if it has changed; to be called when pipelines were made. Whether there is now a file as it should be.
    pub fn save(&self) -> bool {
        let kept = self.kept();
        let Some(path) = kept.path.as_deref().filter(|_| kept.raw != vk::PipelineCache::null()) else {
            return false;
        };
        let mut written = lock(&kept.written);
        // SAFETY: a live device and cache.
        let content = unsafe { self.gpu.0.raw.get_pipeline_cache_data(kept.raw) }.unwrap_or_default();
        if content == *written {
            return true;
        }
        let done = write(path, &content).is_ok();
        if done {
            *written = content;
        }
        done
    }
}

impl Kept {
    fn open(gpu: &Shared, folder: Option<&Path>) -> Self {
        let path = folder.map(|f| f.join(file_name(gpu)));
        let loaded = path.as_deref().and_then(read).filter(|content| fits(gpu, content)).unwrap_or_default();
        let make = |content: &[u8]| {
            let create = vk::PipelineCacheCreateInfo::default().initial_data(content);
            // SAFETY: a live device; the content has this device's header and is as it was written.
            unsafe { gpu.raw.create_pipeline_cache(&create, None) }
        };
        // A null cache is none.
        let raw = make(&loaded).or_else(|_| make(&[])).unwrap_or_default();
        Kept { raw, path, was_there: !loaded.is_empty(), written: Mutex::new(loaded) }
    }

    /// # Safety
    /// No pipeline is being made with it.
    pub(crate) unsafe fn destroy(&self, device: &ash::Device) {
        // SAFETY: by the caller; pipelines do not need it once they are made; null is ignored.
        unsafe { device.destroy_pipeline_cache(self.raw, None) };
    }
}

impl Drop for PipelineCache {
    fn drop(&mut self) {
        if let Some(own) = &self.own {
            // SAFETY: nobody else has it.
            unsafe { own.destroy(&self.gpu.0.raw) };
        }
    }
}

/// The user's folder for caches, by the environment.
fn folder(variable: impl Fn(&str) -> Option<PathBuf>) -> Option<PathBuf> {
    let named = |name| variable(name).filter(|p| p.is_absolute());
    let caches = if cfg!(windows) {
        named("LOCALAPPDATA")
    } else {
        named("XDG_CACHE_HOME").or_else(|| named("HOME").map(|home| home.join(".cache")))
    };
    caches.map(|c| c.join("lumbre"))
}

/// A file for each device and driver.
fn file_name(gpu: &Shared) -> String {
    let limits = &gpu.limits;
    let uuid: String = limits.pipeline_cache_uuid.iter().map(|b| format!("{b:02x}")).collect();
    format!("pipelines-{:04x}-{:04x}-{uuid}.bin", limits.vendor, limits.device)
}

/// Whether the header names this device and driver.
fn fits(gpu: &Shared, content: &[u8]) -> bool {
    let limits = &gpu.limits;
    let word = |i: usize| u32::from_le_bytes([content[i], content[i + 1], content[i + 2], content[i + 3]]);
    content.len() >= HEADER
        && word(0) as usize >= HEADER
        && word(4) == vk::PipelineCacheHeaderVersion::ONE.as_raw() as u32
        && word(8) == limits.vendor
        && word(12) == limits.device
        && content[16..32] == limits.pipeline_cache_uuid
}

/// A hash that tells a damaged file: not all drivers look (Fowler, Noll, Vo: FNV-1a).
fn checksum(content: &[u8]) -> [u8; 8] {
    let step = |hash: u64, &byte: &u8| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
    content.iter().fold(0xcbf2_9ce4_8422_2325, step).to_le_bytes()
}

/// The content of a file that is as it was written.
fn read(path: &Path) -> Option<Vec<u8>> {
    let kind = fs::metadata(path).ok()?;
    if !kind.is_file() || kind.len() > MOST {
        return None;
    }
    let mut content = fs::read(path).ok()?;
    let sum = content.split_off(content.len().checked_sub(8)?);
    (sum == checksum(&content)).then_some(content)
}

/// Replaces the file in one step, so that a reader never finds half of it.
fn write(path: &Path, content: &[u8]) -> std::io::Result<()> {
    fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
    let temporary = path.with_extension(format!("{}.tmp", std::process::id()));
    let fill = || {
        let mut file = fs::File::create(&temporary)?;
        file.write_all(content)?;
        file.write_all(&checksum(content))?;
        fs::rename(&temporary, path)
    };
    fill().inspect_err(|_| drop(fs::remove_file(&temporary)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::{gpu, silent};

    #[test]
    fn the_folder_is_where_users_expect_it() {
        let folder = |set: &[(&str, &str)]| {
            let find = |name: &str| set.iter().find(|v| v.0 == name).map(|v| PathBuf::from(v.1));
            folder(find)
        };
        if cfg!(windows) {
            assert_eq!(folder(&[("LOCALAPPDATA", "C:\\a")]), Some(PathBuf::from("C:\\a\\lumbre")));
        } else {
            let both = [("XDG_CACHE_HOME", "/x"), ("HOME", "/home/a")];
            assert_eq!(folder(&both), Some(PathBuf::from("/x/lumbre")));
            assert_eq!(folder(&both[1..]), Some(PathBuf::from("/home/a/.cache/lumbre")));
            assert_eq!(folder(&[("XDG_CACHE_HOME", "relative")]), None);
        }
        assert_eq!(folder(&[]), None);
    }

    #[test]
    fn only_what_was_written_is_read() {
        let Some(gpu) = gpu() else { return };
        let folder = std::env::temp_dir().join(format!("lumbre-cache-{}", std::process::id()));
        let open = || PipelineCache::open_in(&gpu, Some(&folder));
        let first = open();
        assert!(!first.was_there() && first.save());
        assert!(open().was_there());
        // Cut short, one bit off, another device's, empty: none of them is a cache.
        let path = first.kept().path.clone().unwrap();
        let good = fs::read(&path).unwrap();
        let mut damaged = good.clone();
        damaged[HEADER - 1] ^= 1;
        let mut foreign = good[..good.len() - 8].to_vec();
        foreign[20] ^= 1;
        foreign.extend(checksum(&foreign));
        for bad in [&good[..good.len() - 1], &damaged, &foreign, &[]] {
            fs::write(&path, bad).unwrap();
            assert!(!open().was_there());
        }
        fs::write(&path, &good).unwrap();
        assert!(open().was_there());
        // A folder that is a file cannot be written, which is no error.
        let within = PipelineCache::open_in(&gpu, Some(&path));
        assert!(!within.was_there() && !within.save());
        assert!(!PipelineCache::open_in(&gpu, None).save());
        // All that ask for the device's get the same one.
        let [one, other] = [(); 2].map(|()| PipelineCache::open(&gpu));
        assert_eq!(one.raw(), other.raw());
        assert_ne!(one.raw(), first.raw());
        fs::remove_dir_all(&folder).unwrap();
        silent(&gpu);
    }
}
