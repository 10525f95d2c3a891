//! A board's report of an intention, with the map that produced it.

use super::decimal::Decimal;
use super::map::MapFile;
use taxel_core::wire::IntentReport;

/// A report of an intention, and the map that produced it.
#[derive(Debug, Clone)]
pub struct ReportedIntent {
    /// The map of the board's scene.
    pub map: MapFile,
    /// The board's report.
    pub report: IntentReport,
    /// Time since the first frame of the stream.
    pub seconds: f64,
}

impl ReportedIntent {
    /// Concepts set by the touch or the host, with their activations.
    pub fn inputs(&self) -> Vec<(String, Decimal)> {
        let value = |at: usize| self.report.concepts.get(at).and_then(|v| Decimal::from_f64(v.to_f64()));
        let entries = self.map.entries().into_iter();
        entries.filter_map(|name| Some((name.to_string(), value(self.map.find(name)?)?))).collect()
    }

    /// Time of the report, and its inputs.
    pub fn text(&self) -> String {
        let inputs = self.inputs();
        let inputs = inputs.iter().map(|(name, value)| format!("{name}={:.4}", value.to_f64()));
        let inputs = inputs.collect::<Vec<_>>().join(" ");
        let (leading, frame) = (self.report.leading.as_str(), self.report.frame);
        format!("after {:.3} s, frame {frame}: {leading} leads; inputs {inputs}\n", self.seconds)
    }
}
