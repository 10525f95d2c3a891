//! A recording in the page: playing, stepping, cutting.
//!
//! The player is in the program, not in a page: all pages show the same moment, and a new page gets the whole
//! state. A page controls it by [`Order`]s. Two threads read the file. The player decodes from the key frame
//! before the requested moment. The survey reads everything except images once, for the timeline and for the
//! state at the beginning of each chunk, so that the player need not read what came before.
//!
//! | file | holds |
//! |---|---|
//! | `deck.rs` | time: position, speed, range, loop |
//! | `reel.rs` | the recording, read from any image on |
//! | `survey.rs` | reads the recording once |
//! | `wire_message.rs` | the message of a piece of it |
//! | `overview.rs` | summary for the timeline |
//! | `screen.rs` | messages to the pages about a moment |
//! | `cut.rs` | a part of it as a recording of its own |

mod cut;
mod deck;
mod overview;
mod reel;
mod screen;
mod survey;
mod wire_message;

use crate::view::Order;
pub use cut::Cut;

use super::hub::PageHub;
use super::tape::Tape;
use crate::folding::Folding;
use anyhow::{Result, bail};
use deck::{Deck, Go};
use reel::Reel;
use screen::PageScreen;
use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;
use survey::{RecordedTime, Survey};
use taxel::client::Event;
use taxel::files::calibrate::{Calibration, ForceScale};
use taxel::record::Origin;
use taxel::recording::{self, BoardRecording, CALIBRATION, Clips, WIRE, gap_marks};
use taxel::time::Instant;

/// Time between two messages about the position.
const UPDATE: Duration = Duration::from_millis(250);
/// Time of playing between two looks at the orders.
const TURN: Duration = Duration::from_millis(40);
/// Lag of the images beyond which the transport waits for them, us.
const BEHIND: u64 = 300_000;

/// Plays a recording to the pages of a hub.
pub struct Player {
    hub: Arc<PageHub>,
    deck: Deck,
    reel: Reel,
    screen: PageScreen,
    sent: Instant,
    /// Number of pages that was sent last.
    pages: usize,
}

impl Player {
    /// Opens a recording and shows its first image. `calibration` replaces the attached one; `folding` says
    /// where the garment folds.
    pub fn open(
        recording: &BoardRecording,
        speed: f64,
        calibration: Option<Calibration>,
        folding: Option<Folding>,
        hub: Arc<PageHub>,
    ) -> Result<Player> {
        recording.overview()?;
        let mut clips = Clips::open(recording, WIRE)?;
        if !clips.has_topic() && !clips.places().is_empty() {
            // Channels may be declared in the first chunk.
            clips.clip(0)?;
        }
        if !clips.has_topic() {
            bail!("{recording} has no topic {WIRE}: it is not a recording of taxel");
        }
        let origin = origin(&clips, recording, calibration)?;
        let scale = origin.scale.clone();
        let clock = RecordedTime::of(&clips);
        let survey = Survey::start(clips.again()?, clock, scale.clone(), hub.clone())?;
        let cut = Cut::new(clips.again()?, survey.clone(), origin);
        hub.tape(Tape::Recorded(Arc::new(cut)));
        let mut player = Player {
            deck: Deck::new(clock.duration(), speed, Instant::now()),
            reel: Reel::new(clips, survey, gap_marks(recording)?, scale),
            screen: PageScreen::new(hub.clone(), recording.to_string(), folding),
            sent: Instant::now(),
            pages: 0,
            hub,
        };
        let Some((at, event)) = player.reel.seek(0) else { bail!("{recording} holds no image") };
        // A body that does not fit is an error, unless another garment is in use later on.
        player.hub.dress(player.reel.client())?;
        player.moment(at, &event);
        player.send_state();
        Ok(player)
    }

    /// Plays once a page is open, and obeys orders; never returns.
    pub fn run(mut self) -> Result<()> {
        let mut orders = VecDeque::new();
        while self.hub.pages() == 0 {
            orders = self.hub.orders(Duration::from_millis(20));
        }
        self.obey(&Order::Play(true));
        orders.iter().for_each(|order| self.obey(order));
        loop {
            self.turn();
        }
    }

    /// Waits until there is something to do, and does it.
    fn turn(&mut self) {
        let due = self.reel.peek().map(|(at, _)| at);
        let due = due.into_iter().chain(self.reel.gap()).min();
        for order in self.hub.orders(self.deck.rest(due, Instant::now())) {
            self.obey(&order);
        }
        let go = self.deck.tick(Instant::now());
        self.go(go);
        if std::mem::replace(&mut self.pages, self.hub.pages()) != self.pages {
            self.screen.link(self.reel.client());
        }
        if self.deck.is_playing() && self.sent.elapsed() >= UPDATE {
            self.send_state();
            self.screen.link(self.reel.client());
        } else if matches!(go, Go::To(_)) || (go != Go::Stay && !self.deck.is_playing()) {
            self.send_state();
        }
    }

    fn obey(&mut self, order: &Order) {
        let go = self.deck.obey(order, Instant::now());
        self.go(go);
        self.hub.cut_at(self.deck.range());
        self.send_state();
    }

    fn go(&mut self, go: Go) {
        match go {
            Go::On(until) => self.play(until),
            Go::To(at) => {
                if let Some((at, event)) = self.reel.seek(at) {
                    self.moment(at, &event);
                }
                // Nothing is felt in a gap, whatever the last image before it shows.
                if self.reel.gap().is_some_and(|gap| gap <= at) {
                    self.play(at);
                }
            }
            Go::By(images) => {
                if let Some((at, event)) = self.reel.step(images) {
                    self.deck.stand(at);
                    self.moment(at, &event);
                }
            }
            Go::Stay => {}
        }
    }

    fn moment(&mut self, at: u64, event: &Event) {
        self.screen.moment(self.reel.client(), self.reel.glow(), at, event, self.deck.seeks());
    }

    /// Plays up to a time.
    fn play(&mut self, until: u64) {
        let begun = Instant::now();
        loop {
            while let Some((at, event)) = self.reel.play_gap(until) {
                self.screen.event(self.reel.client(), at, &event, self.deck.seeks());
            }
            let Some((at, _)) = self.reel.peek().filter(|(at, _)| *at <= until) else { return };
            if let Some(event) = self.reel.play() {
                self.screen.event(self.reel.client(), at, &event, self.deck.seeks());
            }
            if begun.elapsed() > TURN {
                if until.saturating_sub(at) > BEHIND {
                    self.deck.hold_back(at, Instant::now());
                }
                return;
            }
        }
    }

    fn send_state(&mut self) {
        self.sent = Instant::now();
        self.hub.state("player", &self.deck.message(self.sent));
    }
}

/// Origin of a recording, and its calibration.
fn origin(clips: &Clips, recording: &BoardRecording, calibration: Option<Calibration>) -> Result<Origin> {
    let name = format!("{CALIBRATION} of {recording}");
    let attached = clips.attached(CALIBRATION).map(|bytes| recording::calibration(bytes, &name));
    let calibration = calibration.or(attached.transpose()?);
    let words = clips.words("taxel");
    let word = |name: &str| words.and_then(|words| words.get(name)).cloned().unwrap_or_default();
    let scale = ForceScale::new(calibration, word("counts_per_newton").parse().ok());
    Ok(Origin { label: word("source"), scale })
}
