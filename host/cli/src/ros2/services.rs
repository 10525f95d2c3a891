//! Services, and the board's answers to them.

use super::inbox::calls;
use super::node::RosNode;
use super::raw::{Done, SceneAsked, Triggered};
use anyhow::{Context as _, Result};
use ros2_client::{RmwRequestId, Server};
use std::sync::mpsc::{Receiver, SyncSender, channel, sync_channel};
use std::thread;
use std::time::{Duration, Instant};
use taxel::Error;
use taxel::client::Client;
use taxel::ros2::parameters::TARE_FRAMES;
use taxel::ros2::topics::{SAVE, SET_SCENE, TARE};
use taxel::session::setting;
use taxel::source::SceneFile;
use taxel::text::words;
use taxel_core::wire::Request;

/// Longest wait for an answer: the longest tare takes that long on a slow garment.
const ANSWER: Duration = Duration::from_secs(30);
/// Most calls that wait for the board: each delays the joints' angles behind it.
const WAITING: usize = 8;
/// Longest message of an answer, bytes: it may quote what was asked.
const LONGEST: usize = 1000;
/// Stack of the thread that reads scenes: a scene is decoded on it.
const STACK: usize = 8 << 20;

/// A service.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Asks {
    Tare,
    Save,
    Scene,
}

impl Asks {
    /// Number of the board's request.
    fn number(self) -> u8 {
        match self {
            Asks::Tare => Request::Tare { frames: 0 }.number(),
            Asks::Save => Request::Save.number(),
            Asks::Scene => Request::SetScene(&[]).number(),
        }
    }
}

/// A call that is not answered yet.
struct Waiting {
    asks: Asks,
    id: RmwRequestId,
    since: Instant,
    /// The board was asked: a scene is read first, and calls before it are answered first.
    is_sent: bool,
}

/// The services.
pub struct Services {
    tare: Server<Triggered, Done>,
    save: Server<Triggered, Done>,
    scene: Server<SceneAsked, Done>,
    waiting: Vec<Waiting>,
    /// Scenes on their way to the thread that reads them, and back.
    scenes: SyncSender<(RmwRequestId, String)>,
    read: Receiver<(RmwRequestId, Result<SceneFile, Error>)>,
    /// Name of a source whose board does not listen: a recording.
    deaf: Option<String>,
    /// The board has another scene than its last `Hello` reported.
    is_new: bool,
}

impl Services {
    /// Offers them. `deaf` names a source whose board does not listen.
    pub fn open(node: &mut RosNode, deaf: Option<String>) -> Result<Services> {
        let (tare, save, scene) = (node.serve(&TARE)?, node.serve(&SAVE)?, node.serve(&SET_SCENE)?);
        let (scenes, asked) = sync_channel::<(RmwRequestId, String)>(WAITING);
        let (done, read) = channel();
        // It ends with the services.
        let each = move || {
            let scenes = asked.iter().map(|(id, scene)| (id, SceneFile::named(&scene)));
            scenes.map_while(|scene| done.send(scene).ok()).for_each(drop)
        };
        let reader = thread::Builder::new().name("scenes".into()).stack_size(STACK);
        reader.spawn(each).context("a thread for scenes")?;
        Ok(Services { tare, save, scene, waiting: Vec::new(), scenes, read, deaf, is_new: false })
    }

