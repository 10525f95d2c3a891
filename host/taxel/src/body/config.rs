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
}
