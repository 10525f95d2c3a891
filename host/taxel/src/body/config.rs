//! The body as its author writes it.

use super::form::Form;
use super::solid::Solid;
use serde::{Deserialize, Serialize};

/// Places of a garment's panels.
#[derive(Debug, Default, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// One patch for each panel that lies on the robot; others have no place.
    pub patches: Vec<Patch>,
    /// Named parts of the surface.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub regions: Vec<BodyRegion>,
}

/// A panel on a link.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Patch {
    /// Name of the panel.
    pub panel: String,
    /// Link that it lies on; the garment's own if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub link: Option<String>,
    /// Surface that it lies on.
    pub on: Form,
    /// Angle by which the panel is turned about its middle, clockwise as seen from outside, degrees.
    #[serde(default)]
    pub turn: f64,
    /// Offset of the panel from the place that `on` and `turn` state.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub offset: Option<PatchOffset>,
    /// Motion of the cloth over the skin with joints of the robot.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub slides: Vec<Slide>,
}

/// Offset of a panel from its place: turned about its middle, then shifted over the surface. The lists and grids of
/// measured points move as one rigid piece, in the plane that touches them at their middle.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PatchOffset {
    /// Shift to the right, as seen from outside, m.
    #[serde(default)]
    pub right: f64,
    /// Shift in the direction that the surface calls down, m; of measured points, that of their rows.
    #[serde(default)]
    pub down: f64,
    /// Turn about the panel's middle, clockwise as seen from outside, degrees.
    #[serde(default)]
    pub turn: f64,
}

impl PatchOffset {
    /// The turn in radians, counted from right to down.
    pub(super) fn radians(&self) -> f64 {
        self.turn.to_radians()
    }

    /// The shift, m: to the right and down.
    pub(super) fn shift(&self) -> glam::DVec2 {
        glam::DVec2::new(self.right, self.down)
    }
}

/// A way of a panel over the skin with a joint: with the joint at 0, the panel lies as its patch says. Metres
/// for each radian of the joint, or each metre of one that slides.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Slide {
    /// Name of the joint.
    pub joint: String,
    /// Way to the right, as seen from outside.
    #[serde(default)]
    pub right: f64,
    /// Way in the direction that the surface calls down: `down` or `axis`.
    #[serde(default)]
    pub down: f64,
}

/// A named part of the surface: the taxels of a link whose centres lie in a solid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyRegion {
    /// Name of the region: left forearm, outer.
    pub name: String,
    /// Link of the robot.
    pub link: String,
    /// The solid, in the link's frame.
    pub within: Solid,
}