    /// Takes calls that have come, and sends to the board what they ask.
    pub fn turn(&mut self, node: &RosNode, client: &mut Client) -> Result<()> {
        if std::mem::take(&mut self.is_new) {
            // Answered by a `Hello`, which reports the scene's joints and concepts.
            client.start(0)?;
        }
        for (id, _) in Vec::from_iter(calls(&self.tare)) {
            self.admits(Asks::Tare, id);
        }
        for (id, _) in Vec::from_iter(calls(&self.save)) {
            self.admits(Asks::Save, id);
        }
        let tare = Request::Tare { frames: node.number(TARE_FRAMES) as u16 };
        for (asks, request) in [(Asks::Tare, tare), (Asks::Save, Request::Save)] {
            if let Some(id) = self.next(asks) {
                self.asked(id, client.request(&request).map_err(Error::from));
            }
        }
        for (id, asked) in Vec::from_iter(calls(&self.scene)) {
            if self.admits(Asks::Scene, id) && self.scenes.try_send((id, asked.scene)).is_err() {
                self.asked(id, Err(Error::other("the scenes before it cannot be read")));
            }
        }
        while let Ok((id, scene)) = self.read.try_recv() {
            // Whoever asked may have heard that it takes too long.
            if self.waiting.iter().any(|waiting| waiting.id == id) {
                self.asked(id, scene.and_then(|scene| setting::set_scene(client, &scene)));
            }
        }
        self.expire();
        Ok(())
    }

    /// Refuses calls that wait for too long.
    fn expire(&mut self) {
        let overdue = |waiting: &Waiting| waiting.since.elapsed() > ANSWER;
        while let Some(at) = self.waiting.iter().position(overdue) {
            let Waiting { asks, id, is_sent, .. } = self.waiting.remove(at);
            let is_unread = asks == Asks::Scene && !is_sent;
            let what = if is_unread { "the scene could not be read" } else { "the board has not answered" };
            self.answer(asks, id, false, format!("{what} in {} s", ANSWER.as_secs()));
        }
    }

    /// Lets a call wait for its answer, unless it is refused at once.
    fn admits(&mut self, asks: Asks, id: RmwRequestId) -> bool {
        let refusal = match &self.deaf {
            Some(label) => format!("{label} is a recording, whose board does not listen"),
            None if self.waiting.len() >= WAITING => {
                format!("{WAITING} calls wait for the board already: call again once they are answered")
            }
            None => {
                self.waiting.push(Waiting { asks, id, since: Instant::now(), is_sent: false });
                return true;
            }
        };
        self.answer(asks, id, false, refusal);
        false
    }

    /// The call of a service that is sent now: one at a time, because a board answers only the last of several tares.
    fn next(&self, asks: Asks) -> Option<RmwRequestId> {
        let first = self.waiting.iter().find(|waiting| waiting.asks == asks)?;
        (!first.is_sent).then_some(first.id)
    }

    /// Waits for the board's answer to a call, if its request was sent.
    fn asked(&mut self, id: RmwRequestId, sent: Result<(), Error>) {
        let Some(at) = self.waiting.iter().position(|waiting| waiting.id == id) else { return };
        match sent {
            Ok(()) => self.waiting[at].is_sent = true,
            Err(error) => {
                let Waiting { asks, id, .. } = self.waiting.remove(at);
                self.answer(asks, id, false, words::sentence(&error));
            }
        }
    }

    /// Passes on the board's answer to a request of this number.
    pub fn answered(&mut self, number: u8, refusal: Option<&str>) {
        let is_it = |waiting: &Waiting| waiting.is_sent && waiting.asks.number() == number;
        let Some(at) = self.waiting.iter().position(is_it) else { return };
        let Waiting { asks, id, .. } = self.waiting.remove(at);
        self.is_new |= asks == Asks::Scene && refusal.is_none();
        match refusal {
            Some(why) => self.answer(asks, id, false, format!("the board refuses: {why}")),
            None => self.answer(asks, id, true, "done".into()),
        }
    }

    fn answer(&self, asks: Asks, id: RmwRequestId, success: bool, message: String) {
        let done = Done { success, message: shortened(message) };
        // Who asked may be gone.
        let _ = match asks {
            Asks::Tare => self.tare.send_response(id, done),
            Asks::Save => self.save.send_response(id, done),
            Asks::Scene => self.scene.send_response(id, done),
        };
    }
}

/// Leaves out the middle of a sentence that quotes much.
fn shortened(text: String) -> String {
    if text.len() <= LONGEST {
        return text;
    }
    let head = &text[..text.floor_char_boundary(LONGEST / 2)];
    let tail = &text[text.ceil_char_boundary(text.len() - LONGEST / 2)..];
    format!("{head} ... {tail}")
}
