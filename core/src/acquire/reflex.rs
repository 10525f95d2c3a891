//! The check of a sub-field's codes as soon as they are read.

use super::{Fields, Read};
use crate::format::{Code, Micros};
use crate::reflex::{Agree, Early, ROWS, Recent, Reflexes};
use heapless::{Deque, Vec};

/// Codes per iteration of the loops, which the compiler unrolls.
const CHUNK: usize = 8;
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
    unreported: Deque<Early, ROWS>,
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
            unreported: Deque::new(),
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
            self.unreported.clear();
            self.disarm();
        }
        // A row without a pin is at rest when its reaction has ended, one with a pin when the pin is.
        let pinned = self.reflexes.rows().iter().filter(|row| row.output.is_some());
        let unreported = self.unreported.iter().fold(0, |mask, early| mask | 1 << (early.index & 7));
        self.begun &= active | unreported | pinned.fold(0, |mask, row| mask | row.bit());
        if reflexes.is_empty() {
            return;
        }
        let flip = if self.falling { u16::MAX } else { 0 };
        let entries = self.fields.before(self.fields.count()) * self.fields.inputs().len();
        for _ in 0..if self.armed { RENEWED } else { FILLED } {
            let Some(entry) = self.entries.get_mut(usize::from(self.next)) else { break };
            entry.limit = limit(entry.taxel).map_or(u16::MAX, |code| code ^ flip);
            self.next += 1;
            if usize::from(self.next) >= entries {
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
            place(codes, entries, frame);
            if self.armed && self.reflexes.rows().iter().any(|row| self.begun & row.bit() == 0) {
                let mut active = ActiveCodes::new();
                match self.falling {
                    false => find::<false>(codes, entries, &mut active),
                    true => find::<true>(codes, entries, &mut active),
                }
                active.into_iter().for_each(|(taxel, code)| self.judge(field, taxel, code, now));
            }
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
            let _ = self.unreported.push_back(Early { index: row.index, time: now, taxel, code, other });
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
    pub fn take_early(&mut self) -> Option<Early> {
        self.unreported.pop_front()
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

/// Stores the codes of taxels in `frame`.
///
/// Apart from [`find`]: one loop for both needs more registers than an M0+ has, and takes two cycles a taxel
/// more.
#[inline(never)] // M0+: out of line
fn place(codes: &[Code], entries: &[WatchedTaxel], frame: &mut [Code]) {
    let mut put = |(code, entry): (&Code, &WatchedTaxel)| {
        if let Some(slot) = frame.get_mut(usize::from(entry.taxel)) {
            *slot = *code;
        }
    };
    let (chunks, rest) = codes.as_chunks::<CHUNK>();
    let (entry_chunks, entry_rest) = entries.as_chunks::<CHUNK>();
    chunks.iter().zip(entry_chunks).for_each(|(codes, entries)| codes.iter().zip(entries).for_each(&mut put));
    rest.iter().zip(entry_rest).for_each(&mut put);
}

/// Collects the taxels beyond their limits in `active`.
#[inline(never)] // M0+: out of line
fn find<const FALLING: bool>(codes: &[Code], entries: &[WatchedTaxel], active: &mut ActiveCodes) {
    let mut look = |codes: &[Code], entries: &[WatchedTaxel]| {
        if codes.iter().zip(entries).any(is_beyond::<FALLING>) {
            take_active::<FALLING>(codes, entries, active);
        }
    };
    let (chunks, rest) = codes.as_chunks::<CHUNK>();
    let (entry_chunks, entry_rest) = entries.as_chunks::<CHUNK>();
    chunks.iter().zip(entry_chunks).for_each(|(codes, entries)| look(codes, entries));
    look(rest, entry_rest);
}

/// True if a code is beyond the limit of its taxel.
#[inline(always)]
fn is_beyond<const FALLING: bool>((code, entry): (&Code, &WatchedTaxel)) -> bool {
    let pressed = if FALLING { !code.0 } else { code.0 };
    pressed > entry.limit
}

/// Adds the taxels beyond their limits; those past the last place are not judged.
#[cold]
#[inline(never)] // M0+: out of line
fn take_active<const FALLING: bool>(codes: &[Code], entries: &[WatchedTaxel], active: &mut ActiveCodes) {
    for (code, entry) in codes.iter().zip(entries).filter(|pair| is_beyond::<FALLING>(*pair)) {
        let _ = active.push((entry.taxel, *code));
    }
}
