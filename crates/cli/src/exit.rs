//! How a command ends: the codes (after BSD's sysexits.h where it has a fitting one) and the failures that carry them.

use crate::flags::loading::flag_of;
use lumbre::compare::CompareError;
use lumbre::io::{ErrorKind, IoError};
use lumbre::scene::CompileError;
use lumbre::{DeviceError, RenderError};
use std::fmt::Display;
use std::process::ExitCode;

/// Exit codes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Code {
    /// All is done.
    Done = 0,
    /// `compare --fail-above`: the pictures differ by more.
    Different = 1,
    /// The command line makes no sense.
    Usage = 2,
    /// A file was read, and what it holds is wrong or not supported.
    BadData = 65,
    /// A file cannot be opened.
    CannotOpen = 66,
    /// A GPU was asked for and cannot be had, or failed; a picture that has begun is written as far as it came.
    Unavailable = 69,
    /// A bug of this program.
    Bug = 70,
    /// Too little memory, seen before the work began.
    Memory = 71,
    /// An output cannot be written.
    CannotWrite = 74,
    /// Stopped by Ctrl-C; the picture so far is written.
    Interrupted = 75,
    /// Stopped by Ctrl-C; nothing is written (128 + SIGINT, as shells say).
    Killed = 130,
}

impl From<Code> for ExitCode {
    fn from(code: Code) -> ExitCode {
        ExitCode::from(code as u8)
    }
}

/// A command that cannot go on: the code, and one line that says why.
#[derive(Debug)]
pub(crate) struct Failure {
    pub(crate) code: Code,
    pub(crate) message: String,
}

impl Failure {
    pub(crate) fn new(code: Code, message: impl Display) -> Self {
        Failure { code, message: message.to_string() }
    }
    pub(crate) fn usage(message: impl Display) -> Self {
        Self::new(Code::Usage, message)
    }
}

impl From<IoError> for Failure {
    fn from(e: IoError) -> Self {
        let code = match e.kind() {
            ErrorKind::BadData => Code::BadData,
            ErrorKind::BadChoice => Code::Usage,
            ErrorKind::CannotOpen => Code::CannotOpen,
            ErrorKind::CannotWrite => Code::CannotWrite,
        };
        match e.bound() {
            Some(bound) => Self::new(code, format_args!("{e}; {} widens it", flag_of(bound))),
            None => Self::new(code, e),
        }
    }
}

impl From<DeviceError> for Failure {
    fn from(e: DeviceError) -> Self {
        match e {
            DeviceError::SimdLevel(_) => Self::usage(e),
            DeviceError::Unavailable { .. } => Self::new(Code::Unavailable, e),
        }
    }
}

impl From<RenderError> for Failure {
    fn from(e: RenderError) -> Self {
        Self::new(Code::Unavailable, e)
    }
}

impl From<CompileError> for Failure {
    fn from(e: CompileError) -> Self {
        Self::new(Code::BadData, e)
    }
}

impl From<CompareError> for Failure {
    fn from(e: CompareError) -> Self {
        Self::new(Code::BadData, e)
    }
}
