//! Presses by pages on the garment of a simulated board.

use super::lines::{HandLine, ScriptLine, ToolLine};
use super::message::{FINGERS, FingerRequest, HandOrder};
use anyhow::Result;
use taxel::files::scripts;
use taxel::sim::{self, TOOLS};
use taxel::source::{FingerPress, Hand};

/// The hand of a board, with the fingers of all its pages.
#[derive(Debug, Clone)]
pub struct PageHand {
    hand: Hand,
    /// State that pages were sent last.
    sent: Option<(Option<String>, usize)>,
}

impl PageHand {
    /// The hand of a board.
    pub fn new(hand: Hand) -> PageHand {
        PageHand { hand, sent: None }
    }

    /// Returns what pages are to be sent; none if nothing has changed.
    pub fn news(&mut self) -> Option<HandLine> {
        let now = (self.hand.playing(), self.hand.touches());
        if self.sent.as_ref() == Some(&now) {
            return None;
        }
        self.sent = Some(now.clone());
        let tool = |tool: sim::Tool| ToolLine {
            name: tool.name,
            size_mm: tool.size_mm,
            force_n: tool.force_n,
            most_n: tool.most_n,
        };
        let scripts = sim::list().into_iter().map(|info| ScriptLine { name: info.name, title: info.title });
        let (playing, touches) = now;
        Some(HandLine {
            tools: self.hand.tools().map(tool).collect(),
            scripts: scripts.collect(),
            playing,
            touches,
        })
    }

    /// Presses with a finger of a page, or moves it. An unknown tool or panel presses nothing.
    pub fn press(&self, page: u64, request: FingerRequest) {
        let Some(tool) = TOOLS.into_iter().find(|tool| tool.name == request.tool) else { return };
        let FingerRequest { finger, angle_deg, panel, at, force_n, .. } = request;
        let finger = number(page, finger);
        self.hand.press(FingerPress { finger, tool, angle_deg, panel: panel.into(), at, force_n });
    }

    /// Lifts a finger of a page.
    pub fn release(&self, page: u64, finger: u8) {
        self.hand.release(number(page, finger));
    }

    /// Lifts all fingers of a page.
    pub fn leave(&self, page: u64) {
        (0..FINGERS).for_each(|finger| self.release(page, finger));
    }

    /// Plays a shipped script. Error if it has no place on the garment.
    pub fn play(&self, name: &str) -> Result<()> {
        // No path: what a page asks for opens no file.
        match sim::shipped(name) {
            Some(script) => Ok(self.hand.play(script)?),
            None => Ok(()),
        }
    }

    /// Plays again, or forgets, what was pressed.
    pub fn order(&self, order: HandOrder) {
        match order {
            HandOrder::Again => self.hand.again(),
            HandOrder::Clear => self.hand.clear(),
        }
    }

    /// The script's file of what was pressed. Error for what TOML cannot hold.
    pub fn script(&self) -> Result<String> {
        Ok(scripts::text(&self.hand.script())?)
    }
}

/// Number of a finger among those of all pages.
fn number(page: u64, finger: u8) -> u64 {
    page * u64::from(FINGERS) + u64::from(finger)
}
