//! A row of the table: what a case costs, and how far off its contacts are.

use crate::board::{Answer, STAGES};
use crate::twin::Told;
use serde_json::{Value, json};
use taxel::bench::case::{Case, Variant};
use taxel::bench::error::{Error, Truth};
use taxel_core::pipeline::Stage;

/// What a case costs.
#[derive(Debug, Clone)]
pub struct Row {
    /// The scene.
    pub name: &'static str,
    /// How the chain differs from what ships.
    pub variant: Variant,
    /// Mean cycles a frame, by stage.
    pub stages: [u64; STAGES],
    /// Cycles of the dearest frame, without the map.
    pub largest: u64,
    /// Mean bytes on the wire a frame.
    pub bytes: u64,
    /// Bytes of stack that were used at most up to here.
    pub stack: u64,
    /// Contacts in the last frame, and how many could not be followed.
    pub contacts: [u64; 2],
    /// How far off place and NMI are, where the truth is known.
    pub error: Option<[Error; 2]>,
}

impl Row {
    /// From the measured frames of a case.
    pub fn of(case: &Case, answers: &[Answer], told: &[Told]) -> Row {
        let frames = answers.len() as u64;
        let mean = |stage: usize| answers.iter().map(|a| a.cycles[stage]).sum::<u64>() / frames;
        let whole = |a: &Answer| a.cycles.iter().sum::<u64>() - a.cycles[Stage::Intent as usize];
        let mut truth = Truth::default();
        if let Some(pattern) = case.pattern {
            let frames = told.iter().enumerate().filter(|(_, told)| !told.contacts.is_empty());
            frames.for_each(|(n, told)| truth.compare(pattern, Case::number(n), &told.contacts));
        }
        let last = told.last();
        let present = |t: &Told| t.contacts.iter().filter(|c| c.contact.total > 0).count() as u64;
        Row {
            name: case.name,
            variant: case.variant,
            stages: std::array::from_fn(mean),
            largest: answers.iter().map(whole).max().unwrap_or(0),
            bytes: answers.iter().map(|a| u64::from(a.said.bytes)).sum::<u64>() / frames,
            stack: answers.last().map_or(0, |a| a.stack),
            contacts: [last.map_or(0, present), last.map_or(0, |t| t.dropped.into())],
            error: truth.errors(),
        }
    }

    /// Cycles of a stage.
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

    /// For other programs.
    pub fn json(&self) -> Value {
        let error = |which: usize| self.error.as_ref().map(|errors| errors[which].json());
        json!({
            "scene": self.name, "variant": self.variant.name(), "condition": self.stage(Stage::Condition),
            "contact": self.stage(Stage::Contact), "shape": self.stage(Stage::Shape),
            "symbol": self.stage(Stage::Symbol), "map": self.stage(Stage::Intent), "react": self.stage(Stage::React),
            "encode": self.stage(Stage::Encode), "rest": self.stage(Stage::Idle), "perceive": self.perceive(),
            "all": self.whole(), "largest": self.largest, "wire_bytes": self.bytes, "stack_bytes": self.stack,
            "contacts": self.contacts[0], "dropped": self.contacts[1],
            "centroid_taxel": error(0), "nmi_relative": error(1),
        })
    }
}
