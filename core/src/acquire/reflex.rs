//! The check of a sub-field's codes as soon as they are read.

use super::{Fields, Read};
use crate::format::{Code, Micros};
use crate::reflex::{Agree, Early, ROWS, Recent, Reflexes};
use heapless::{Deque, Vec};

/// Codes per iteration of the loop, which the compiler unrolls.
const CHUNK: usize = 4;
/// Most taxels judged per sub-field and input: the first that are beyond their limits.
const JUDGED: usize = 8;
/// Limits updated per frame: once all have been set, and before.
const RENEWED: usize = 16;
const FILLED: usize = 64;
/// Index of the code of an input that reads nothing: beyond every frame.
const NOWHERE: u16 = u16::MAX;

/// A taxel, in the order of the scan.
#[derive(Debug, Clone, Copy)]
struct WatchedTaxel {
    taxel: u16,
    /// Last inactive code; inverted if pressure lowers the code.
    limit: u16,
}

/// State of the check from sub-field to sub-field.
#[derive(Debug, Clone)]
pub struct Reflex<const TAXELS: usize> {
    entries: [WatchedTaxel; TAXELS],
    fields: Fields,
    falling: bool,
    reflexes: Reflexes,
    /// Taxel whose limit is updated next.
    next: u16,
    /// True once all limits are set.
    armed: bool,
    /// Mask of the rows that have begun and are not at rest again.
    begun: u8,
    untold: Deque<Early, ROWS>,
    recent: Recent,
}

