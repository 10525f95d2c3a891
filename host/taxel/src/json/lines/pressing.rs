//! Contacts and forces on the robot.

#[cfg(feature = "schema")]
use crate::json::schema::TypeIs;
use serde::Serialize;

/// Contacts and forces on the robot.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("pressing")))]
#[serde(tag = "type", rename = "pressing")]
pub struct PressingLine<'a> {
    /// Number of the scan.
    pub frame: u32,
    /// Start of the scan, us of the board.
    pub time_us: u64,
    /// Time of the poses in force, us of the board: of links that stand still, when it received them. Null
    /// without poses.
    pub posed_us: Option<u64>,
    /// Time from there to the start of the scan, us; below 0 if the poses came after it. Null without poses.
    pub pose_age_us: Option<i64>,
    /// The most by which a place in the frame of the poses is off, m, because joints are not known exactly and
    /// move on: by what the host that sends the poses knows of the joints. Null if it does not say it.
    pub pose_error_m: Option<f64>,
    /// The contacts that have a place.
    pub contacts: Vec<LandedLine<'a>>,
    /// The links that something presses on.
    pub links: Vec<WrenchLine<'a>>,
    /// Basis of the forces in newtons: `calibrated`, `nominal` or `simulated`; absent if they are unknown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_basis: Option<&'static str>,
}

/// A contact on the robot.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LandedLine<'a> {
    /// Id of the contact.
    pub id: u32,
    /// Name of the link.
    pub link: &'a str,
    /// Place in the frame of the link.
    #[serde(flatten)]
    pub own: PushLine,
    /// Place in the frame of the poses; null without a pose of the link.
    pub base: Option<PushLine>,
    /// Uncertainty by saturated and faulty taxels; null if there is none.
    pub uncertain: Option<UncertainLine>,
}

/// Uncertainty of a force and its place by saturated and faulty taxels.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct UncertainLine {
    /// Number of saturated taxels: with one or more, the force is the least that it may be.
    pub saturated: u16,
    /// Number of faulty taxels under the contact, or at its edge.
    pub faulty: u16,
    /// The most by which the faulty ones press less than is counted for them, counts.
    pub less_counts: u32,
    /// The most by which they press more, counts.
    pub more_counts: u32,
    /// The most by which they move the centre of pressure, m.
    pub off_m: f64,
}

/// A force at a place.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PushLine {
    /// Place, m.
    pub at_m: [f64; 3],
    /// Direction away from the robot.
    pub normal: [f64; 3],
    /// Force, counts.
    pub force_counts: [i32; 3],
    /// Force, N; absent if it is unknown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_n: Option<[f64; 3]>,
}

/// Force and moment on a link, in its frame.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WrenchLine<'a> {
    /// Name of the link.
    pub link: &'a str,
    /// Sum of the taxels' forces along their normals, counts.
    pub force_counts: [i32; 3],
    /// Their moment about the link's origin, counts times m.
    pub moment_counts_m: [f64; 3],
    /// Sum of their magnitudes, counts.
    pub pressed_counts: u32,
    /// The force, N; absent if it is unknown, as are the two below.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_n: Option<[f64; 3]>,
    /// The moment, N m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moment_nm: Option<[f64; 3]>,
    /// The sum of the magnitudes, N.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressed_n: Option<f64>,
    /// Centre of pressure, m.
    pub center_m: [f64; 3],
    /// Uncertainty by saturated and faulty taxels; null if there is none.
    pub uncertain: Option<UncertainLine>,
}
