//! Recognised gestures and shapes, and how sure they are.

#[cfg(feature = "schema")]
use crate::json::schema::TypeIs;
use serde::Serialize;

/// A recognised gesture.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("gesture")))]
#[serde(tag = "type", rename = "gesture")]
pub struct GestureLine<'a> {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan, us of the board.
    pub time_us: u64,
    /// Number of the touch, from 1.
    pub touch: u32,
    /// Name of the touched panel.
    pub panel: &'a str,
    /// Name of the gesture.
    pub name: &'a str,
    /// Score of the gesture: 1 for what the model was fitted to, -1 for all else.
    pub score: f64,
    /// Lead over the score of the second gesture.
    pub lead: f64,
    /// Time for which the touch was observed, ms.
    pub observed_ms: u32,
    /// True if the touch is over: the result is for all of it.
    pub ended: bool,
    /// Share of touches of that age and lead that are of that gesture, 0 to 1; absent if the model gives
    /// none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub confidence: Option<f64>,
}

/// The base of shapes in force.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("shapes")))]
#[serde(tag = "type", rename = "shapes")]
pub struct ShapesLine<'a> {
    /// Names of the taught shapes; empty while the built-in base is in force.
    pub classes: &'a [String],
    /// Number of prototypes.
    pub prototypes: u16,
}
