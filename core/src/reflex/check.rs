//! The check of a sub-field.

use super::agree::{Agree, Recent};
use super::watched::{ROWS, Reflexes};
use crate::acquire::{Fields, Read};
use crate::format::{Code, Micros};
use heapless::{Deque, Vec};

/// Codes that the loop takes at a time: as the compiler unrolls it.
const CHUNK: usize = 4;
/// Taxels of a sub-field and an input that are judged: the first that are beyond their limits.
const JUDGED: usize = 8;
/// Limits that are set anew with each frame, once all were; and until then.
const RENEWED: usize = 16;
const FILLED: usize = 64;
/// Where the code of an input goes that reads nothing: beyond every frame.
const NOWHERE: u16 = u16::MAX;

/// A taxel in the order of the scan.
#[derive(Debug, Clone, Copy)]
struct Entry {
    taxel: u16,
    /// The last code that is quiet; where pressure lowers the code, inverted.
    limit: u16,
}

/// A reflex that began.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Early {
    /// Its place in the scene's table of reactions.
    pub index: u8,
    /// When the sub-field had been read.
    pub time: Micros,
    /// Number of the taxel that decided.
    pub taxel: u16,
    /// Its code.
    pub code: Code,
    /// The other one, where two have to agree.
    pub other: Option<u16>,
}

/// What is remembered from sub-field to sub-field.
#[derive(Debug, Clone)]
pub struct Reflex<const TAXELS: usize> {
    entries: [Entry; TAXELS],
    fields: Fields,
    falling: bool,
    reflexes: Reflexes,
    /// Entry whose limit is set anew next.
    next: u16,
    /// All limits hold.
    armed: bool,
    /// Rows that have begun and are not at rest again, a bit each.
    begun: u8,
    untold: Deque<Early, ROWS>,
    recent: Recent,
}

impl<const TAXELS: usize> Reflex<TAXELS> {
    /// Of no scan. All bytes are 0.
    pub const fn new() -> Self {
        Reflex {
            entries: [Entry { taxel: 0, limit: 0 }; TAXELS],
            fields: Fields::none(),
            falling: false,
            reflexes: Reflexes::none(),
            next: 0,
            armed: false,
            begun: 0,
            untold: Deque::new(),
            recent: Recent::new(),
        }
    }

    /// Another order of the scan, whose taxels are told by [`Reflex::order`]. Nothing is watched until all
    /// limits are set.
    pub fn begin(&mut self, fields: Fields, falling: bool) {
        (self.fields, self.falling) = (fields, falling);
        self.entries.fill(Entry { taxel: NOWHERE, limit: u16::MAX });
        self.disarm();
    }

    /// Which taxels the inputs read at an address of a sub-field.
    pub fn order(&mut self, field: usize, address: usize, taxels: Read) {
        let (inputs, addresses) = (self.fields.inputs().len(), self.fields.addresses(field));
        let first = self.fields.span(field).start + address;
        for (input, taxel) in taxels.into_iter().take(inputs).enumerate() {
            let slot = self.entries.get_mut(first + input * addresses);
            slot.into_iter().for_each(|entry| entry.taxel = taxel.unwrap_or(NOWHERE));
        }
    }

    /// What is to be watched from now on; none: nothing, for now. `active`: the rows whose reactions last, a
    /// bit each. `limit`: the last code of a taxel that is quiet; none where it is not watched. To be called
    /// with each frame: the limits follow the baseline by and by.
    pub fn watch(&mut self, reflexes: Option<&Reflexes>, active: u8, limit: impl Fn(u16) -> Option<u16>) {
        let Some(reflexes) = reflexes else { return self.disarm() };
        if self.reflexes != *reflexes {
            self.reflexes = reflexes.clone();
            self.begun = 0;
            self.untold.clear();
            self.disarm();
        }
        // What has no pin is at rest as soon as its reaction has ended; the others when the pin is.
        let pinned = self.reflexes.rows().iter().filter(|row| row.output.is_some());
        let untold = self.untold.iter().fold(0, |mask, early| mask | 1 << (early.index & 7));
        self.begun &= active | untold | pinned.fold(0, |mask, row| mask | row.bit());
        if reflexes.is_empty() {
            return;
        }
        let flip = if self.falling { u16::MAX } else { 0 };
        for _ in 0..if self.armed { RENEWED } else { FILLED } {
            let Some(entry) = self.entries.get_mut(usize::from(self.next)) else { break };
            entry.limit = limit(entry.taxel).map_or(u16::MAX, |code| code ^ flip);
            self.next += 1;
            if usize::from(self.next) >= self.fields.before(self.fields.count()) * self.fields.inputs().len()
            {
                (self.next, self.armed) = (0, true);
                break;
            }
        }
    }

