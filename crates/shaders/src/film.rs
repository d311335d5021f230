//! What shaders write of a film beside its sums, which are `lumbre_core::film::PixelSums`: the list of samples that were not finite.
//! Twin: `NonFiniteList` of `glsl/film.glsl`.

use lumbre_core::film::NonFinite;

/// Most samples that a list names; all are counted. A list is read and emptied between dispatches.
pub const NON_FINITE_ROOM: usize = 4096;

/// Bytes of a list: its count, then its entries. An empty list is all zero.
pub const NON_FINITE_BYTES: usize = size_of::<u32>() + NON_FINITE_ROOM * size_of::<NonFinite>();

/// What a list holds: how many samples were not finite, and those of them that it names, in no order.
///
/// # Panics
/// If it has not [`NON_FINITE_BYTES`].
pub fn non_finite(list: &[u32]) -> (u32, &[NonFinite]) {
    assert_eq!(size_of_val(list), NON_FINITE_BYTES, "bytes of a list");
    let (count, entries) = (list[0], bytemuck::cast_slice(&list[1..]));
    (count, &entries[..NON_FINITE_ROOM.min(count as usize)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_is_read_as_far_as_it_goes() {
        let mut list = vec![0u32; NON_FINITE_BYTES / 4];
        assert_eq!(non_finite(&list), (0, &[][..]));
        list[..7].copy_from_slice(&[2, 5, 6, 7, 8, 9, 10]);
        let named = |row, column, sample| NonFinite { row_column: [row, column], sample };
        assert_eq!(non_finite(&list), (2, &[named(5, 6, 7), named(8, 9, 10)][..]));
        list[0] = 1_000_000;
        assert_eq!(non_finite(&list).1.len(), NON_FINITE_ROOM);
    }
}
