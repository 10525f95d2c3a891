//! Services, and the board's answers to them.

use super::node::RosNode;
use super::raw::{Done, SceneAsked, Triggered};
use anyhow::{Error, Result};
use ros2_client::{RmwRequestId, Server};
use std::time::{Duration, Instant};
use taxel::client::Client;
use taxel::ros2::parameters::TARE_FRAMES;
use taxel::ros2::topics::{SAVE, SET_SCENE, TARE};
use taxel::session::setting;
use taxel::source::SceneFile;
use taxel::tell::words;
use taxel_core::wire::Request;

/// Longest wait for a board's answer: the longest tare takes that long on a slow garment.
const ANSWER: Duration = Duration::from_secs(30);

/// A service.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Asks {
    Tare,
    Save,
    Scene,
}

/// A request that the board has not answered yet.
struct Waiting {
    asks: Asks,
    /// Number of the board's request.
    number: u8,
    id: RmwRequestId,
    since: Instant,
}

/// The services.
pub struct Services {
    tare: Server<Triggered, Done>,
    save: Server<Triggered, Done>,
    scene: Server<SceneAsked, Done>,
    waiting: Vec<Waiting>,
    /// Name of a source whose board does not listen: a recording.
    deaf: Option<String>,
    /// The board has another scene than its last `Hello` told.
    is_new: bool,
}

impl Services {
    /// Offers them. `deaf` names a source whose board does not listen.
    pub fn open(node: &mut RosNode, deaf: Option<String>) -> Result<Services> {
        let (tare, save, scene) = (node.serve(&TARE)?, node.serve(&SAVE)?, node.serve(&SET_SCENE)?);
        Ok(Services { tare, save, scene, waiting: Vec::new(), deaf, is_new: false })
    }

    /// Takes what has come, and sends it to the board.
    pub fn turn(&mut self, node: &RosNode, client: &mut Client) -> Result<()> {
        if std::mem::take(&mut self.is_new) {
            // Answered by a `Hello`, which tells the scene's joints and concepts.
            client.start(0)?;
        }
        // What cannot be read is another program's mistake.
        while let Some((id, _)) = self.tare.receive_request().ok().flatten() {
            let request = Request::Tare { frames: node.number(TARE_FRAMES) as u16 };
            let asked = client.request(&request).map_err(Error::from);
            self.asked(Asks::Tare, request.number(), id, asked);
        }
        while let Some((id, _)) = self.save.receive_request().ok().flatten() {
            let asked = client.request(&Request::Save).map_err(Error::from);
            self.asked(Asks::Save, Request::Save.number(), id, asked);
        }
        while let Some((id, asked)) = self.scene.receive_request().ok().flatten() {
            let asked = SceneFile::named(&asked.scene).and_then(|scene| setting::set_scene(client, &scene));
            self.asked(Asks::Scene, Request::SetScene(&[]).number(), id, asked.map_err(Error::from));
        }
        let overdue = |waiting: &Waiting| waiting.since.elapsed() > ANSWER;
        while let Some(at) = self.waiting.iter().position(overdue) {
            let Waiting { asks, id, .. } = self.waiting.remove(at);
            self.answer(asks, id, false, format!("the board has not answered in {} s", ANSWER.as_secs()));
        }
        Ok(())
    }

    /// Waits for the board's answer to a request that was sent.
    fn asked(&mut self, asks: Asks, number: u8, id: RmwRequestId, sent: Result<()>) {
        match (&self.deaf, sent) {
            (Some(label), _) => {
                self.answer(asks, id, false, format!("{label} is a recording, whose board does not listen"));
            }
            (None, Err(error)) => self.answer(asks, id, false, words::sentence(error.as_ref())),
            (None, Ok(())) => self.waiting.push(Waiting { asks, number, id, since: Instant::now() }),
        }
    }

    /// Passes on the board's answer to a request of this number.
    pub fn answered(&mut self, number: u8, refusal: Option<&str>) {
        let Some(at) = self.waiting.iter().position(|waiting| waiting.number == number) else { return };
        let Waiting { asks, id, .. } = self.waiting.remove(at);
        self.is_new |= asks == Asks::Scene && refusal.is_none();
        match refusal {
            Some(why) => self.answer(asks, id, false, format!("the board refuses: {why}")),
            None => self.answer(asks, id, true, "done".into()),
        }
    }

    fn answer(&self, asks: Asks, id: RmwRequestId, success: bool, message: String) {
        let done = Done { success, message };
        // Who asked may be gone.
        let _ = match asks {
            Asks::Tare => self.tare.send_response(id, done),
            Asks::Save => self.save.send_response(id, done),
            Asks::Scene => self.scene.send_response(id, done),
        };
    }
}
