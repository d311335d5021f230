//! The interactive window.
#![forbid(unsafe_code)]
