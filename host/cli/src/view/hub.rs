//! Connects the board's thread with the threads of the pages.

use super::hand::PageHand;
use super::kept_log::KeptLog;
use super::lines::NoneLine;
use super::mailbox::Mailbox;
use super::message::{self, PageRequest, SettingsOrder};
use super::order::Order;
use super::recent::Recent;
use super::said::Said;
use super::setup::SetupOrder;
use super::shot::{Shot, text};
use super::tape::{self, Tape};
use crate::on_robot::ShownRobot;
use anyhow::{Context, Result};
use serde::Serialize;
use std::collections::{BTreeMap, VecDeque};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use taxel::client::{Client, Event};
use taxel::fcm::map::MapFile;
use taxel::files::calibrate::ForceScale;
use taxel::recording::Store;
use taxel::source::shared;
use taxel_core::garment::{Circuit, Pins};
use taxel_core::wire::PressingReport;

/// Most pages at a time.
pub const PAGES: usize = 16;
/// Recordings sent at a time: each takes as much memory as the bytes kept of the board.
const TRANSFERS: usize = 3;
/// Most tares queued: one in progress, and another.
const TARES: usize = 2;
/// Most settings queued for the board.
const SETTINGS: usize = 16;
/// Most orders queued for the player of a recording.
const ORDERS: usize = 64;

/// State shared by all threads.
#[derive(Default)]
pub struct PageHub {
    shared: Mutex<PageShared>,
    recent: Mutex<Recent>,
    shown_robot: Mutex<Option<ShownRobot>>,
    orders: shared::Shared<VecDeque<Order>>,
    /// One reference per recording being sent, plus the hub's own.
    transfers: Arc<()>,
}

#[derive(Default)]
struct PageShared {
    pages: Vec<Arc<Mailbox>>,
    /// Number of the next page.
    next: u64,
    /// Presses the garment; none unless the board is simulated.
    hand: Option<PageHand>,
    /// The newest message of each kind.
    known: BTreeMap<&'static str, Arc<str>>,
    log: KeptLog,
    circuit: Option<Box<Circuit>>,
    /// Scale of forces, for images of the past.
    scale: ForceScale,
    counts_per_newton: Option<f64>,
    /// The map of the scene.
    map: Option<Arc<MapFile>>,
    tares: VecDeque<u16>,
    settings: VecDeque<SetupOrder>,
    /// Pages may only look.
    is_read_only: bool,
    /// The image for pages that come later.
    shown: Option<Shot>,
    tape: Option<Tape>,
    /// Range of the recording that is saved, us.
    range: [u64; 2],
}

impl PageShared {
    /// Queues a setting. Limits replace those that wait.
    fn set(&mut self, order: SetupOrder) {
        if let (SetupOrder::Set(_), Some(SetupOrder::Set(_))) = (order, self.settings.back()) {
            self.settings.pop_back();
        }
        if self.settings.len() < SETTINGS {
            self.settings.push_back(order);
        }
    }
}

impl PageHub {
    /// The hub of one of so many boards, which together keep as many bytes as one.
    pub fn among(boards: usize) -> PageHub {
        PageHub { recent: Mutex::new(Recent::among(boards)), ..PageHub::default() }
    }

    /// Locks the state. A panic of another thread does not invalidate it.
    fn lock(&self) -> MutexGuard<'_, PageShared> {
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn recent(&self) -> MutexGuard<'_, Recent> {
        self.recent.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The robot that carries the garment; none if pages do not show it.
    pub fn shown_robot(&self) -> MutexGuard<'_, Option<ShownRobot>> {
        self.shown_robot.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Shows the garment on this robot.
    pub fn show_robot(&self, robot: ShownRobot) {
        *self.shown_robot() = Some(robot);
    }

    /// The robot carries the garment of the last `Hello`. The error says why it does not fit, and pages show none.
    pub fn dress(&self, client: &Client) -> Result<()> {
        let mut shown_robot = self.shown_robot();
        let (Some(shown_robot), Some(description)) = (&mut *shown_robot, client.description()) else {
            return Ok(());
        };
        if shown_robot.has(description) {
            return Ok(());
        }
        let fits = shown_robot.put_on(description);
        match shown_robot.body() {
            Some(body) => self.state("body", &body),
            None => self.forget("body"),
        }
        shown_robot.poses().iter().for_each(|poses| self.state("poses", poses));
        shown_robot.figure().iter().for_each(|figure| self.state("figure", figure));
        shown_robot.lacks().into_iter().for_each(|why| self.say(&Said::note(why)));
        fits
    }

