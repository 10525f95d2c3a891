//! Processing of a frame, stage by stage.

use super::compose::Pipeline;
use super::percept::Percept;
use super::probe::{Probe, Stage};
use super::state::{CONTACTS, PipelineState};
use crate::baseline::consensus::DriftPace;
use crate::body::Placed;
use crate::condition::{ConditionState, Image, Sampled};
use crate::contact::ContactState;
use crate::format::{Code, Micros};
use crate::garment::{Layout, PANELS};
use crate::intent::{Felt, Intent, Touch};
use crate::shape::{Shape, Taught};
use crate::unsure::DriftLimits;

impl Pipeline {
    /// Processes one frame of codes, scanned at `now`.
    pub fn process<'s, const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
        &self,
        state: &'s mut PipelineState<TAXELS, RUNS, PARTS>,
        layout: &Layout,
        codes: &[Code],
        falling: bool,
        now: Micros,
        probe: &mut impl Probe,
    ) -> Percept<'s> {
        let PipelineState { condition, contact, unsure, symbol, intent, react, taught, .. } = state;
        probe.begin(Stage::Condition);
        let sampled = Sampled { codes, falling, panels: self.panels, now };
        self.condition.process(condition, layout, &sampled, contact.feedback());
        let condition = &*condition;
        let image = self.condition.image(condition, layout);
        probe.begin(Stage::Contact);
        contact.set_drifting(condition.drifts_fast(), condition.clear_of_noise());
        let touches = self.contact.process(contact, layout, &image, now);
        probe.begin(Stage::Shape);
        let dropped = touches.dropped.saturating_add(touches.overflow);
        let faint = touches.faint;
        self.place(contact, layout);
        look(taught, contact, layout, &image);
        unsure.process(contact.present(), faint, |panel| self.explained(condition, layout, panel), now);
        let unsure = &*unsure;
        contact.hold(|index| unsure.hold(index));
        let contact = &*contact;
        let (present, released) = (contact.present(), contact.released());
        probe.begin(Stage::Symbol);
        self.symbol.process(symbol, layout, present, released, now);
        #[cfg(feature = "gesture")]
        let gesture = self.gestures.as_ref().and_then(|stage| {
            let totals = present.iter().map(|placed| (placed.contact.panel, placed.contact.total));
            let reported = stage.process(&mut state.gesture, layout, &image, totals, now)?;
            Some((reported, stage.name(reported.class)))
        });
        #[cfg(not(feature = "gesture"))]
        let gesture = None;
        probe.begin(Stage::Intent);
        let meaning = self.intent().and_then(|stage| {
            let indexed = || present.iter().enumerate();
            let sure = || indexed().filter(|(index, _)| !unsure.is_unsure(*index)).map(|(_, placed)| placed);
            let folds = condition.folds();
            let own = folds.posture.moves(now) && !folds.is_followed();
            let touch = strongest(sure()).map(|placed| Touch { own, ..self.touch(layout, placed) });
            let mut felt = self.felt(layout, sure(), (condition.drifts_fast(), condition.clear_of_noise()));
            if stage.embraces() {
                add_parts(&mut felt, contact, layout);
            }
            stage.process(intent, touch.as_slice(), &felt, &state.fed.values(now), now)
        });
        probe.begin(Stage::React);
        self.react.process(react, symbol.regions(layout.regions().len()), meaning, now);
        probe.begin(Stage::Idle);
        Percept {
            image: image.values,
            present,
            form_ages: contact.form_ages(),
            released,
            dropped,
            unsure,
            symbols: symbol,
            meaning,
            gesture,
            reactions: react,
            tare: condition.tare_progress(),
        }
    }

    /// Sets the place of each contact, and the shape of those whose form was measured in this frame. The
    /// others, and released ones, keep their shape.
    #[inline(always)] // one call; its iterator uses the caller's values in place
    fn place<const RUNS: usize, const PARTS: usize>(
        &self,
        contact: &mut ContactState<CONTACTS, RUNS, PARTS, Placed>,
        layout: &Layout,
    ) {
        for (placed, looked) in contact.looked() {
            match (&self.shape, looked) {
                (Some(stage), Some((moments, quartic))) => {
                    placed.shape = stage.process(moments, quartic, &placed.contact);
                }
                (Some(_), None) => {}
                (None, _) => placed.shape = Shape::default(),
            }
            placed.place(layout);
        }
    }

    /// Inputs of the map from one contact.
    fn touch(&self, layout: &Layout, placed: &Placed) -> Touch {
        Touch {
            press: placed.contact.peak_total,
            breadth: placed.contact.peak_breadth,
            friendliness: self.friendliness.get(usize::from(placed.region)).copied().unwrap_or(0),
            duration_ms: placed.contact.duration_ms,
            speed: placed.speed(layout),
            force: placed.contact.total,
            area: placed.contact.area,
            way: placed.way(layout),
            cell_mm2: self.cell_mm2(layout, placed),
            ..Touch::default()
        }
    }

    /// Inputs of the map from all contacts that are not unsure.
    fn felt<'p>(
        &self,
        layout: &Layout,
        sure: impl Iterator<Item = &'p Placed>,
        (drifting, clear): (bool, [u16; PANELS]),
    ) -> Felt {
        let mut felt = Felt::default();
        let config = self.contact.config();
        let mut least = config.high;
        let mut panel = (u8::MAX, 0);
        for Placed { contact, region, .. } in sure {
            if contact.panel != panel.0 {
                let area = layout.areas().get(usize::from(contact.panel));
                panel = (contact.panel, area.map_or(0, |area| area.cell_mm2));
                let clear = clear.get(usize::from(contact.panel)).copied().unwrap_or(0);
                let peak = area.map_or(0, |area| config.least_peak(area, drifting, clear));
                least = peak.min(u16::MAX.into()) as u16;
            }
            felt.add(*region, contact.total, contact.peak, contact.area, panel.1, least);
        }
        felt
    }

    /// Drift and noise of a panel, as far as they may be a contact there.
    fn explained<const TAXELS: usize>(
        &self,
        condition: &ConditionState<TAXELS>,
        layout: &Layout,
        panel: u8,
    ) -> DriftLimits {
        let area = layout.areas().get(usize::from(panel));
        let least = area.map_or(0, |area| self.contact.config().least_peak(area, condition.drifts_fast(), 0));
        DriftLimits {
            drifted: condition.drifted(panel),
            rise: condition.unexplained_rise(panel),
            least: least.min(u16::MAX.into()) as u16,
            still: condition.pace(panel) == DriftPace::Still,
        }
    }

    /// Area of a taxel at the contact, mm2; 0 if the map does not use hardness.
    fn cell_mm2(&self, layout: &Layout, placed: &Placed) -> u32 {
        if !self.intent().is_some_and(Intent::feels) {
            return 0;
        }
        let area = layout.areas().get(usize::from(placed.contact.panel));
        area.map_or(0, |area| area.cell_mm2)
    }
}

