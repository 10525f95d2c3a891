//! Requests to the board.

use super::held::{Beside, HeldRequest};
use super::scene_change::SceneChange;
use super::wanted::Sets;
use super::{Client, Event};
use crate::error::{Context, Result, SettingError};
use std::sync::LazyLock;
use taxel_core::scene::Scene;
use taxel_core::wire::{LONGEST_REQUEST, Level, REQUESTS, Request, WireError, encode, frame_bound, open};

/// Encodes a scene for `SetScene`. Error if it is too long for a request.
pub fn scene_bytes(scene: &Scene) -> Result<Vec<u8>> {
    let bytes = postcard::to_allocvec(scene).context("the scene cannot be written")?;
    // The request around it: its number and the length.
    let room = LONGEST_REQUEST - 3;
    if bytes.len() > room {
        fail!(
            SettingError::TooLong,
            "the scene takes {} bytes, and a request has room for {room}",
            bytes.len()
        );
    }
    Ok(bytes)
}

/// The request for a scene as a frame of the wire.
fn scene_frame(scene: &Scene) -> Result<(Vec<u8>, Option<Sets>)> {
    let bytes = scene_bytes(scene)?;
    let request = Request::SetScene(&bytes);
    let mut frame = [0; frame_bound(LONGEST_REQUEST)];
    let frame = encode(&request, &mut frame)?;
    Ok((frame.to_vec(), Sets::of(&request, frame)))
}

/// Name of a request, by its number: `set-scene`.
pub fn request_name(number: u8) -> &'static str {
    static NAMES: LazyLock<Vec<String>> = LazyLock::new(|| REQUESTS.iter().copied().map(hyphened).collect());
    NAMES.get(usize::from(number)).map_or("unreadable request", String::as_str)
}

/// `SetScene` as `set-scene`.
fn hyphened(name: &str) -> String {
    let hyphen = |(at, letter): &(usize, char)| (*at > 0 && letter.is_uppercase()).then_some('-');
    name.char_indices().flat_map(|it| hyphen(&it).into_iter().chain(it.1.to_lowercase())).collect()
}

/// Requests.
impl Client {
    /// Requests the whole stream, and a tare over `tare` frames unless 0. A board that restarts later gets
    /// these and all other settings again.
    pub fn start(&mut self, tare: u16) -> Result<(), WireError> {
        self.streaming = true;
        self.request(&Request::Start)?;
        if tare > 0 { self.request(&Request::Tare { frames: tare }) } else { Ok(()) }
    }

    /// Queues a request. Error if it is too long.
    pub fn request(&mut self, request: &Request<'_>) -> Result<(), WireError> {
        let mut frame = [0; frame_bound(LONGEST_REQUEST)];
        let frame = encode(request, &mut frame)?;
        if let Request::Stream { raw_hz, budget_hz } = request {
            self.beside = Beside { raw_hz: *raw_hz, budget_hz: *budget_hz };
        }
        if matches!(request, Request::Sync { .. } | Request::KeyFrame) {
            // This request does not depend on queued ones.
            self.requests.extend_from_slice(frame);
            return Ok(());
        }
        self.held.push_back(HeldRequest::Frame(frame.to_vec(), Sets::of(request, frame)));
        self.release();
        Ok(())
    }

    /// Sets the scene that the board is known to begin with.
    pub(crate) fn expect(&mut self, scene: Option<Scene>) {
        self.expected = scene;
    }

    /// Queues a change of the board's scene, which waits for the first `Hello` unless the scene is known.
    pub fn change_scene(&mut self, change: SceneChange) {
        self.held.push_back(HeldRequest::Change(change));
        self.release();
    }

    /// Requests so many frames of raw codes per second; 65535: with every scan.
    pub fn stream_raw(&mut self, hz: u16) -> Result<(), WireError> {
        self.request(&Request::Stream { raw_hz: hz, budget_hz: self.beside.budget_hz })
    }

    /// Requests so many `Budget` reports per second; 65535: with every scan.
    pub fn stream_budget(&mut self, hz: u16) -> Result<(), WireError> {
        self.request(&Request::Stream { raw_hz: self.beside.raw_hz, budget_hz: hz })
    }

    /// Frames of raw codes per second that were requested.
    pub fn raw_hz(&self) -> u16 {
        self.beside.raw_hz
    }

