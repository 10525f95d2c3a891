//! Requests of the host.

use super::outbox::Streamed;
use super::outputs::Outputs;
use super::rebuilds::Rebuilds;
use super::refusal::Refusal;
use super::uploads::TableKind;
use super::work::{FULL, Work};
use super::{Board, reading};
use crate::condition::Certificate;
use crate::contact::Forms;
use crate::format::{Invalid, LEFT_OUT, Micros, Q15};
use crate::garment::{Garment, PANELS};
use crate::gesture::{Certainty, GestureConfig, Gestures};
use crate::intent::{Feed, Intent};
use crate::pipeline::CONTACTS;
use crate::scene::Scene;
use crate::shape::{Exemplar, Taught};
use crate::wire::{Request, SHAPES_ADDED, decode};
use heapless::Vec;

/// Number that stands in the answer to an unreadable request.
const UNREADABLE: u8 = 255;

/// Refuses what this build leaves out.
#[inline(never)] // M0+: out of line
fn left_out(parameter: &'static str) -> Refusal {
    Refusal::of(Invalid { parameter, must: LEFT_OUT })
}

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    pub(super) fn receive(&mut self, now: Micros, mut bytes: &[u8]) {
        while !bytes.is_empty() {
            // The message is copied out of the inbox, which is part of the board that it changes.
            let Board { inbox, outbox, health, .. } = self;
            let (taken, frame) = inbox.take(bytes);
            bytes = bytes.get(taken..).unwrap_or(&[]);
            let Some(frame) = frame else { continue };
            let mut message = Vec::<u8, { crate::wire::LONGEST_REQUEST }>::new();
            let read = frame.and_then(|body| {
                message.extend_from_slice(body).map_err(|_| crate::wire::WireError::TooLong)?;
                decode::<Request>(&message)
            });
            match read {
                Ok(request) => {
                    self.senses.hear(now);
                    self.obey(now, request);
                }
                Err(error) => {
                    health.refused = health.refused.wrapping_add(1);
                    outbox.answer(UNREADABLE, Some(format_args!("{error}").into()));
                }
            }
        }
    }

    fn obey(&mut self, now: Micros, request: Request<'_>) {
        let number = request.number();
        if Rebuilds::count(number) {
            self.rebuilds.charge(now);
        }
        let result = match request {
            Request::Concept { slot, value } => self.set_concept(slot, value),
            Request::Feed(feed) => self.feed(&feed, now),
            Request::SetGarment(bytes) => self.take_garment(bytes, now),
            Request::SetScene(bytes) => self.take_scene(bytes, now),
            Request::Tare { frames } => match self.tare(frames) {
                Ok(()) => return,
                refused => refused,
            },
            Request::Start => {
                self.begin_stream(now);
                Ok(())
            }
            Request::Stop => {
                let before = self.outbox.streamed();
                self.outbox.stop();
                self.tell_present(before);
                Ok(())
            }
            Request::Sync { token } => return self.outbox.sync(token, now),
            Request::Posture(posture) => self
                .state
                .condition
                .posture_mut()
                .accept(&posture, &self.setup.scene.joints, now)
                .map_err(Refusal::of),
            Request::KeyFrame => {
                self.outbox.forget_image();
                Ok(())
            }
            Request::SelfTest => return self.start(Work::SelfTest),
            Request::Save => match self.save(now) {
                Ok(()) => return self.start(Work::Save),
                refused => refused,
            },
            Request::ResetSettings { undo } => return self.start(Work::Reset { undo }),
            Request::SetGain { first, gains } => self.set_gain(first, &gains),
            Request::SetGestures(config) => self.set_gestures(config.as_ref()),
            Request::SetCertainty(thousandths) => self.set_certainty(thousandths),
            Request::SetForms { in_frame, ages } => {
                self.setup.pipeline.look_at(Forms::of(in_frame));
                self.outbox.tell_ages(ages);
                Ok(())
            }
            Request::SetCalibration(certificate) => self.certify(certificate),
            Request::SetShapes(bytes) => self.set_shapes(bytes),
            Request::AddShapes(bytes) => self.add_shapes(bytes),
            Request::Budget { hz } => {
                self.ledger.report(hz);
                Ok(())
            }
            Request::SetRaw { hz } => self.send_raw(hz),
            Request::SetSurface(_)
            | Request::SetPoses(_)
            | Request::SetPressing(_)
            | Request::MovePoses(_)
                if !cfg!(feature = "surface") =>
            {
                Err(left_out("surface"))
            }
            Request::SetSurface(bytes) => match self.take_table(now, TableKind::Surface, bytes) {
                Ok(()) => return,
                refused => refused,
            },
            Request::SetFolds(_) if !cfg!(feature = "folds") => Err(left_out("folds")),
            Request::SetFolds(bytes) => match self.take_table(now, TableKind::Folds, bytes) {
                Ok(()) => return,
                refused => refused,
            },
            Request::SetPoses(bytes) => self.take_poses(bytes, now),
            Request::MovePoses(bytes) => self.take_moving(bytes),
            Request::SetPressing(hz) => self.tell_pressing(hz),
        };
        self.outbox.answer(number, result.err());
    }

    /// Reports everything from now on: the same codes give the same reports, whatever came before.
    fn begin_stream(&mut self, now: Micros) {
        self.monitor.again();
        self.outbox.start();
        self.surface.introduce();
        self.tell_lasting(now);
        if self.state.taught.gallery().is_some() {
            self.outbox.tell_shapes();
        }
        if self.state.unsure().ids().next().is_some() {
            self.outbox.tell_unsure();
        }
        self.tell_present(Streamed::default());
    }

    /// Reports what is present, as far as it is streamed and was not before, or the other way round.
    fn tell_present(&mut self, before: Streamed) {
        let Board { outbox, state, ledger, health, .. } = self;
        let regions = state.symbols().regions(PANELS);
        let present = (state.present(), regions, state.intent().meaning());
        outbox.tell_present(before, ledger.last(), present, health);
    }

    fn set_concept(&mut self, slot: u8, value: Q15) -> Result<(), Refusal> {
        if !cfg!(feature = "intent") {
            return Err(left_out("intent"));
        }
        self.state.fed.set(slot, value).map_err(Refusal::of)
    }

    fn feed(&mut self, feed: &Feed, now: Micros) -> Result<(), Refusal> {
        if !cfg!(feature = "intent") {
            return Err(left_out("intent"));
        }
        let map = self.setup.pipeline.intent().map(Intent::map);
        self.state.fed.accept(feed, map, now).map_err(Refusal::of)
    }

    fn send_raw(&mut self, hz: u16) -> Result<(), Refusal> {
        if hz > 0 && !cfg!(feature = "raw") {
            return Err(left_out("raw"));
        }
        self.outbox.send_raw(hz, &self.setup.scene.stream);
        Ok(())
    }

    // Own frames, here and below: each needs much stack, and most requests need none of it.
    #[inline(never)]
    fn take_garment(&mut self, bytes: &[u8], now: Micros) -> Result<(), Refusal> {
        let mut garment = Garment::default();
        reading::garment(bytes, &mut garment)?;
        let lasting = self.lasting();
        self.setup.change_garment(&self.info, &mut garment, TAXELS).map_err(Refusal::of)?;
        self.garment_changed();
        self.end_all(&lasting, now);
        Ok(())
    }

    #[inline(never)]
    pub(super) fn take_scene(&mut self, bytes: &[u8], now: Micros) -> Result<(), Refusal> {
        let mut scene = Scene::empty();
        reading::scene(bytes, &mut scene)?;
        let streamed = self.outbox.streamed();
        if let Some(done) = self.setup.change_stream(&self.info, &mut scene) {
            done.map_err(Refusal::of)?;
            self.outbox.pace(&self.setup.scene.stream);
            self.tell_present(streamed);
            return Ok(());
        }
        let lasting = self.lasting();
        let before = Outputs::at_rest(self.setup.pipeline.reactions());
        self.setup.change_scene(&self.info, &mut scene).map_err(Refusal::of)?;
        // A pin that the new scene does not drive must not keep the level of the old one.
        self.outputs.follow(before);
        self.scene_changed();
        // `scene` now holds the previous scene.
        self.carry(&lasting, &scene.react, now);
        self.tell_present(streamed);
        Ok(())
    }

    pub(super) fn set_gestures(&mut self, config: Option<&GestureConfig>) -> Result<(), Refusal> {
        if config.is_some() && !cfg!(feature = "gesture") {
            return Err(left_out("gestures"));
        }
        self.setup.pipeline.gestures = config.map(Gestures::build).transpose().map_err(Refusal::of)?;
        self.state.recognise_anew();
        Ok(())
    }

    fn set_certainty(&mut self, thousandths: u16) -> Result<(), Refusal> {
        self.setup.pipeline.certainty = Certainty::of(thousandths).map_err(Refusal::of)?;
        Ok(())
    }

    #[inline(never)]
    fn set_shapes(&mut self, bytes: &[u8]) -> Result<(), Refusal> {
        if !bytes.is_empty() && !cfg!(feature = "gallery") {
            return Err(left_out("shapes"));
        }
        if bytes.is_empty() {
            self.state.taught.clear();
            self.shapes_changed();
            return Ok(());
        }
        let head = reading::value("shapes", bytes)?;
        self.teach(|taught| taught.begin(head))
    }

    #[inline(never)]
    fn add_shapes(&mut self, bytes: &[u8]) -> Result<(), Refusal> {
        if !cfg!(feature = "gallery") {
            return Err(left_out("shapes"));
        }
        let prototypes = reading::value::<Vec<Exemplar, SHAPES_ADDED>>("prototypes", bytes)?;
        self.teach(|taught| taught.add(&prototypes))
    }

    /// Changes the gallery; forgets the recognised shapes if one was in force before or is now.
    fn teach(
        &mut self,
        change: impl FnOnce(&mut Taught<CONTACTS>) -> Result<(), Invalid>,
    ) -> Result<(), Refusal> {
        let before = self.state.taught.gallery().is_some();
        let done = change(&mut self.state.taught);
        if before || self.state.taught.gallery().is_some() {
            self.shapes_changed();
        }
        done.map_err(Refusal::of)
    }

    /// Forgets the recognised shapes: classes of the previous base have no name in this one.
    fn shapes_changed(&mut self) {
        self.state.recognise_shapes_anew();
        self.outbox.shapes_changed();
    }

    fn tare(&mut self, frames: u16) -> Result<(), Refusal> {
        if !(1..=4096).contains(&frames) {
            return Err(Refusal::of("frames must be 1 to 4096"));
        }
        // Without a baseline the garment at rest looks like a touch, so only a tared one is checked.
        if self.tared && self.state.is_touched() {
            return Err(Refusal::of("something touches the garment"));
        }
        self.state.condition.tare(frames);
        self.taring = true;
        Ok(())
    }

    fn set_gain(&mut self, first: u16, gains: &[u16]) -> Result<(), Refusal> {
        let end = usize::from(first) + gains.len();
        if end > self.setup.layout.taxels() {
            return Err(Refusal::of("the garment has no such taxel"));
        }
        for (taxel, gain) in (usize::from(first)..end).zip(gains) {
            self.put_gain(taxel, *gain);
        }
        if self.certificate.take().is_some() {
            self.outbox.introduce();
        }
        Ok(())
    }

    /// Sets the calibration from which the gains come.
    pub(super) fn certify(&mut self, certificate: Certificate) -> Result<(), Refusal> {
        certificate.check().map_err(Refusal::of)?;
        if usize::from(certificate.taxels) != self.setup.layout.taxels() {
            return Err(Refusal::of("the calibration is of another garment"));
        }
        self.certificate = Some(certificate);
        self.outbox.introduce();
        Ok(())
    }

    fn start(&mut self, work: Work) {
        if self.works.push_back(work).is_err() {
            self.outbox.answer(work.request(), Some(Refusal::of(FULL)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::{BoardInfo, Input, Job};
    use crate::garment::Pins;
    use crate::wire::encode;

    #[test]
    fn an_output_that_the_new_scene_does_not_drive_is_put_to_rest() {
        let info = BoardInfo { firmware: "", pins: Pins::ANY, full_scale: 4095, link_bytes_per_s: 92_160 };
        let mut board = Board::<64, 32>::new(info, Garment::block(), Scene::shipped()).unwrap();
        let drives = |board: &mut Board<64, 32>| {
            let jobs = core::iter::from_fn(|| board.step(Micros(0), Input::Tick, &mut ()));
            let pins = jobs
                .map_while(|job| if let Job::Drive(pin, level) = job { Some((pin, level)) } else { None });
            pins.collect::<heapless::Vec<_, 8>>()
        };
        let mut scene = Scene::shipped();
        let resting: heapless::Vec<_, 8> =
            scene.react.iter().map(|row| (row.output.unwrap().pin, false)).collect();
        assert_eq!(drives(&mut board), resting);
        scene.react.remove(0);
        let (mut text, mut wire) = ([0; 2048], [0; 2048]);
        let text = postcard::to_slice(&scene, &mut text).unwrap();
        let frame = encode(&Request::SetScene(text), &mut wire).unwrap();
        board.step(Micros(0), Input::Received(frame), &mut ());
        assert_eq!(drives(&mut board), resting);
        assert_eq!(board.setup().scene, scene);
    }
}
