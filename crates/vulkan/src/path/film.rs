//! The film on the device: exact sums of its pixels, to which ray generation adds, and what else it tells.

use crate::{Buffer, Commands, Gpu, Purpose, VulkanError};
use lumbre_core::film::{Film, PixelSums};
use lumbre_shaders::film::{NON_FINITE_BYTES, non_finite};
use lumbre_shaders::view::RAY_COUNTERS;

/// Bytes of the counters of rays.
const COUNTER_BYTES: u64 = 2 * RAY_COUNTERS as u64 * 4;

/// Sums of a film, samples that were not finite, counters of rays.
pub(super) struct FilmOnGpu {
    pixels: u64,
    sums: Buffer,
    non_finite: Buffer,
    counters: Buffer,
    /// As large as the sums and the list.
    readback: Buffer,
}

/// Rays traced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Rays {
    /// Of paths.
    pub(super) path: u64,
    /// To lights.
    pub(super) shadow: u64,
}

/// Where the host reads the counters.
pub(super) struct CounterReadback(Buffer);

impl CounterReadback {
    pub(super) fn new(gpu: &Gpu) -> Result<Self, VulkanError> {
        Ok(CounterReadback(Buffer::new(gpu, "numbers of rays", COUNTER_BYTES, Purpose::Readback)?))
    }

    /// The rays of the submission that copied them here.
    pub(super) fn read(&self) -> Rays {
        let counters = self.0.read_as::<u32>();
        let sum = |part: &[u32]| part.iter().map(|&n| u64::from(n)).sum();
        let (path, shadow) = counters.split_at(RAY_COUNTERS);
        Rays { path: sum(path), shadow: sum(shadow) }
    }
}

impl FilmOnGpu {
    /// Room for a film of so many pixels.
    ///
    /// # Errors
    /// If memory is out.
    pub(super) fn new(gpu: &Gpu, pixels: u64) -> Result<Self, VulkanError> {
        let sums = pixels * size_of::<PixelSums>() as u64;
        let list = NON_FINITE_BYTES as u64;
        Ok(FilmOnGpu {
            pixels,
            sums: Buffer::new(gpu, "film", sums, Purpose::Data)?,
            non_finite: Buffer::new(gpu, "samples that are not finite", list, Purpose::Data)?,
            counters: Buffer::new(gpu, "counters of rays", COUNTER_BYTES, Purpose::Data)?,
            readback: Buffer::new(gpu, "film on the host", sums + list, Purpose::Readback)?,
        })
    }

    /// Pixels that it has room for.
    pub(super) fn pixels(&self) -> u64 {
        self.pixels
    }

    /// Addresses of sums, list and counters.
    pub(super) fn addresses(&self) -> [u64; 3] {
        [self.sums.address(), self.non_finite.address(), self.counters.address()]
    }

    /// Makes it an empty film.
    pub(super) fn clear(&self, commands: &Commands<'_>) {
        commands.fill(&self.sums, 0);
        commands.fill(&self.non_finite, 0);
    }

    /// Sets the counters to zero.
    pub(super) fn clear_counters(&self, commands: &Commands<'_>) {
        commands.fill(&self.counters, 0);
    }

    /// Brings the counters to the host.
    pub(super) fn copy_counters(&self, commands: &Commands<'_>, to: &CounterReadback) {
        commands.copy((&self.counters, 0), (&to.0, 0), COUNTER_BYTES);
    }

    /// Adds what it holds to a film of as many pixels.
    ///
    /// # Errors
    /// If the device is lost; the film is then as it was.
    pub(super) fn read(&self, gpu: &Gpu, film: &mut Film) -> Result<(), VulkanError> {
        let sums = film.pixels().len() as u64 * size_of::<PixelSums>() as u64;
        let list = NON_FINITE_BYTES as u64;
        gpu.run("reading the film", |commands| {
            commands.copy((&self.sums, 0), (&self.readback, 0), sums);
            commands.copy((&self.non_finite, 0), (&self.readback, sums), list);
            Ok(())
        })?;
        let bytes = self.readback.read();
        let (pixels, rest) = bytes.split_at(sums as usize);
        match bytemuck::try_cast_slice(pixels) {
            Ok(pixels) => merge(film, pixels),
            // Memory of a driver that aligns it to less than the sums ask for.
            Err(_) => merge(film, &collected::<PixelSums>(pixels)),
        }
        let words = collected::<u32>(&rest[..NON_FINITE_BYTES]);
        let (count, some) = non_finite(&words);
        film.merge_non_finite(count.into(), some);
        Ok(())
    }
}

fn collected<T: bytemuck::Pod>(bytes: &[u8]) -> Vec<T> {
    bytes.chunks_exact(size_of::<T>()).map(bytemuck::pod_read_unaligned).collect()
}

/// Adds sums to a film, on several threads: one would take longer than the device for the samples.
fn merge(film: &mut Film, sums: &[PixelSums]) {
    let threads = std::thread::available_parallelism().map_or(1, usize::from).min(16);
    std::thread::scope(|scope| {
        for task in film.merge_tasks(sums, threads) {
            scope.spawn(|| task.run());
        }
    });
}