    /// Sends held requests in order, while the board has answers to spare and is not being restored. A garment waits
    /// for the first `Hello`: the one that the board has by itself is what it is recognised by after a restart.
    pub(super) fn release(&mut self) {
        while !self.is_restoring()
            && let Some(held) = self.held.front()
        {
            let takes_more = self.life.wanted.takes_more();
            let (frame, sets) = match held {
                HeldRequest::Frame(frame, None) => (frame.clone(), None),
                HeldRequest::Frame(_, Some(sets))
                    if !takes_more || self.description.is_none() && sets.is_garment() =>
                {
                    break;
                }
                HeldRequest::Frame(frame, Some(sets)) => (frame.clone(), Some(sets.clone())),
                HeldRequest::Change(change) => {
                    let reported = || {
                        self.description
                            .as_ref()
                            .map(|description| &description.scene)
                            .or(self.expected.as_ref())
                            .cloned()
                    };
                    let Some(mut scene) = self.life.wanted.asked_scene().or_else(reported) else { break };
                    if !takes_more {
                        break;
                    }
                    change.apply(&mut scene);
                    match scene_frame(&scene) {
                        Ok((frame, sets)) => (frame, sets),
                        Err(why) => {
                            self.held.pop_front();
                            let time = self.board_time().unwrap_or_default();
                            self.say(Event::Note { time, level: Level::Error, text: why.to_string() });
                            continue;
                        }
                    }
                }
            };
            self.held.pop_front();
            self.requests.extend(frame);
            let Some(sets) = sets else { continue };
            sets.garment().iter().for_each(|garment| self.identity.learn_garment(garment));
            self.life.wanted.ask(sets);
        }
    }

    /// Queues `SetScene`.
    pub fn use_for(&mut self, scene: &Scene) -> Result<()> {
        Ok(self.request(&Request::SetScene(&scene_bytes(scene)?))?)
    }

    /// Requests the raw codes of every frame, unless some are requested already. Returns whether it did.
    pub fn request_codes(&mut self) -> Result<bool, WireError> {
        let asks = self.raw_hz() == 0;
        if asks {
            self.stream_raw(u16::MAX)?;
        }
        Ok(asks)
    }

    /// True while a table of the surface is on its way to the board: it knows no links for poses yet.
    pub(crate) fn is_storing_table(&self) -> bool {
        self.held.iter().any(HeldRequest::is_piece) || self.life.wanted.awaits_piece()
    }

    /// Bytes to be sent to the board, including requests held back but for changes of the scene.
    pub fn queued(&self) -> Vec<u8> {
        let frame = |held: &'_ HeldRequest| match held {
            HeldRequest::Frame(frame, _) => frame.clone(),
            HeldRequest::Change(_) => Vec::new(),
        };
        self.requests.iter().copied().chain(self.held.iter().flat_map(frame)).collect()
    }

    /// Numbers of the requests that the board has not been sent yet.
    pub(crate) fn queued_numbers(&self) -> Vec<u8> {
        let queued = self.queued();
        let number = |frame: &[u8]| open(&mut frame.to_vec()).ok()?.first().copied();
        let changes = self.held.iter().filter(|held| matches!(held, HeldRequest::Change(_)));
        let changes = changes.map(|_| Request::SetScene(&[]).number());
        queued.split(|byte| *byte == 0).filter_map(number).chain(changes).collect()
    }

    /// Takes the bytes to be sent to the board.
    pub fn take_requests(&mut self) -> Vec<u8> {
        self.release();
        let again = if self.is_met() { self.life.again.due() } else { None };
        self.requests.extend(again.into_iter().flatten());
        let sync = if self.description.is_some() && self.streaming { self.syncs.next() } else { None };
        if let Some(sync) = sync {
            // A request of a few bytes always fits.
            let _ = self.request(&sync);
        }
        std::mem::take(&mut self.requests)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::wire::decode;

    #[test]
    fn requests_are_named_by_their_numbers() {
        assert_eq!(request_name(Request::Start.number()), "start");
        assert_eq!(request_name(Request::SetTable(&[]).number()), "set-table");
        assert_eq!(request_name(REQUESTS.len() as u8), "unreadable request");
    }

    #[test]
    fn a_change_of_the_scene_waits_for_it_and_changes_the_one_asked_for_last() {
        let mut client = Client::new();
        client.change_scene(SceneChange::pressing(7));
        let numbers = client.queued_numbers();
        assert_eq!((client.take_requests(), numbers), (vec![0], vec![Request::SetScene(&[]).number()]));
        // The scene that is asked for behind it is known without a `Hello`.
        let mut client = Client::new();
        client.use_for(&Scene::scaled(255)).unwrap();
        client.change_scene(SceneChange { forms: Some((0, true)), ..SceneChange::default() });
        client.change_scene(SceneChange::pressing(7));
        let sent = client.take_requests();
        let mut last = sent.split(|byte| *byte == 0).rfind(|frame| !frame.is_empty()).unwrap().to_vec();
        let Request::SetScene(bytes) = decode(open(&mut last).unwrap()).unwrap() else { panic!() };
        let scene: Scene = decode(bytes).unwrap();
        assert_eq!((scene.stream.pressing_hz, scene.contact.forms_in_frame), (7, 0));
        assert_eq!(scene.contact.high, Scene::scaled(255).contact.high);
    }
}
