//! The host's time in a JSON message.

use serde::Serialize;

/// The host's time of what a message reports.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct HostTimes {
    /// The host's time, us since 1970.
    pub host_time_us: u64,
    /// Bound of its error, us; absent before the board has answered a `Sync`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub host_time_uncertainty_us: Option<u64>,
}

/// A message and, behind it, the host's time.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct HostTimed<L> {
    /// The message.
    #[serde(flatten)]
    pub line: L,
    /// The time.
    #[serde(flatten)]
    pub times: HostTimes,
}
