//! A wall around other people's decoders. They are meant to return errors, but some damaged files make them panic (an EXR
//! with wrong B44 blocks, for one); here that becomes an error as well.

use crate::IoError;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

thread_local! {
    static RUNNING: Cell<bool> = const { Cell::new(false) };
}

/// Whether this thread is inside a foreign decoder, so that a panic is the file's fault and becomes an error. A panic hook
/// asks this to keep silent.
pub fn decoder_is_running() -> bool {
    RUNNING.get()
}

/// Runs a decoder on this thread. What it has half built is dropped if it panics, so that nothing broken is seen later.
/// It must not hand work to threads of its own: a panic there may end the process.
pub(crate) fn decode<T>(path: &Path, decoder: impl FnOnce() -> Result<T, IoError>) -> Result<T, IoError> {
    let outer = RUNNING.replace(true);
    let result = catch_unwind(AssertUnwindSafe(decoder));
    RUNNING.set(outer);
    result.unwrap_or_else(|_| Err(IoError::data(path, "", "it is damaged (its decoder gave up)")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_an_error() {
        let e = decode::<()>(Path::new("a.exr"), || {
            assert!(decoder_is_running());
            panic!("index out of bounds")
        })
        .unwrap_err();
        assert!(!decoder_is_running());
        assert_eq!(e.to_string(), "a.exr: it is damaged (its decoder gave up)");
        assert_eq!(decode(Path::new("a.exr"), || Ok(3)).unwrap(), 3);
    }
}