/// Adds the pressure of each region: a contact may lie on several.
#[inline(never)] // M0+: own registers
fn add_parts<const RUNS: usize, const PARTS: usize>(
    felt: &mut Felt,
    contact: &ContactState<CONTACTS, RUNS, PARTS, Placed>,
    layout: &Layout,
) {
    contact.each_pressed(layout, |pressed| {
        let Some(part) = felt.parts.get_mut(usize::from(pressed.area.region)) else { return };
        *part = pressed.runs.iter().fold(*part, |sum, run| sum.saturating_add(run.sums.s0));
    });
}

/// The contact of the largest press, which the intent stage would choose itself.
fn strongest<'p>(contacts: impl Iterator<Item = &'p Placed>) -> Option<&'p Placed> {
    let press = |placed: &Placed| placed.contact.peak_total;
    contacts.reduce(|most, next| if press(next) > press(most) { next } else { most })
}

/// Classifies one contact with the taught base, if there is one, and sets the class of every contact to the
/// last result for it.
fn look<const RUNS: usize, const PARTS: usize>(
    taught: &mut Taught<CONTACTS>,
    contact: &mut ContactState<CONTACTS, RUNS, PARTS, Placed>,
    layout: &Layout,
    image: &Image<'_>,
) {
    if taught.gallery().is_none() {
        return;
    }
    let present = contact.present();
    let chosen = taught.choose(present.iter().map(|placed| placed.contact.id));
    if let Some((index, placed)) = chosen.and_then(|index| Some((index, present.get(index)?))) {
        taught.look(contact, layout, image, (index, &placed.contact));
    }
    contact.slots().iter_mut().for_each(|placed| taught.classify(&placed.contact, &mut placed.shape));
}
