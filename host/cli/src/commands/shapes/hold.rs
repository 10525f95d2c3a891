//! Turns objects held against a board into prototypes.

use taxel::client::{Client, Event, ImageNews, Stamp};
use taxel::learn::shapes::cluster::centres;
use taxel::session::Observer;
use taxel_core::condition::{Image, Rows};
use taxel_core::contact::{Contact, ContactState};
use taxel_core::format::Micros;
use taxel_core::shape::{Descriptor, Point, Space, seen};

/// Duration from which a touch counts as held, ms.
const HELD: u32 = 300;
/// Contacts at a time, as on a board.
const CONTACTS: usize = 32;
/// Runs of a row: enough for twice the taxels of a board.
const RUNS: usize = 2048;

/// Watches a board until enough touches were held. Contacts are described as on a board, from the same image.
pub struct Hold<'a> {
    space: &'a Space,
    /// Number of touches wanted.
    wanted: usize,
    contacts: Box<ContactState<CONTACTS, RUNS>>,
    /// Present contacts.
    open: Vec<HeldContact>,
    /// A point for each held touch.
    pub held: Vec<Point>,
}

/// A present contact.
struct HeldContact {
    id: u32,
    duration_ms: u32,
    /// Total and description by frame.
    course: Vec<(u32, Descriptor)>,
}

impl<'a> Hold<'a> {
    /// Waits for `wanted` touches, as points in a space.
    pub fn new(space: &'a Space, wanted: usize) -> Hold<'a> {
        Hold { space, wanted, contacts: Box::default(), open: Vec::new(), held: Vec::new() }
    }

    /// Handles an image scanned at `time`.
    fn frame(&mut self, client: &Client, time: Micros) -> taxel::Result<()> {
        let (Some(description), Some((_, values))) = (client.description(), client.image()) else {
            return Ok(());
        };
        let image = Image { values, rows: &Rows::ALL };
        let stage = description.scene.contact.build().map_err(taxel::Error::other)?;
        let touches = stage.process(&mut self.contacts, &description.layout, &image, time);
        let (present, released) = (touches.present.to_vec(), touches.released.to_vec());
        for (index, contact) in present.iter().enumerate() {
            if let Some(descriptor) = seen(&self.contacts, &description.layout, &image, (index, contact)) {
                self.open(contact).course.push((contact.total, descriptor));
            }
        }
        for contact in released {
            if let Some(at) = self.open.iter().position(|open| open.id == contact.id) {
                let ended = self.open.remove(at);
                self.end(&ended);
            }
        }
        Ok(())
    }

    fn open(&mut self, contact: &Contact) -> &mut HeldContact {
        let known = self.open.iter().position(|open| open.id == contact.id);
        let at = known.unwrap_or_else(|| {
            self.open.push(HeldContact { id: contact.id, duration_ms: 0, course: Vec::new() });
            self.open.len() - 1
        });
        let open = &mut self.open[at];
        open.duration_ms = contact.duration_ms;
        open
    }

    /// Adds a held touch as one point: the mean over the time of firm contact, because its onset and release
    /// look different.
    fn end(&mut self, open: &HeldContact) {
        if self.held.len() >= self.wanted {
            return;
        }
        let most = open.course.iter().map(|(total, _)| *total).max().unwrap_or(0);
        let firm = open.course.iter().filter(|(total, _)| *total >= most - most / 4);
        let places: Vec<Point> = firm.map(|(_, descriptor)| self.space.place(descriptor)).collect();
        let seconds = f64::from(open.duration_ms) / 1000.0;
        if open.duration_ms < HELD {
            eprintln!("held for {seconds:.1} s: too short; hold a touch for half a second");
        } else {
            self.held.extend(centres(&places, 1));
            eprintln!("{} of {}: held for {seconds:.1} s", self.held.len(), self.wanted);
        }
    }
}

impl Observer for Hold<'_> {
    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        match event {
            // Another garment: present contacts will not end.
            Event::Hello => {
                self.contacts.reset();
                self.open.clear();
                Ok(())
            }
            Event::Frame { time, image: ImageNews::Whole, .. } => self.frame(client, *time),
            _ => Ok(()),
        }
    }

    fn is_done(&self) -> bool {
        self.held.len() >= self.wanted
    }

    fn ended(&mut self, _: &Client, _: Stamp) -> taxel::Result<()> {
        for open in std::mem::take(&mut self.open) {
            self.end(&open);
        }
        Ok(())
    }
}
