//! The board's own state: when it last perceived a frame and heard a host, and its values for reactions.

use super::effects::Effects;
use super::outputs::Outputs;
use super::perception::Perception;
use crate::format::Micros;
use crate::health::FaultyTaxel;
use crate::react::{Cause, REACTIONS, Reaction, Reactions};
use heapless::Vec;

/// Silence after which the host counts as gone, so that concepts it has fed expire.
const SILENCE_US: u64 = 3_000_000;

/// Times of the last frame and the last message.
#[derive(Debug, Default, Clone, Copy)]
pub(super) struct Alarms {
    /// Time of the last perceived frame; none since the start, a change of garment, or an interruption.
    seen: Option<Micros>,
    /// Time of the last message from a host, or of the start.
    heard: Micros,
    /// Number of perceived frames.
    frames: u32,
}

/// Faults of the board.
pub(super) struct Faults<'a> {
    /// Number of lines and inputs with a fault, and 1 if scans fail.
    pub lines: i32,
    pub taxels: &'a [FaultyTaxel],
}

impl Alarms {
    /// Forgets the last frame: nothing is perceived for now.
    pub fn blind(&mut self) {
        self.seen = None;
    }

    /// True if no frame was perceived since [`Alarms::blind`].
    pub fn are_blind(&self) -> bool {
        self.seen.is_none()
    }

    /// Records a message from a host.
    pub fn host_heard(&mut self, now: Micros) {
        self.heard = now;
    }

    /// Records a perceived frame and shows it on its pins.
    pub fn frame_perceived(&mut self, now: Micros, reactions: &Reactions, outputs: &mut Outputs) {
        self.seen = Some(now);
        self.frames = self.frames.wrapping_add(1);
        self.show_frames(reactions, outputs);
    }

    /// Sets the pins that show perceived frames to their levels for the present count.
    pub fn show_frames(&self, reactions: &Reactions, outputs: &mut Outputs) {
        for (pin, level) in reactions.watching(self.frames) {
            outputs.set(pin, level);
        }
    }

    /// Updates what depends on the board's own state.
    pub fn update<'a, const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
        &mut self,
        now: Micros,
        perception: &mut Perception<'_, TAXELS, RUNS, PARTS>,
        faults: impl FnOnce() -> Faults<'a>,
        effects: &mut Effects<'_, TAXELS>,
    ) {
        if now.since(self.heard) >= SILENCE_US {
            perception.state.fed.expire();
        }
        if perception.setup.pipeline.reactions().alarms().next().is_some() {
            self.judge(now, perception, &faults(), effects);
        }
    }

    #[inline(never)] // M0+: out of line
    fn judge<const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
        &mut self,
        now: Micros,
        perception: &mut Perception<'_, TAXELS, RUNS, PARTS>,
        faults: &Faults<'_>,
        effects: &mut Effects<'_, TAXELS>,
    ) {
        let mut changes = Vec::<Reaction, REACTIONS>::new();
        let Perception { setup, state, .. } = perception;
        let reactions = setup.pipeline.reactions();
        let faulty_in = |region: Option<u8>| {
            let of = |taxel: u16| {
                let place = setup.layout.place(taxel.into())?;
                setup.layout.areas().get(usize::from(place.panel)).map(|area| area.region)
            };
            let there = |faulty: &&FaultyTaxel| region.is_none() || of(faulty.taxel) == region;
            faults.taxels.iter().filter(there).count() as i32
        };
        for (index, cause, region) in reactions.alarms() {
            let value = match cause {
                Cause::Fault => faults.lines,
                Cause::Blind => self.seen.map_or(i32::MAX, |seen| ms(now, seen)),
                Cause::Faulty => faulty_in(region),
                Cause::Silent => ms(now, self.heard),
                // All other causes are judged by frames, or not at all.
                _ => continue,
            };
            if let Some(change) = reactions.judge(state.react_mut(), index, value, now) {
                // There is room for all rows.
                let _ = changes.push(change);
            }
        }
        for reaction in &changes {
            effects.outputs.apply(perception.pin(reaction.index));
            effects.reaction(now, reaction.clone());
        }
    }
}

/// Time since `then`, ms; saturates.
fn ms(now: Micros, then: Micros) -> i32 {
    i32::try_from(now.millis_since(then)).unwrap_or(i32::MAX)
}
