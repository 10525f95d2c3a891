//! Decides which touch to ask for next, until the garment is found or cannot be.

use super::ask::{Ask, Gesture, blocks_along, extent, stroke_across, strokes_down};
use super::assemble::{Stroke, assemble};
use super::bundle::Bundle;
use super::check::Places;
use super::reading::Reading;
use super::touch::Touch;
use anyhow::Result;
use taxel_core::garment::{Garment, Orientation};

/// Attempts for each touch.
const TRIES: u32 = 3;
/// Unanswered requests after which a panel counts as dead.
const SILENT: u32 = 2;

/// Reason why dead panels cannot be matched to inputs.
const LEFT_OVER: &str = "The numbers of silent inputs and of silent panels differ.";

/// Next step of the dialogue.
#[derive(Debug, Clone, PartialEq)]
pub enum Next {
    /// Ask for this touch.
    Ask(Ask),
    /// The garment is found.
    Found(Box<Found>),
    /// The garment cannot be determined, and why.
    NotSure(String),
}

/// A garment with its actual wiring.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// The garment.
    pub garment: Garment,
    /// Silent panels and inputs, by index and GPIO number, assumed to belong together.
    pub dead: Vec<(usize, u8)>,
    /// Margin of the least clear decision: 1 is ideal, 0 is undecided.
    pub margin: f64,
    /// Largest distance of a touch from the requested place, taxels.
    pub off: f64,
    /// Number of touches requested.
    pub touches: u32,
}

#[derive(Debug, Clone)]
struct Step {
    ask: Ask,
    tries: u32,
    silent: u32,
    touch: Option<Touch>,
    /// Reading of a stroke.
    reading: Option<Reading>,
    /// The panel is dead.
    skipped: bool,
}

impl Step {
    fn new(ask: Ask) -> Step {
        Step { ask, tries: 0, silent: 0, touch: None, reading: None, skipped: false }
    }

    fn is_open(&self) -> bool {
        self.touch.is_none() && !self.skipped
    }
}

/// Evidence so far.
#[derive(Debug, Clone)]
pub struct Solver {
    template: Garment,
    bundle: Bundle,
    steps: Vec<Step>,
    across: bool,
    given_up: Option<String>,
}

impl Solver {
    /// A solver for a garment with the template's panels and blocks, but unknown wires. Error if it cannot be
    /// set up by touch.
    pub fn new(template: &Garment) -> Result<Solver> {
        let bundle = Bundle::of(template)?;
        let steps = strokes_down(template).into_iter().map(Step::new).collect();
        Ok(Solver { template: template.clone(), bundle, steps, across: false, given_up: None })
    }

    /// The wires.
    pub fn bundle(&self) -> &Bundle {
        &self.bundle
    }

    /// Returns the next step; the same one until [`take`](Solver::take) is called.
    pub fn what_next(&mut self) -> Next {
        loop {
            if let Some(why) = &self.given_up {
                return Next::NotSure(why.clone());
            }
            if let Some(step) = self.steps.iter().find(|step| step.is_open()) {
                return Next::Ask(step.ask.clone());
            }
            if !self.across {
                self.ask_across();
                continue;
            }
            match self.conclude() {
                Ok(found) => return Next::Found(Box::new(found)),
                Err((Some(step), why)) => self.again(step, why),
                Err((None, why)) => self.given_up = Some(why),
            }
        }
    }

    /// Takes the touch felt after the last request, if any.
    pub fn take(&mut self, touch: Option<Touch>) {
        let Some(index) = self.steps.iter().position(Step::is_open) else { return };
        let Some(touch) = touch else { return self.silence(index) };
        self.steps[index].tries += 1;
        match self.read(&self.steps[index].ask, &touch) {
            Ok(reading) => {
                let step = &mut self.steps[index];
                (step.touch, step.reading) = (Some(touch), reading);
            }
            Err(why) => self.again(index, why),
        }
    }

    fn read(&self, ask: &Ask, touch: &Touch) -> Result<Option<Reading>, String> {
        let first =
            blocks_along(&self.template, ask).first().and_then(|index| self.template.blocks.get(*index));
        let (Some(panel), Some(block)) = (self.template.panels.get(ask.panel), first) else {
            return Ok(None);
        };
        let (width, height) = extent(block);
        let (taxels, length) = match ask.gesture {
            Gesture::Down { .. } => (panel.rows, height),
            Gesture::Across { .. } => (panel.columns, width),
            Gesture::Corner => return Ok(None),
        };
        Reading::of(&self.bundle, touch, taxels, length.trailing_zeros() as usize).map(Some)
    }

