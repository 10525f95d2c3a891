//! Between the board's one thread and the threads of the pages.

use super::mailbox::{Mailbox, Shot};
use super::message::{self, Wish};
use super::recent::Recent;
use super::recorded::Order;
use super::said::Said;
use super::tape::{self, Tape};
use crate::recording::Store;
use crate::shared;
use anyhow::{Context, Result};
use std::collections::{BTreeMap, VecDeque};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use taxel_core::garment::Circuit;

/// Pages at a time.
pub const PAGES: usize = 16;
/// Lines of the log that a page is told that comes later.
const LOG: usize = 32;
/// Recordings that are sent at a time: each takes as much memory as what is kept of the board.
const TRANSFERS: usize = 3;
/// Tares that wait at most: one is under way, and one more may be wanted.
const TARES: usize = 2;
/// Orders to the player of a recording that wait at most.
const ORDERS: usize = 64;

/// What all threads know.
#[derive(Default)]
pub struct Hub {
    shared: Mutex<Shared>,
    recent: Mutex<Recent>,
    orders: shared::Shared<VecDeque<Order>>,
    /// Recordings that are being sent, once more for the hub itself.
    transfers: Arc<()>,
}

#[derive(Default)]
struct Shared {
    pages: Vec<Arc<Mailbox>>,
    /// The newest message of each kind.
    known: BTreeMap<&'static str, Arc<str>>,
    log: VecDeque<Arc<str>>,
    circuit: Option<Box<Circuit>>,
    tares: VecDeque<u16>,
    /// The image that holds for who comes later.
    shown: Option<Shot>,
    tape: Option<Tape>,
    /// The part of a recording that is saved, us.
    range: [u64; 2],
}

impl Hub {
    /// A thread that panicked leaves everything as it was.
    fn lock(&self) -> MutexGuard<'_, Shared> {
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn recent(&self) -> MutexGuard<'_, Recent> {
        self.recent.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A new page, told what is known; none: there are too many.
    pub fn join(&self) -> Option<Arc<Mailbox>> {
        let mut shared = self.lock();
        if shared.pages.len() >= PAGES {
            return None;
        }
        let page = Arc::new(Mailbox::default());
        shared.known.iter().for_each(|(kind, line)| page.state(kind, line.clone()));
        shared.log.iter().for_each(|line| page.line(line.clone()));
        shared.shown.iter().for_each(|shot| page.shot(shot));
        shared.pages.push(page.clone());
        Some(page)
    }

    /// A page has gone.
    pub fn leave(&self, page: &Arc<Mailbox>) {
        page.close();
        self.lock().pages.retain(|other| !Arc::ptr_eq(other, page));
    }

    /// Pages that are open.
    pub fn pages(&self) -> usize {
        self.lock().pages.len()
    }

    /// Tells all pages, also those that come later, what holds until the next of its kind.
    pub fn state(&self, kind: &'static str, line: &serde_json::Value) {
        let line: Arc<str> = line.to_string().into();
        let mut shared = self.lock();
        shared.pages.iter().for_each(|page| page.state(kind, line.clone()));
        shared.known.insert(kind, line);
    }

    /// What was told of that kind holds no more.
    pub fn forget(&self, kind: &'static str) {
        self.state(kind, &serde_json::json!({ "type": "none", "of": kind }));
    }

    /// Adds a line to the log.
    pub fn say(&self, said: &Said) {
        let line: Arc<str> = said.message().to_string().into();
        let mut shared = self.lock();
        shared.pages.iter().for_each(|page| page.line(line.clone()));
        shared.log.push_back(line);
        while shared.log.len() > LOG {
            shared.log.pop_front();
        }
    }

    /// Shows an image to all pages.
    pub fn shot(&self, shot: &Shot) {
        self.lock().pages.iter().for_each(|page| page.shot(shot));
    }

    /// Shows an image to all pages, also to those that come before the next.
    pub fn show(&self, shot: Shot) {
        self.shot(&shot);
        self.lock().shown = Some(shot);
    }

    /// The image that comes next does not follow the one that is shown.
    pub fn forget_images(&self) {
        self.lock().pages.iter().for_each(|page| page.forget_images());
    }

    /// How the garment that is worn is wired.
    pub fn wired(&self, circuit: Option<Circuit>) {
        self.lock().circuit = circuit.map(Box::new);
    }

    /// Raw codes of a frame have come.
    pub fn codes(&self, frame: u32, codes: &[u16]) {
        let shared = self.lock();
        for page in &shared.pages {
            let Some(taxel) = page.hovered() else { continue };
            let Some(code) = codes.get(usize::from(taxel)) else { continue };
            let line = message::taxel(taxel, shared.circuit.as_deref(), Some((frame, *code)));
            page.state("taxel", line.to_string().into());
        }
    }

