//! The SIMD levels of the traversal, and what each of them supplies: a box test on the eight children of a node and a
//! filter on the triangles of a packet. All else is shared.

#[cfg(target_arch = "x86_64")]
pub(in crate::bvh) mod avx2;
#[cfg(target_arch = "x86_64")]
pub(in crate::bvh) mod avx512;
pub(in crate::bvh) mod portable;

use super::collapse::WIDTH;
use super::ray::TravRay;
use super::triangle::{Packet, Sheared};
use super::wide::WideNode;
use std::fmt;

/// Entry distances of the children of a node.
#[derive(Clone, Copy)]
#[repr(C, align(32))]
pub(in crate::bvh) struct Near(pub [f32; WIDTH]);

/// The kernels of one level. Only functions compiled for the level's instructions may call them; the ones for x86 are
/// inlined there, and safe because [`SimdLevel::is_supported`] was checked when the level was chosen.
pub(in crate::bvh) trait Simd {
    /// The ray as this level wants it, with values repeated over the lanes.
    type Ray;

    /// # Safety
    /// The processor must support the level; so for all functions here.
    unsafe fn ray(ray: &TravRay) -> Self::Ray;

    /// Children whose boxes the ray may enter at a distance in `[t_min, t_best]`, and these distances.
    ///
    /// # Safety
    /// See [`Simd::ray`].
    unsafe fn boxes(node: &WideNode, ray: &Self::Ray, t_best: f32, near: &mut Near) -> u32;

    /// As [`super::triangle::filter`].
    ///
    /// # Safety
    /// See [`Simd::ray`].
    unsafe fn triangles(packet: &Packet, ray: &Self::Ray, t_best: f32, sheared: &mut Sheared) -> u32;
}

/// Asks for the three cache lines at `p`, most of a node or a packet: children are known long before they are visited.
#[inline(always)]
pub(in crate::bvh) fn prefetch(p: *const u8) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: a prefetch may be given any address; SSE is part of x86-64.
        unsafe {
            _mm_prefetch::<_MM_HINT_T0>(p.cast());
            _mm_prefetch::<_MM_HINT_T0>(p.wrapping_add(64).cast());
            _mm_prefetch::<_MM_HINT_T0>(p.wrapping_add(128).cast());
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = p;
}

/// Which instructions the traversal uses. The hits are the same bits at every level.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum SimdLevel {
    /// Plain Rust, on any processor.
    Portable,
    /// AVX2 and FMA.
    Avx2,
    /// AVX-512 F, VL, DQ and BW.
    Avx512,
}

/// `LUMBRE_SIMD` holds none of the known names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownSimdLevel(pub String);

impl fmt::Display for UnknownSimdLevel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: unknown level {:?}, expected portable, avx2 or avx512", SimdLevel::VARIABLE, self.0)
    }
}

impl std::error::Error for UnknownSimdLevel {}

impl SimdLevel {
    /// All levels, lowest first.
    pub const ALL: [SimdLevel; 3] = [SimdLevel::Portable, SimdLevel::Avx2, SimdLevel::Avx512];
    /// The environment variable that may lower the level.
    pub const VARIABLE: &str = "LUMBRE_SIMD";

    /// The best level of this processor, or a lower one if the environment variable `LUMBRE_SIMD` (`portable`, `avx2` or
    /// `avx512`) asks for it. Any other value is an error.
    pub fn detect() -> Result<SimdLevel, UnknownSimdLevel> {
        match std::env::var_os(Self::VARIABLE) {
            None => Ok(Self::best()),
            Some(value) => {
                let value = value.to_string_lossy();
                Self::parse(&value).map(|l| l.min(Self::best())).ok_or(UnknownSimdLevel(value.into_owned()))
            }
        }
    }

    /// The best level of this processor.
    pub fn best() -> SimdLevel {
        Self::ALL.into_iter().rev().find(|l| l.is_supported()).unwrap_or(SimdLevel::Portable)
    }

    /// Its name in `LUMBRE_SIMD`.
    pub fn name(self) -> &'static str {
        match self {
            SimdLevel::Portable => "portable",
            SimdLevel::Avx2 => "avx2",
            SimdLevel::Avx512 => "avx512",
        }
    }

    /// The level of that name.
    pub fn parse(name: &str) -> Option<SimdLevel> {
        Self::ALL.into_iter().find(|l| l.name() == name)
    }

    /// Whether this processor has the instructions.
    pub fn is_supported(self) -> bool {
        match self {
            SimdLevel::Portable => true,
            #[cfg(target_arch = "x86_64")]
            SimdLevel::Avx2 => is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma"),
            #[cfg(target_arch = "x86_64")]
            SimdLevel::Avx512 => {
                SimdLevel::Avx2.is_supported()
                    && is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512vl")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512bw")
            }
            #[cfg(not(target_arch = "x86_64"))]
            _ => false,
        }
    }
}
