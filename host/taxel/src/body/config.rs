//! The body as its author writes it.

use super::form::Form;
use serde::{Deserialize, Serialize};

/// Where the panels of a garment lie.
#[derive(Debug, Default, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// One patch for each panel that lies on the robot; others have no place.
    pub patches: Vec<Patch>,
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
    /// How the cloth moves over the skin with joints of the robot.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub slides: Vec<Slide>,
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
