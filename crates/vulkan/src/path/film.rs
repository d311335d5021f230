//! The film on the device: exact sums of its pixels, and the list of samples that were not finite.

use crate::{Buffer, Commands, Gpu, Purpose, VulkanError};
use lumbre_core::film::{Film, PixelSums};
use lumbre_shaders::film::{NON_FINITE_BYTES, non_finite};

/// Sums of a film, and samples that were not finite.
pub(crate) struct FilmOnGpu {
    pixels: u64,
    sums: Buffer,
    non_finite: Buffer,
    /// As large as the sums and the list.
    readback: Buffer,
}

impl FilmOnGpu {
    /// Room for a film of so many pixels.
    ///
    /// # Errors
    /// If memory is out.
    pub(crate) fn new(gpu: &Gpu, pixels: u64) -> Result<Self, VulkanError> {
        let sums = pixels * size_of::<PixelSums>() as u64;
        let list = NON_FINITE_BYTES as u64;
        Ok(FilmOnGpu {
            pixels,
            sums: Buffer::new(gpu, "film", sums, Purpose::Data)?,
            non_finite: Buffer::new(gpu, "samples that are not finite", list, Purpose::Data)?,
            readback: Buffer::new(gpu, "film on the host", sums + list, Purpose::Readback)?,
        })
    }

    /// Pixels that it has room for.
    pub(crate) fn pixels(&self) -> u64 {
        self.pixels
    }

    /// Addresses of sums and list.
    pub(crate) fn addresses(&self) -> [u64; 2] {
        [self.sums.address(), self.non_finite.address()]
    }

    /// Makes it an empty film.
    ///
    /// # Errors
    /// If the device is lost.
    pub(crate) fn empty(&self, gpu: &Gpu) -> Result<(), VulkanError> {
        gpu.run("clearing the film", |commands| {
            commands.fill(&self.sums, 0);
            commands.fill(&self.non_finite, 0);
            Ok(())
        })
    }

    /// Before a frame that writes all sums: forgets samples that were not finite.
    pub(crate) fn begin(&self, commands: &Commands<'_>) {
        commands.fill(&self.non_finite, 0);
    }

    /// Adds what it holds to a film of as many pixels.
    ///
    /// # Errors
    /// If the device is lost; the film is then as it was.
    pub(crate) fn read(&self, gpu: &Gpu, film: &mut Film) -> Result<(), VulkanError> {
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
