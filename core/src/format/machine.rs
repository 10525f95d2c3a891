//! The two kinds of machines for which the core has forms of its own.

/// True on a machine with SIMD that multiplies and divides 64 bits: a form with few branches is the fastest
/// there. False on a Cortex-M0+, where a form of few instructions is.
pub(crate) const WIDE: bool = cfg!(target_pointer_width = "64");