    /// Whether a pointer is on some taxel.
    pub fn is_looked_at(&self) -> bool {
        self.lock().pages.iter().any(|page| page.hovered().is_some())
    }

    /// Does what a page asks for, or keeps it for the board's thread.
    pub fn wish(&self, page: &Mailbox, wish: Wish) {
        let mut shared = self.lock();
        match wish {
            Wish::Hover(taxel) => {
                page.hover(taxel);
                if let Some(taxel) = taxel {
                    let line = message::taxel(taxel, shared.circuit.as_deref(), None);
                    page.state("taxel", line.to_string().into());
                }
            }
            Wish::Tare(frames) if shared.tares.len() < TARES => shared.tares.push_back(frames),
            Wish::Tare(_) => {}
            Wish::Player(order) => self.order(order),
        }
    }

    /// Keeps an order for the player of a recording.
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

    /// Orders that have come, after a wait of so long where there are none.
    pub fn orders(&self, longest: Duration) -> VecDeque<Order> {
        let mut orders = self.orders.lock();
        if orders.is_empty() {
            orders = self.orders.wait(orders, longest);
        }
        std::mem::take(&mut *orders)
    }

    /// What is saved.
    pub fn tape(&self, tape: Tape) {
        self.lock().tape = Some(tape);
    }

    /// The part of the recording that is saved, us.
    pub fn cut_at(&self, range: [u64; 2]) {
        self.lock().range = range;
    }

    /// Whether there is something to save.
    pub fn has_tape(&self) -> bool {
        match &self.lock().tape {
            Some(Tape::Live(_)) => self.recent().is_readable(),
            tape => tape.is_some(),
        }
    }

    /// Writes what is saved, as a recording.
    pub fn save<S: Store>(&self, store: S) -> Result<()> {
        let (tape, range) = {
            let shared = self.lock();
            (shared.tape.clone(), shared.range)
        };
        match tape.context("nothing is there to save")? {
            Tape::Live(origin) => {
                let (bytes, newest) = {
                    let recent = self.recent();
                    (recent.recording().context("no image has come")?, recent.newest())
                };
                tape::live(&bytes, newest, (*origin).clone(), store)
            }
            Tape::Recorded(cut) => cut.write(range, store),
        }
    }

    /// Frames over which a page wants a baseline.
    pub fn tare(&self) -> Option<u16> {
        self.lock().tares.pop_front()
    }

    /// Keeps the bytes of the board.
    pub fn keep(&self, bytes: &[u8]) {
        self.recent().push(bytes);
    }

    /// The right to send a recording while it is kept; none: as many as can be are being sent.
    pub fn transfer(&self) -> Option<Arc<()>> {
        // With the lock, so that two that come at once are counted one after the other.
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
    use super::super::mailbox::Parcel;
    use super::*;
    use serde_json::json;

    #[test]
    fn a_page_that_comes_late_is_told_what_is_known() {
        let hub = Hub::default();
        hub.state("link", &json!(1));
        hub.state("link", &json!(2));
        (0..100).for_each(|n| hub.say(&Said::note(n.to_string())));
        let page = hub.join().unwrap();
        assert_eq!(page.next(), Parcel::Line("2".into()));
        let Parcel::Line(line) = page.next() else { panic!("no line") };
        assert_eq!(serde_json::from_str::<serde_json::Value>(&line).unwrap()["text"], "68");
        hub.leave(&page);
        assert_eq!(page.next(), Parcel::Closed);
        let many: Vec<_> = std::iter::from_fn(|| hub.join()).take(2 * PAGES).collect();
        assert_eq!((many.len(), hub.pages()), (PAGES, PAGES));
    }

    #[test]
    fn a_code_is_told_to_who_looks_at_it() {
        let hub = Hub::default();
        let (one, other) = (hub.join().unwrap(), hub.join().unwrap());
        hub.wish(&one, Wish::Hover(Some(1)));
        hub.wish(&other, Wish::Hover(Some(9)));
        assert!(hub.is_looked_at());
        hub.codes(7, &[5, 6]);
        let told = |page: &Mailbox| {
            let Parcel::Line(line) = page.next() else { panic!("no line") };
            serde_json::from_str::<serde_json::Value>(&line).unwrap()["code"].clone()
        };
        assert_eq!((told(&one), told(&other)), (json!(6), json!(null)));
        (0..9).for_each(|_| hub.wish(&one, Wish::Tare(16)));
        assert_eq!(std::iter::from_fn(|| hub.tare()).count(), TARES);
    }
}