    /// Joints of the robot have come to these positions, rad or m: see [`ShownRobot::pose`].
    pub fn joints(&self, positions: &[(String, f64)]) -> Result<()> {
        let mut shown_robot = self.shown_robot();
        let Some(shown_robot) = &mut *shown_robot else { return Ok(()) };
        let Some(posture) = shown_robot.moved(positions) else { return Ok(()) };
        if shown_robot.pose(posture)? {
            shown_robot.body().iter().for_each(|body| self.state("body", body));
        }
        shown_robot.poses().iter().for_each(|poses| self.state("poses", poses));
        Ok(())
    }

    /// Handles a report of the board about what presses on the robot.
    pub fn heard(&self, report: &PressingReport) {
        self.shown_robot().iter_mut().for_each(|shown_robot| shown_robot.take(report));
    }

    /// Adds a page with the current state; none if there are too many pages.
    pub fn join(&self) -> Option<Arc<Mailbox>> {
        let mut shared = self.lock();
        if shared.pages.len() >= PAGES {
            return None;
        }
        let page = Arc::new(Mailbox::numbered(shared.next));
        shared.next += 1;
        shared.known.iter().for_each(|(kind, line)| page.state(kind, line.clone()));
        shared.log.message().iter().for_each(|log| page.state("log", text(log)));
        shared.shown.iter().for_each(|shot| page.shot(shot));
        shared.pages.push(page.clone());
        Some(page)
    }

    /// Removes a page.
    pub fn leave(&self, page: &Arc<Mailbox>) {
        page.close();
        let mut shared = self.lock();
        shared.pages.retain(|other| !Arc::ptr_eq(other, page));
        shared.hand.iter().for_each(|hand| hand.leave(page.number()));
    }

    /// Lets pages press the garment.
    pub fn hand(&self, hand: PageHand) {
        self.lock().hand = Some(hand);
    }

    /// Sends pages how the hand is, if that has changed.
    pub fn announce_hand(&self) {
        let mut shared = self.lock();
        let is_read_only = shared.is_read_only;
        let news = shared.hand.as_mut().filter(|_| !is_read_only).and_then(PageHand::news);
        drop(shared);
        news.iter().for_each(|line| self.state("hand", line));
    }

    /// The script's file of what was pressed; none if nothing can be.
    pub fn touches(&self) -> Option<Result<String>> {
        let hand = self.lock().hand.clone();
        hand.map(|hand| hand.script())
    }

    /// Number of open pages.
    pub fn pages(&self) -> usize {
        self.lock().pages.len()
    }

    /// Sends a message to all pages, and to later ones until the next message of its kind.
    pub fn state(&self, kind: &'static str, line: &impl Serialize) {
        self.announce(kind, text(line));
    }

    /// Sends a state to all pages, of a message that is encoded already.
    pub fn announce(&self, kind: &'static str, line: Arc<str>) {
        let mut shared = self.lock();
        shared.pages.iter().for_each(|page| page.state(kind, line.clone()));
        shared.known.insert(kind, line);
    }

    /// Withdraws the current message of a kind.
    pub fn forget(&self, kind: &'static str) {
        self.state(kind, &NoneLine { of: kind });
    }

    /// Adds a line to the log.
    pub fn say(&self, said: &Said) {
        let line = text(&said.message());
        let mut shared = self.lock();
        shared.pages.iter().for_each(|page| page.line(line.clone()));
        shared.log.push(said.clone());
    }

    /// Sends an image to all pages.
    pub fn shot(&self, shot: &Shot) {
        self.lock().pages.iter().for_each(|page| page.shot(shot));
    }

    /// Sends an image to all pages, and to later ones until the next image.
    pub fn show(&self, shot: Shot) {
        self.shot(&shot);
        self.lock().shown = Some(shot);
    }

    /// The next image does not follow the current one.
    pub fn forget_images(&self) {
        self.lock().pages.iter().for_each(|page| page.forget_images());
    }

    /// Shows the garment and the scene of the last `Hello`.
    pub fn greet(&self, client: &Client, label: &str) {
        let description = client.description();
        let circuit = description.and_then(|description| {
            Circuit::build(&description.garment, &description.layout, Pins::ANY).ok()
        });
        let intent = description.and_then(|description| description.scene.intent.as_ref());
        {
            let mut shared = self.lock();
            shared.circuit = circuit.map(Box::new);
            shared.map = intent.map(|intent| Arc::new(MapFile::from_config(&intent.map)));
            shared.scale = client.scale().clone();
            shared.counts_per_newton = client.counts_per_newton();
        }
        self.state("hello", &message::hello(client, label));
    }