    fn disarm(&mut self) {
        (self.next, self.armed) = (0, false);
        self.recent.clear();
    }

    /// Takes the codes of a sub-field, those of one input after those of the other, and puts them into their
    /// places of `frame`, by taxel number. A mask of the rows that begin, whose pins are to be asserted.
    pub fn check(&mut self, field: usize, codes: &[Code], frame: &mut [Code], now: Micros) -> u8 {
        self.recent.turn();
        let addresses = self.fields.addresses(field).max(1);
        let first = self.fields.span(field).start;
        let before = self.begun;
        for (input, codes) in codes.chunks(addresses).enumerate() {
            let at = first + input * addresses;
            let Some(entries) = self.entries.get(at..at + codes.len()) else { break };
            let mut loud = Loud::new();
            let watches = self.armed && self.reflexes.rows().iter().any(|row| self.begun & row.bit() == 0);
            match (watches, self.falling) {
                (true, false) => place_and_find::<false>(codes, entries, frame, &mut loud),
                (true, true) => place_and_find::<true>(codes, entries, frame, &mut loud),
                (false, _) => codes.iter().zip(entries).for_each(|(code, entry)| put(*code, *entry, frame)),
            }
            loud.into_iter().for_each(|(taxel, code)| self.judge(field, taxel, code, now));
        }
        self.begun & !before
    }

    /// A taxel is beyond its limit.
    #[inline(never)] // M0+: out of line
    fn judge(&mut self, field: usize, taxel: u16, code: Code, now: Micros) {
        let Some(row) = self.reflexes.row_of(taxel).copied() else { return };
        let Some(spot) = self.reflexes.spot(taxel).filter(|_| self.begun & row.bit() == 0) else { return };
        let other = self.recent.agree(taxel, spot, field, self.fields.count());
        if row.agree == Agree::One || other.is_some() {
            self.begun |= row.bit();
            // There is room for every row, and a row begins again only when it was told.
            let _ = self.untold.push_back(Early { index: row.index, time: now, taxel, code, other });
        }
    }

    /// The pins of some rows and the level at which they are asserted.
    pub fn pins(&self, mask: u8) -> impl Iterator<Item = (u8, bool)> + '_ {
        let rows = self.reflexes.rows().iter().filter(move |row| mask & row.bit() != 0);
        rows.filter_map(|row| row.output).map(|line| (line.pin, !line.inverted))
    }

    /// Somebody else has put a pin to a level: a row that is at rest by that may begin again.
    pub fn driven(&mut self, pin: u8, level: bool) {
        let at_rest = |line: crate::garment::Line| line.pin == pin && line.inverted == level;
        let rows = self.reflexes.rows().iter().filter(|row| row.output.is_some_and(at_rest));
        self.begun &= !rows.fold(0, |mask, row| mask | row.bit());
    }

    /// The next reflex that was not told yet.
    pub fn told(&mut self) -> Option<Early> {
        self.untold.pop_front()
    }

    /// The sub-fields of the scan.
    pub fn fields(&self) -> &Fields {
        &self.fields
    }
}

impl<const TAXELS: usize> Default for Reflex<TAXELS> {
    fn default() -> Self {
        Self::new()
    }
}

/// Taxels beyond their limits, and their codes.
type Loud = Vec<(u16, Code), JUDGED>;

/// Puts codes into their places, and finds those beyond their limits.
#[inline(never)] // M0+: out of line
fn place_and_find<const FALLING: bool>(
    codes: &[Code],
    entries: &[Entry],
    frame: &mut [Code],
    loud: &mut Loud,
) {
    let mut take = |code: &Code, entry: &Entry| {
        put(*code, *entry, frame);
        let pressed = if FALLING { !code.0 } else { code.0 };
        if pressed > entry.limit {
            find(loud, entry.taxel, *code);
        }
    };
    let (chunks, rest) = codes.as_chunks::<CHUNK>();
    let (entry_chunks, entry_rest) = entries.as_chunks::<CHUNK>();
    for (codes, entries) in chunks.iter().zip(entry_chunks) {
        codes.iter().zip(entries).for_each(|(code, entry)| take(code, entry));
    }
    rest.iter().zip(entry_rest).for_each(|(code, entry)| take(code, entry));
}

/// Puts a code into its place, if it has one.
#[inline(always)]
fn put(code: Code, entry: Entry, frame: &mut [Code]) {
    if let Some(slot) = frame.get_mut(usize::from(entry.taxel)) {
        *slot = code;
    }
}

/// A taxel is beyond its limit; those past the last are not judged.
#[cold]
#[inline(never)] // M0+: out of line, so that the loop keeps its registers
fn find(loud: &mut Loud, taxel: u16, code: Code) {
    let _ = loud.push((taxel, code));
}