    /// Requests a touch again.
    fn again(&mut self, index: usize, why: String) {
        let step = &mut self.steps[index];
        (step.touch, step.reading) = (None, None);
        if step.tries >= TRIES {
            let question = step.ask.sentence(&self.template);
            self.given_up = Some(format!("{question} After {TRIES} tries: {why}."));
        }
        step.ask.why = Some(why);
    }

    /// Handles a request without an answer.
    fn silence(&mut self, index: usize) {
        let step = &mut self.steps[index];
        step.silent += 1;
        step.ask.why = Some("nothing was felt".into());
        if step.silent < SILENT {
            return;
        }
        let panel = step.ask.panel;
        let name = self.template.panels.get(panel).map_or("", |panel| panel.name.as_str());
        if self.steps.iter().any(|step| step.ask.panel == panel && step.touch.is_some()) {
            self.given_up = Some(format!("Only a part of panel {name} can be felt."));
        }
        self.steps.iter_mut().filter(|step| step.ask.panel == panel).for_each(|step| step.skipped = true);
    }

    /// Requests the stroke across, on the first live panel, and the corner of each panel as confirmation.
    fn ask_across(&mut self) {
        self.across = true;
        let mut alive: Vec<usize> = self.steps.iter().filter(|s| !s.skipped).map(|s| s.ask.panel).collect();
        alive.dedup();
        let Some(ask) = alive.first().and_then(|panel| stroke_across(&self.template, *panel)) else {
            self.given_up = Some("Nothing was felt on any panel.".into());
            return;
        };
        self.steps.push(Step::new(ask));
        let corner = |panel| Step::new(Ask { panel, gesture: Gesture::Corner, why: None });
        self.steps.extend(alive.into_iter().map(corner));
    }

    /// Returns the garment if all touches agree with it; else the step to be repeated, if one may help, and
    /// why.
    fn conclude(&self) -> Result<Found, (Option<usize>, String)> {
        let strokes: Vec<Stroke<'_>> = self
            .steps
            .iter()
            .enumerate()
            .filter_map(|(index, step)| {
                Some(Stroke { step: index, ask: &step.ask, reading: step.reading.as_ref()? })
            })
            .collect();
        let (mut garment, margin) = assemble(&self.template, &self.bundle, &strokes)
            .map_err(|unclear| (Some(unclear.step), unclear.why))?;
        let dead = self.bury(&mut garment).ok_or_else(|| (None, LEFT_OVER.to_string()))?;
        let places = Places::of(&garment, &self.bundle)
            .map_err(|error| (None, format!("What was felt contradicts itself: {error}.")))?;
        let mut off = 0.0f64;
        for (index, step) in self.steps.iter().enumerate() {
            if let Some(touch) = &step.touch {
                off = off.max(places.check(&step.ask, touch).map_err(|why| (Some(index), why))?);
            }
        }
        let touches = self.steps.iter().map(|step| step.tries + step.silent).sum();
        Ok(Found { garment, dead, margin, off, touches })
    }

    /// Assigns the unused inputs to dead panels. None if their numbers differ.
    fn bury(&self, garment: &mut Garment) -> Option<Vec<(usize, u8)>> {
        let dead: Vec<usize> = (0..garment.panels.len())
            .filter(|panel| self.steps.iter().any(|step| step.ask.panel == *panel && step.skipped))
            .collect();
        let lives = |panel: u8| !dead.contains(&usize::from(panel));
        let used: Vec<u8> = garment.blocks.iter().filter(|b| lives(b.panel)).map(|b| b.input).collect();
        let left: Vec<u8> =
            self.bundle.inputs.iter().copied().filter(|input| !used.contains(input)).collect();
        if left.len() != dead.len() {
            return None;
        }
        for (panel, input) in dead.iter().zip(&left) {
            let blocks = garment.blocks.iter_mut().filter(|block| usize::from(block.panel) == *panel);
            for (select, block) in blocks.enumerate() {
                (block.input, block.select) = (*input, select as u16);
                let transposed = block.orientation.transposed;
                block.orientation = Orientation { transposed, ..Orientation::default() };
            }
        }
        Some(dead.into_iter().zip(left).collect())
    }
}