    /// Counts per newton on the garment; none if unknown.
    pub fn counts_per_newton(&self) -> Option<f64> {
        self.lock().counts_per_newton
    }

    /// Scale of forces.
    pub fn scale(&self) -> ForceScale {
        self.lock().scale.clone()
    }

    /// Handles the raw codes of a frame.
    pub fn codes(&self, frame: u32, codes: &[u16]) {
        let shared = self.lock();
        for page in &shared.pages {
            let Some(taxel) = page.hovered() else { continue };
            let Some(code) = codes.get(usize::from(taxel)) else { continue };
            let line = message::taxel(taxel, shared.circuit.as_deref(), Some((frame, *code)));
            page.state("taxel", text(&line));
        }
    }

    /// Lets pages look alone: what they ask of the board is not done.
    pub fn read_only(&self) {
        self.lock().is_read_only = true;
    }

    /// True if pages may only look.
    pub fn is_read_only(&self) -> bool {
        self.lock().is_read_only
    }

    /// True if a pointer is on a taxel.
    pub fn is_looked_at(&self) -> bool {
        self.lock().pages.iter().any(|page| page.hovered().is_some())
    }

    /// Handles a page's request, or queues it for the board's thread.
    pub fn request(&self, page: &Mailbox, request: PageRequest) {
        let mut shared = self.lock();
        if shared.is_read_only && request.changes() {
            return;
        }
        match request {
            PageRequest::Hover(taxel) => {
                page.hover(taxel);
                if let Some(taxel) = taxel {
                    let line = message::taxel(taxel, shared.circuit.as_deref(), None);
                    page.state("taxel", text(&line));
                }
            }
            PageRequest::Tare(frames) if shared.tares.len() < TARES => shared.tares.push_back(frames),
            PageRequest::Tare(_) => {}
            PageRequest::Why { of, concepts } => {
                let map = shared.map.clone();
                drop(shared);
                let why = map.and_then(|map| message::why(&map, of.as_deref(), &concepts));
                page.state("why", why.map_or_else(|| text(&NoneLine { of: "why" }), |why| text(&why)));
            }
            PageRequest::Press(finger) => {
                shared.hand.iter().for_each(|hand| hand.press(page.number(), finger.clone()))
            }
            PageRequest::Release(finger) => {
                shared.hand.iter().for_each(|hand| hand.release(page.number(), finger))
            }
            PageRequest::Hand(order) => shared.hand.iter().for_each(|hand| hand.order(order)),
            PageRequest::Script(name) => {
                let hand = shared.hand.clone();
                drop(shared);
                if let Some(Err(error)) = hand.map(|hand| hand.play(&name)) {
                    self.say(&Said::note(format!("{name} is not played: {error:#}")));
                }
            }
            PageRequest::Limits(limits) => shared.set(SetupOrder::Set(limits)),
            PageRequest::Setup(SettingsOrder::Undo) => shared.set(SetupOrder::Undo),
            PageRequest::Setup(SettingsOrder::Save) => shared.set(SetupOrder::Save),
            PageRequest::Player(order) => self.order(order),
        }
    }

    /// Queues an order for the player of a recording.
    fn order(&self, order: Order) {
        self.orders.change(|orders| {
            if orders.back().is_some_and(|waiting| order.replaces(waiting)) {
                orders.pop_back();
            }
            if orders.len() < ORDERS {
                orders.push_back(order);
            }
        });
    }

    /// Takes the queued orders, after waiting up to `longest` if there are none.
    pub fn orders(&self, longest: Duration) -> VecDeque<Order> {
        let mut orders = self.orders.lock();
        if orders.is_empty() {
            orders = self.orders.wait(orders, longest);
        }
        std::mem::take(&mut *orders)
    }

    /// Sets what can be saved.
    pub fn tape(&self, tape: Tape) {
        self.lock().tape = Some(tape);
    }

    /// Sets the range of the recording that is saved, us.
    pub fn cut_at(&self, range: [u64; 2]) {
        self.lock().range = range;
    }

    /// True if there is something to save.
    pub fn has_tape(&self) -> bool {
        match &self.lock().tape {
            Some(Tape::Live(_)) => self.recent().is_readable(),
            tape => tape.is_some(),
        }
    }

