//! A row of the table: cost of a case, and errors of its contacts.

use super::case::{Case, Step, Variant};
use super::error::{Error, Truth};
use super::twin::{STAGES, StepResult};
use serde_json::{Value, json};
use taxel_core::pipeline::Stage;

/// Cost of a step by stage, and its stack, if known.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Cost {
    /// Cycles or nanoseconds.
    pub stages: [u64; STAGES],
    /// Stack below the caller's frame, bytes.
    pub stack: Option<u64>,
}

impl Cost {
    /// Everything except for the map.
    fn whole(&self) -> u64 {
        self.stages.iter().sum::<u64>() - self.stages[Stage::Intent as usize]
    }
}

/// Cost of a case.
#[derive(Debug, Clone)]
pub struct Row {
    /// Scene.
    pub name: &'static str,
    /// Variant of the chain.
    pub variant: Variant,
    /// Mean cost of a frame, by stage.
    stages: [u64; STAGES],
    /// Cost of the most expensive frame, without the map.
    pub largest: u64,
    /// Mean bytes on the wire per frame.
    pub bytes: u64,
    /// Largest use of stack, bytes.
    pub stack: Option<u64>,
    /// Contacts in the last frame, and contacts dropped.
    pub contacts: [u64; 2],
    /// Errors of place and NMI, if the truth is known.
    pub error: Option<[Error; 2]>,
}

impl Row {
    /// Row from the steps of a case, of whose scans the last are the measured frames: what the host sends
    /// between them is none.
    pub fn of(case: &Case, steps: &[Step], costs: &[Cost], results: &[StepResult]) -> Row {
        let scans =
            steps.iter().zip(costs.iter().zip(results)).filter(|(step, _)| matches!(step, Step::Scan(_)));
        let (costs, results): (Vec<&Cost>, Vec<&StepResult>) = scans.map(|(_, done)| done).unzip();
        let costs = costs.get(costs.len().saturating_sub(case.measured())..).unwrap_or(&[]);
        let results = results.get(results.len().saturating_sub(case.measured())..).unwrap_or(&[]);
        let frames = costs.len().max(1) as u64;
        let mut truth = Truth::default();
        if let Some(pattern) = case.pattern {
            let frames = results.iter().enumerate().filter(|(_, results)| !results.contacts.is_empty());
            frames.for_each(|(n, results)| truth.compare(pattern, Case::number(n), &results.contacts));
        }
        let last = results.last();
        let present = |t: &&StepResult| t.contacts.iter().filter(|c| c.contact.total > 0).count() as u64;
        Row {
            name: case.name,
            variant: case.variant,
            stages: std::array::from_fn(|stage| costs.iter().map(|c| c.stages[stage]).sum::<u64>() / frames),
            largest: costs.iter().map(|cost| cost.whole()).max().unwrap_or(0),
            bytes: results.iter().map(|t| u64::from(t.said.bytes)).sum::<u64>() / frames,
            stack: costs.iter().filter_map(|c| c.stack).max(),
            contacts: [last.map_or(0, present), last.map_or(0, |t| t.dropped.into())],
            error: truth.errors(),
        }
    }

    /// Cost of a stage.
    pub const fn stage(&self, stage: Stage) -> u64 {
        self.stages[stage as usize]
    }

    /// From condition to reaction, without the map.
    pub fn perceive(&self) -> u64 {
        let stages = [Stage::Condition, Stage::Contact, Stage::Shape, Stage::Symbol, Stage::React];
        stages.into_iter().map(|stage| self.stage(stage)).sum()
    }

    /// Everything after the scan, without the map.
    pub fn whole(&self) -> u64 {
        self.perceive() + self.stage(Stage::Idle) + self.stage(Stage::Encode)
    }

    /// JSON form.
    pub fn json(&self) -> Value {
        let error = |which: usize| self.error.as_ref().map(|errors| errors[which].json());
        json!({
            "scene": self.name,
            "variant": self.variant.name(),
            "condition": self.stage(Stage::Condition),
            "contact": self.stage(Stage::Contact),
            "shape": self.stage(Stage::Shape),
            "symbol": self.stage(Stage::Symbol),
            "react": self.stage(Stage::React),
            "encode": self.stage(Stage::Encode),
            "rest": self.stage(Stage::Idle),
            "perceive": self.perceive(),
            "all": self.whole(),
            "largest": self.largest,
            "map": self.stage(Stage::Intent),
            "wire_bytes": self.bytes,
            "stack_bytes": self.stack,
            "contacts": self.contacts[0],
            "dropped": self.contacts[1],
            "centroid_taxel": error(0),
            "nmi_relative": error(1),
        })
    }
}
