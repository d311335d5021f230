//! A wall around other people's decoders. They are meant to return errors, but some damaged files make them panic (an EXR
//! with wrong B44 blocks, for one); here that becomes an error as well.

use crate::IoError;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

/// Runs a decoder on this thread. What it has half built is dropped if it panics, so that nothing broken is seen later.
/// It must not hand work to threads of its own: a panic there may end the process.
pub(crate) fn decode<T>(path: &Path, decoder: impl FnOnce() -> Result<T, IoError>) -> Result<T, IoError> {
    catch_unwind(AssertUnwindSafe(decoder))
        .unwrap_or_else(|_| Err(IoError::data(path, "", "it is damaged (its decoder gave up)")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_an_error() {
        let e = decode::<()>(Path::new("a.exr"), || panic!("index out of bounds")).unwrap_err();
        assert_eq!(e.to_string(), "a.exr: it is damaged (its decoder gave up)");
        assert_eq!(decode(Path::new("a.exr"), || Ok(3)).unwrap(), 3);
    }
}
