//! Between the board's one thread and the threads of the pages.

use super::mailbox::{Mailbox, Shot};
use super::message::{self, Wish};
use super::recent::Recent;
use std::collections::{BTreeMap, VecDeque};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use taxel_core::garment::Circuit;

/// Pages at a time.
pub const PAGES: usize = 16;
/// Lines of the log that a page is told that comes later.
const LOG: usize = 32;
/// Tares that wait at most: one is under way, and one more may be wanted.
const TARES: usize = 2;

/// What all threads know.
#[derive(Default)]
pub struct Hub {
    shared: Mutex<Shared>,
    recent: Mutex<Recent>,
}

#[derive(Default)]
struct Shared {
    pages: Vec<Arc<Mailbox>>,
    /// The newest message of each kind.
    known: BTreeMap<&'static str, Arc<str>>,
    log: VecDeque<Arc<str>>,
    circuit: Option<Box<Circuit>>,
    tares: VecDeque<u16>,
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

    /// Adds a line to the log.
    pub fn say(&self, text: &str) {
        let line: Arc<str> = serde_json::json!({ "type": "say", "text": text }).to_string().into();
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
        (0..100).for_each(|n| hub.say(&n.to_string()));
        let page = hub.join().unwrap();
        assert_eq!(page.next(), Parcel::Line("2".into()));
        assert_eq!(page.next(), Parcel::Line(r#"{"type":"say","text":"68"}"#.into()));
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
