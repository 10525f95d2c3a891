//! The JSON messages about a garment on a robot. The docs of the fields are the descriptions in
//! `view/page/messages.d.ts`.

use serde::Serialize;
use std::collections::BTreeMap;
#[cfg(feature = "schema")]
use taxel::json::schema::TypeIs;

/// Places of the taxels on the robot.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("body")))]
#[serde(tag = "type", rename = "body")]
pub struct BodyLine<'a> {
    /// Name of the body.
    pub name: &'a str,
    /// The links: all of a robot, each after its parent; without a robot those that taxels lie on.
    pub links: Vec<BodyLink<'a>>,
    /// Number of the link, place (m) and direction away from the robot of each taxel, in the frame of the link;
    /// null for a taxel without a place.
    pub taxels: Vec<Option<OnLink>>,
}

/// Number of a link, place and direction in its frame.
pub type OnLink = (usize, [f64; 3], [f64; 3]);

/// A link.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BodyLink<'a> {
    /// Name of the link.
    pub name: &'a str,
    /// Number of the link that it hangs on; null for the root, and without a robot.
    pub parent: Option<usize>,
}

/// Poses of the robot's links.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("poses")))]
#[serde(tag = "type", rename = "poses")]
pub struct PosesLine<'a> {
    /// Pose of each link in the frame of the root, by its name.
    pub links: BTreeMap<&'a str, PoseOfLink>,
}

/// A pose.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PoseOfLink {
    /// Origin, m.
    pub at_m: [f64; 3],
    /// Rotation: a quaternion x, y, z, w of length 1.
    pub turn: [f64; 4],
}

/// Figure of the robot.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("figure")))]
#[serde(tag = "type", rename = "figure")]
pub struct FigureLine<'a> {
    /// The links that have a shape.
    pub links: Vec<FigureLink<'a>>,
}

/// The shape of a link as triangles.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FigureLink<'a> {
    /// Name of the link.
    pub name: &'a str,
    /// Corners in the frame of the link, m.
    pub points: Vec<[f64; 3]>,
    /// Triangles: numbers of their corners, counter-clockwise as seen from outside.
    pub triangles: &'a [[usize; 3]],
}
