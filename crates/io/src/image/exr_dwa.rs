//! Checks the DWA chunks of an EXR before they are decoded: each begins with eleven counters (OpenEXR,
//! `internal_dwa_compressor.h`), and the `exr` crate allocates what they say without looking.

use ::exr::block::chunk::{Chunk, CompressedBlock};
use ::exr::compression::Compression;
use ::exr::error::{Error, Result};
use ::exr::meta::header::Header;
use std::io::Cursor;

/// Bytes of the counters.
const LEADER: usize = 11 * 8;

fn is_dwa(header: &Header) -> bool {
    matches!(header.compression, Compression::DWAA(_) | Compression::DWAB(_))
}

/// Fails if a DWA chunk of the file claims more than its pixels could need. The headers are already checked.
pub(super) fn check(bytes: &[u8], headers: &[Header]) -> Result<()> {
    if !headers.iter().any(is_dwa) {
        return Ok(());
    }
    // Through the same tables of offsets as the decoder, so that it will meet no other chunks.
    let chunks = ::exr::block::read(Cursor::new(bytes), false)?.filter_chunks(false, |_, _, _| true)?;
    for chunk in chunks {
        let Chunk { layer_index, compressed_block } = chunk?;
        let data = match &compressed_block {
            CompressedBlock::ScanLine(b) => &b.compressed_pixels_le,
            CompressedBlock::Tile(b) => &b.compressed_pixels_le,
            _ => return Err(Error::NotSupported("deep data".into())),
        };
        let header = headers.get(layer_index).ok_or(Error::Invalid("part of a chunk".into()))?;
        if !is_dwa(header) {
            continue;
        }
        let at = header.get_block_data_indices(&compressed_block)?;
        let size = header.get_absolute_block_pixel_coordinates(at)?.size;
        if !plausible(data, (size.0, size.1), header) {
            return Err(Error::Invalid("a DWA chunk claims more than its pixels".into()));
        }
    }
    Ok(())
}

/// No counter exceeds a generous bound: four bytes for every sample, each side rounded up to blocks of 8, twice over.
fn plausible(data: &[u8], (width, height): (usize, usize), header: &Header) -> bool {
    // Where compression does not help, a chunk holds plain pixels and no counters.
    if data.len() == width.saturating_mul(height).saturating_mul(header.channels.bytes_per_pixel) {
        return true;
    }
    // Shorter ones are refused by the decoder.
    let Some(leader) = data.get(..LEADER) else { return true };
    let side = |n: usize| (n as u64).next_multiple_of(8);
    let samples = side(width).saturating_mul(side(height)).saturating_mul(header.channels.list.len() as u64);
    let most = samples.saturating_mul(8).saturating_add(1 << 16);
    // The first counter is the version, the last one a choice.
    leader.as_chunks::<8>().0[1..10].iter().all(|b| u64::from_le_bytes(*b) <= most)
}