impl<const TAXELS: usize> Reflex<TAXELS> {
    /// No scan is checked. All bytes are 0.
    pub const fn new() -> Self {
        Reflex {
            entries: [WatchedTaxel { taxel: 0, limit: 0 }; TAXELS],
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

    /// Sets the sub-fields of another scan; [`Reflex::order`] then sets their taxels. Nothing is watched
    /// until all limits are set.
    pub fn begin(&mut self, fields: Fields, falling: bool) {
        (self.fields, self.falling) = (fields, falling);
        self.entries.fill(WatchedTaxel { taxel: NOWHERE, limit: u16::MAX });
        self.disarm();
    }

    /// Sets the taxels that the inputs read at an address of a sub-field.
    pub fn order(&mut self, field: usize, address: usize, taxels: Read) {
        let (inputs, addresses) = (self.fields.inputs().len(), self.fields.addresses(field));
        let first = self.fields.span(field).start + address;
        for (input, taxel) in taxels.into_iter().take(inputs).enumerate() {
            let slot = self.entries.get_mut(first + input * addresses);
            slot.into_iter().for_each(|entry| entry.taxel = taxel.unwrap_or(NOWHERE));
        }
    }

    /// Sets what is checked from now on; no `reflexes`: nothing is. `active`: mask of the rows whose
    /// reactions last. `limit`: last inactive code of a taxel, none for taxels that are not watched. Call it
    /// once per frame: each call updates some of the limits, which thus follow the baseline.
    pub fn watch(&mut self, reflexes: Option<&Reflexes>, active: u8, limit: impl Fn(u16) -> Option<u16>) {
        let Some(reflexes) = reflexes else { return self.disarm() };
        if self.reflexes != *reflexes {
            self.reflexes = reflexes.clone();
            self.begun = 0;
            self.untold.clear();
            self.disarm();
        }
        // A row without a pin is at rest when its reaction has ended, one with a pin when the pin is.
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

    /// Stores the codes of a sub-field, those of one input after those of the previous, in `frame` by taxel
    /// number. Returns a mask of the rows that begin, whose pins are to be asserted.
    pub fn check(&mut self, field: usize, codes: &[Code], frame: &mut [Code], now: Micros) -> u8 {
        self.recent.turn();
        let addresses = self.fields.addresses(field).max(1);
        let first = self.fields.span(field).start;
        let before = self.begun;
        for (input, codes) in codes.chunks(addresses).enumerate() {
            let at = first + input * addresses;
            let Some(entries) = self.entries.get(at..at + codes.len()) else { break };
            let mut active = ActiveCodes::new();
            let watches = self.armed && self.reflexes.rows().iter().any(|row| self.begun & row.bit() == 0);
            match (watches, self.falling) {
                (true, false) => place_and_find::<false>(codes, entries, frame, &mut active),
                (true, true) => place_and_find::<true>(codes, entries, frame, &mut active),
                (false, _) => codes.iter().zip(entries).for_each(|(code, entry)| put(*code, *entry, frame)),
            }
            active.into_iter().for_each(|(taxel, code)| self.judge(field, taxel, code, now));
        }
        self.begun & !before
    }

    /// Begins the reflex of a taxel beyond its limit if enough taxels agree.
    #[inline(never)] // M0+: out of line
    fn judge(&mut self, field: usize, taxel: u16, code: Code, now: Micros) {
        let Some(row) = self.reflexes.row_of(taxel).copied() else { return };
        let Some(spot) = self.reflexes.spot(taxel).filter(|_| self.begun & row.bit() == 0) else { return };
        let other = self.recent.agree(taxel, spot, field, self.fields.count());
        if row.agree == Agree::One || other.is_some() {
            self.begun |= row.bit();
            // There is room for every row, and a row begins again only after it was reported.
            let _ = self.untold.push_back(Early { index: row.index, time: now, taxel, code, other });
        }
    }

    /// Pins of the rows in `mask`, and the level at which each is asserted.
    pub fn pins(&self, mask: u8) -> impl Iterator<Item = (u8, bool)> + '_ {
        let rows = self.reflexes.rows().iter().filter(move |row| mask & row.bit() != 0);
        rows.filter_map(|row| row.output).map(|line| (line.pin, !line.inverted))
    }

    /// Records that a pin was driven by others. Rows that are at rest at this level may begin again.
    pub fn driven(&mut self, pin: u8, level: bool) {
        let at_rest = |line: crate::garment::Line| line.pin == pin && line.inverted == level;
        let rows = self.reflexes.rows().iter().filter(|row| row.output.is_some_and(at_rest));
        self.begun &= !rows.fold(0, |mask, row| mask | row.bit());
    }

    /// Returns the next reflex that was not returned yet.
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

/// Numbers and codes of the taxels beyond their limits.
type ActiveCodes = Vec<(u16, Code), JUDGED>;

/// Stores codes in `frame`, and collects those beyond their limits in `active`.
#[inline(never)] // M0+: out of line
fn place_and_find<const FALLING: bool>(
    codes: &[Code],
    entries: &[WatchedTaxel],
    frame: &mut [Code],
    active: &mut ActiveCodes,
) {
    let mut take = |code: &Code, entry: &WatchedTaxel| {
        put(*code, *entry, frame);
        let pressed = if FALLING { !code.0 } else { code.0 };
        if pressed > entry.limit {
            find(active, entry.taxel, *code);
        }
    };
    let (chunks, rest) = codes.as_chunks::<CHUNK>();
    let (entry_chunks, entry_rest) = entries.as_chunks::<CHUNK>();
    for (codes, entries) in chunks.iter().zip(entry_chunks) {
        codes.iter().zip(entries).for_each(|(code, entry)| take(code, entry));
    }
    rest.iter().zip(entry_rest).for_each(|(code, entry)| take(code, entry));
}

/// Stores a code in `frame` if the entry has a taxel.
#[inline(always)]
fn put(code: Code, entry: WatchedTaxel, frame: &mut [Code]) {
    if let Some(slot) = frame.get_mut(usize::from(entry.taxel)) {
        *slot = code;
    }
}

/// Adds a taxel beyond its limit; those past the last place are not judged.
#[cold]
#[inline(never)] // M0+: out of line
fn find(active: &mut ActiveCodes, taxel: u16, code: Code) {
    let _ = active.push((taxel, code));
}
