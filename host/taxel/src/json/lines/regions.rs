//! Touch state of the regions of the robot's surface.

#[cfg(feature = "schema")]
use crate::json::schema::TypeIs;
use serde::Serialize;
use taxel_core::surface::{BodyDirection, RegionPhase};
use taxel_core::symbol::{Extent, Strength};

/// Touch state of each region of the robot's surface: when one of them changes, and once a second.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("regions")))]
#[serde(tag = "type", rename = "regions")]
pub struct RegionsLine<'a> {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan, us of the board.
    pub time_us: u64,
    /// All regions, in the order of the body.
    pub regions: Vec<SurfaceRegionLine<'a>>,
}

/// Touch state of a region of the surface.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SurfaceRegionLine<'a> {
    /// Name of the region.
    pub region: &'a str,
    /// `free`; `onset` for the first 150 ms of a touch; `held`; `moving`; `released` for 0.5 s.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub phase: RegionPhase,
    /// Direction in which the touch moves: `forward`, `back`, `left`, `right`, `up`, `down` or `none`; x is forward,
    /// y to the left and z up, in the frame of the poses or, without a pose, of the link.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub way: BodyDirection,
    /// Number of contacts in it.
    pub contacts: u8,
    /// `faint`, `light`, `firm` or `hard`: of the contact that presses most, or that pressed last.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub strength: Strength,
    /// `point`, `patch`, `wide` or `sharp`.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub extent: Extent,
    /// Name of the shape, or `unknown`.
    pub shape: String,
    /// Time since which the region is in its phase, us of the board.
    pub since_us: u64,
}
