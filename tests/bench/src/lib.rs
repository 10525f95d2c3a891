//! Speed against error, as a text table, as JSON and as a chart: what `cargo xtask bench` prints.
#![forbid(unsafe_code)]

pub mod acquisition;
pub mod amplifier;
pub mod boards;
pub mod chart;
pub mod mind;
pub mod nmi;
mod outline;
pub mod record;
pub mod stages;
pub mod tap;
mod touch;

use chart::Chart;
use serde_json::Value;

/// A finished table in its forms.
#[derive(Debug, Clone)]
pub struct Report {
    /// Readable form.
    pub text: String,
    /// JSON form: `{"columns": ..., "rows": [...]}`
    pub json: Value,
    /// Chart of error over cost.
    pub chart: Chart,
}
