//! Processing of a frame, stage by stage.

use super::compose::Pipeline;
use super::percept::Percept;
use super::probe::{Probe, Stage};
use super::state::{CONTACTS, PipelineState};
use crate::body::Placed;
use crate::condition::{Image, Sampled};
use crate::contact::{Contact, ContactState, Touches};
use crate::format::{Code, Micros};
use crate::garment::Layout;
use crate::intent::{Felt, Intent, Touch};
use crate::shape::{Shape, Taught};
use heapless::Vec;

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
        let PipelineState {
            condition,
            contact,
            present,
            released,
            unsure,
            symbol,
            intent,
            react,
            taught,
            ..
        } = state;
        probe.begin(Stage::Condition);
        let sampled = Sampled { codes, falling, panels: self.panels, now };
        self.condition.process(condition, layout, &sampled, contact.feedback());
        let condition = &*condition;
        let image = self.condition.image(condition, layout);
        probe.begin(Stage::Contact);
        let touches = self.contact.process(contact, layout, &image, now);
        probe.begin(Stage::Shape);
        let dropped = touches.dropped.saturating_add(touches.overflow);
        let faint = touches.faint;
        self.place(&touches, layout, present, released);
        if taught.gallery().is_some() {
            look(taught, present, contact, layout, &image);
        }
        unsure.process(present, faint, |panel| condition.drifted(panel), now);
        let unsure = &*unsure;
        probe.begin(Stage::Symbol);
        self.symbol.process(symbol, layout, present, released, now);
        let gesture = self.gestures.as_ref().and_then(|stage| {
            let totals = present.iter().map(|placed| (placed.contact.panel, placed.contact.total));
            let told = stage.process(&mut state.gesture, layout, &image, totals, self.certainty, now)?;
            Some((told, stage.name(told.class)))
        });
        probe.begin(Stage::Intent);
        let meaning = self.intent.as_ref().and_then(|stage| {
            let press = |placed: &Placed| placed.contact.peak_total;
            let sure = || present.iter().enumerate().filter(|(index, _)| !unsure.is_unsure(*index));
            let strongest = sure()
                .map(|(_, placed)| placed)
                .reduce(|most, next| if press(next) > press(most) { next } else { most });
            // The touch that the stage would choose itself.
            let own = state.fold.moves(now);
            let touch = strongest.map(|placed| Touch { own, ..self.touch(layout, placed) });
            let felt = self.felt(layout, sure().map(|(_, placed)| placed));
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

    /// Sets shape and place of each contact. Released ones, and those whose form was not computed in this
    /// frame, keep their shape.
    #[inline(always)] // one call; its iterators use the caller's values in place
    fn place(
        &self,
        touches: &Touches<'_>,
        layout: &Layout,
        present: &mut Vec<Placed, CONTACTS>,
        released: &mut Vec<Placed, CONTACTS>,
    ) {
        let gone = |contact: &Contact| Placed::new(layout, contact.clone(), shape_in(present, contact.id));
        replace(released, touches.released.iter().map(gone));
        let forms = touches.moments.iter().zip(touches.quartics).zip(touches.ages);
        for (index, (contact, ((moments, quartic), age))) in touches.present.iter().zip(forms).enumerate() {
            let shape = match &self.shape {
                Some(stage) if *age == 0 => stage.process(moments, quartic, contact),
                Some(_) => match present.get_mut(index) {
                    // The usual case: the entry already is this contact's.
                    Some(placed) if placed.contact.id == contact.id => {
                        placed.follow(layout, contact);
                        continue;
                    }
                    _ => shape_in(present.get(index..).unwrap_or(&[]), contact.id),
                },
                None => Shape::default(),
            };
            match present.get_mut(index) {
                Some(placed) => {
                    placed.shape = shape;
                    placed.follow(layout, contact);
                }
                // There are as many places as contacts.
                None => _ = present.push(Placed::new(layout, contact.clone(), shape)),
            }
        }
        present.truncate(touches.present.len());
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
            cell_mm2: self.cell_mm2(layout, placed),
            ..Touch::default()
        }
    }

    /// Inputs of the map from all contacts that are not unsure.
    fn felt<'p>(&self, layout: &Layout, sure: impl Iterator<Item = &'p Placed>) -> Felt {
        let mut felt = Felt::default();
        let high = self.contact.config().high;
        let mut panel = (u8::MAX, 0);
        for Placed { contact, region, .. } in sure {
            if contact.panel != panel.0 {
                let area = layout.areas().get(usize::from(contact.panel));
                panel = (contact.panel, area.map_or(0, |area| area.cell_mm2));
            }
            felt.add(*region, contact.total, contact.peak, contact.area, panel.1, high);
        }
        felt
    }

    /// Area of a taxel at the contact, mm2; 0 if the map does not use hardness.
    fn cell_mm2(&self, layout: &Layout, placed: &Placed) -> u32 {
        if !self.intent.as_ref().is_some_and(Intent::feels) {
            return 0;
        }
        let area = layout.areas().get(usize::from(placed.contact.panel));
        area.map_or(0, |area| area.cell_mm2)
    }
}

/// Classifies one contact with the taught base, and sets the class of every contact to the last result for
/// it.
fn look<const RUNS: usize, const PARTS: usize>(
    taught: &mut Taught<CONTACTS>,
    present: &mut [Placed],
    contact: &ContactState<CONTACTS, RUNS, PARTS>,
    layout: &Layout,
    image: &Image<'_>,
) {
    let chosen = taught.choose(present.iter().map(|placed| placed.contact.id));
    if let Some((index, placed)) = chosen.and_then(|index| Some((index, present.get(index)?))) {
        taught.look(contact, layout, image, (index, &placed.contact));
    }
    present.iter_mut().for_each(|placed| taught.tell(&placed.contact, &mut placed.shape));
}

/// Returns the shape that a contact had in `list`. Lists of contacts are in the order of onset, so entries
/// before the search can be overwritten.
fn shape_in(list: &[Placed], id: u32) -> Shape {
    list.iter().find(|placed| placed.contact.id == id).map_or_else(Shape::default, |placed| placed.shape)
}

/// Replaces the content of a list; items without room are left out.
fn replace<T, const N: usize>(list: &mut Vec<T, N>, items: impl Iterator<Item = T>) {
    list.clear();
    for item in items {
        if list.push(item).is_err() {
            break;
        }
    }
}