    /// Writes what is saved as a recording.
    pub fn save(&self, store: &mut dyn Store) -> Result<()> {
        let (tape, range) = {
            let shared = self.lock();
            (shared.tape.clone(), shared.range)
        };
        match tape.context("there is nothing to save")? {
            Tape::Live(origin) => {
                let (bytes, newest) = {
                    let recent = self.recent();
                    (recent.recording().context("no image was received")?, recent.newest())
                };
                tape::live(&bytes, newest, (*origin).clone(), store)
            }
            Tape::Recorded(cut) => cut.write(range, store),
        }
    }

    /// Takes the frames of a tare that a page requests.
    pub fn tare(&self) -> Option<u16> {
        self.lock().tares.pop_front()
    }

    /// Takes what pages set on the board.
    pub fn settings(&self) -> VecDeque<SetupOrder> {
        std::mem::take(&mut self.lock().settings)
    }

    /// Keeps the bytes of an event.
    pub fn keep(&self, client: &Client, event: &Event) {
        self.recent().take(client, event);
    }

    /// Permission to send a recording, held while sending; none if too many are being sent.
    pub fn transfer(&self) -> Option<Arc<()>> {
        // Under the lock, so that concurrent calls are counted one after the other.
        let _shared = self.lock();
        (Arc::strong_count(&self.transfers) <= TRANSFERS).then(|| self.transfers.clone())
    }

    /// See [`Recent::recording`].
    pub fn recording(&self) -> Option<Vec<u8>> {
        self.recent().recording()
    }
}

#[cfg(test)]
mod tests {
    use super::super::limits::SceneLimits;
    use super::super::mailbox::Parcel;
    use super::*;
    use serde_json::json;
    use taxel_core::scene::Scene;

    #[test]
    fn a_page_that_comes_late_is_sent_what_is_known() {
        let hub = PageHub::default();
        hub.state("link", &json!(1));
        hub.state("link", &json!(2));
        let said = |n: u64| Said { time_us: Some(n * 1_000_000), ..Said::note(n.to_string()) };
        (0..600).for_each(|n| hub.say(&said(n)));
        let page = hub.join().unwrap();
        assert_eq!(page.next(), Parcel::Line("2".into()));
        let Parcel::Line(line) = page.next() else { panic!("no line") };
        let said = serde_json::from_str::<serde_json::Value>(&line).unwrap()["said"].take();
        assert_eq!((said[0]["said"].as_str(), said.as_array().unwrap().len()), (Some("88"), 512));
        hub.leave(&page);
        assert_eq!(page.next(), Parcel::Closed);
        let many: Vec<_> = std::iter::from_fn(|| hub.join()).take(2 * PAGES).collect();
        assert_eq!((many.len(), hub.pages()), (PAGES, PAGES));
    }

    #[test]
    fn a_code_is_sent_to_who_looks_at_it() {
        let hub = PageHub::default();
        let (one, other) = (hub.join().unwrap(), hub.join().unwrap());
        hub.request(&one, PageRequest::Hover(Some(1)));
        hub.request(&other, PageRequest::Hover(Some(9)));
        assert!(hub.is_looked_at());
        hub.codes(7, &[5, 6]);
        let reported = |page: &Mailbox| {
            let Parcel::Line(line) = page.next() else { panic!("no line") };
            serde_json::from_str::<serde_json::Value>(&line).unwrap()["code"].clone()
        };
        assert_eq!((reported(&one), reported(&other)), (json!(6), json!(null)));
        (0..9).for_each(|_| hub.request(&one, PageRequest::Tare(16)));
        assert_eq!(std::iter::from_fn(|| hub.tare()).count(), TARES);
    }

    #[test]
    fn a_page_that_only_looks_changes_nothing() {
        let asked = |hub: &PageHub| {
            let page = hub.join().unwrap();
            let limits = SceneLimits::of(&Scene::shipped());
            for request in [
                PageRequest::Tare(16),
                PageRequest::Limits(SceneLimits { high: 99, ..limits }),
                PageRequest::Limits(limits),
                PageRequest::Setup(SettingsOrder::Save),
            ] {
                hub.request(&page, request);
            }
            (hub.tare(), Vec::from(hub.settings()))
        };
        let set = vec![SetupOrder::Set(SceneLimits::of(&Scene::shipped())), SetupOrder::Save];
        assert_eq!(asked(&PageHub::default()), (Some(16), set));
        let looked_at = PageHub::default();
        looked_at.read_only();
        assert_eq!(asked(&looked_at), (None, Vec::new()));
    }
}
