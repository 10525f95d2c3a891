//! Tables that the chain reads and writes besides codes. The words are atomic because DMA reads and changes
//! them. They are filled while the chain stands still, except the word that names the place of the frame
//! after the present one.

use super::select::Select;
use core::sync::atomic::{AtomicU16, AtomicU32, Ordering::Relaxed};
use taxel_core::acquire::{Fields, PLACES, SWEEP_INPUTS, Sweep};
pub use taxel_core::acquire::{SWEEP_ADDRESSES as ADDRESSES, SWEEP_STRETCHES as STRETCHES};

/// Greatest number of codes without a taxel in a stretch: a row or column of a block.
const SPARE: usize = 256;

/// Number of registers written at the start of each stretch, by [`Targets`], with the zero that ends the
/// list.
pub const TARGETS: usize = 8;
/// Number of values written to them, in the same order: the destinations of the codes, the address of the
/// next word, the address of the next values, the flag of a new frame.
const VALUES: usize = TARGETS - 1;
const WORD: usize = SWEEP_INPUTS;
const NEXT: usize = SWEEP_INPUTS + 1;
const FLAG: usize = SWEEP_INPUTS + 2;

/// Registers, aligned for the ring in which DMA reads them.
#[repr(C, align(32))]
struct Targets([AtomicU32; TARGETS]);

/// Values written at the start of a stretch.
type Values = [AtomicU32; VALUES];

static TARGET: Targets = Targets([const { AtomicU32::new(0) }; TARGETS]);
static WORDS: [AtomicU32; ADDRESSES + 1] = [const { AtomicU32::new(0) }; ADDRESSES + 1];
static VALUE: [[Values; STRETCHES]; PLACES] =
    [const { [const { [const { AtomicU32::new(0) }; VALUES] }; STRETCHES] }; PLACES];
static AHEAD: AtomicU32 = AtomicU32::new(0);
static NOWHERE: [AtomicU16; SPARE] = [const { AtomicU16::new(0) }; SPARE];
static THERMOMETER: AtomicU16 = AtomicU16::new(0);
static ANSWER: AtomicU32 = AtomicU32::new(0);
/// Index of the last stretch.
static LAST: AtomicU32 = AtomicU32::new(0);

fn address<T>(of: &T) -> u32 {
    core::ptr::from_ref(of) as u32
}

/// Address of the words for the select lines.
pub fn words() -> u32 {
    address(&WORDS)
}

/// The word before address `at`, which was sent last if the next one is read from `at`.
pub fn word_before(at: u32) -> Option<u32> {
    let index = (at.wrapping_sub(words()) / size_of::<AtomicU32>() as u32).wrapping_sub(1);
    WORDS.get(index as usize).map(|word| word.load(Relaxed))
}

/// Address of the list of registers, a ring of [`TARGETS`] words.
pub fn targets() -> u32 {
    address(&TARGET)
}

/// Address of the pointer to the next stretch's value list.
pub fn ahead() -> u32 {
    address(&AHEAD)
}

/// Destination of the answers of the select lines' program.
pub fn answer() -> u32 {
    address(&ANSWER)
}

/// Destination of codes that belong to no taxel.
pub fn nowhere() -> u32 {
    address(&NOWHERE)
}

/// Destination of codes of the thermometer.
pub fn warmth() -> u32 {
    address(&THERMOMETER)
}

/// Latest code of the thermometer.
pub fn thermometer() -> u16 {
    THERMOMETER.load(Relaxed)
}

/// Addresses of the registers that the chain writes at the start of a stretch.
pub struct Registers {
    /// Registers for the destinations of the four inputs' codes.
    pub destinations: [u32; SWEEP_INPUTS],
    /// Register for the address of the next word.
    pub word: u32,
    /// Register for the flags of new frames.
    pub flag: u32,
}

impl Registers {
    fn set(self) {
        let targets = self.destinations.into_iter().chain([self.word, ahead(), self.flag, 0]);
        TARGET.0.iter().zip(targets).for_each(|(slot, register)| slot.store(register, Relaxed));
    }
}

/// Sets the values for the stretch whose first address is `first`: the destination of the codes of each input
/// (GPIO number), the values of the stretch after it, and its flag.
fn set(
    values: &Values,
    first: usize,
    codes: impl Iterator<Item = (u8, u32)>,
    next: Option<&Values>,
    flag: u32,
) {
    let set = |slot: usize, value| values.get(slot).into_iter().for_each(|v| v.store(value, Relaxed));
    (0..SWEEP_INPUTS).for_each(|channel| set(channel, nowhere()));
    codes.for_each(|(input, destination)| set(crate::adc::channel(input), destination));
    set(WORD, WORDS.get(first + 1).map_or(0, address));
    set(NEXT, next.map_or(0, address));
    set(FLAG, flag);
}

/// Fills the tables for a sweep. `code` returns the address of a taxel's code in a place.
pub fn fill(
    sweep: &Sweep<ADDRESSES, STRETCHES>,
    select: Select,
    code: impl Fn(usize, u16) -> u32,
    registers: Registers,
) {
    registers.set();
    let begins = |index: usize| sweep.stretches().iter().any(|s| usize::from(s.first) == index);
    for (index, levels) in sweep.levels().iter().enumerate() {
        set_word(index, select.word(*levels, begins(index)));
    }
    end_words(sweep.levels().len());
    LAST.store(sweep.stretches().len().saturating_sub(1) as u32, Relaxed);
    for (place, lists) in VALUE.iter().enumerate() {
        for (index, (values, stretch)) in lists.iter().zip(sweep.stretches()).enumerate() {
            let codes = sweep.inputs().iter().zip(stretch.taxels);
            let codes = codes.filter_map(|(input, taxel)| Some((*input, code(place, taxel?))));
            let flag = if index == 0 { 1 << place } else { 0 };
            set(values, stretch.first.into(), codes, lists.get(index + 1), flag);
        }
    }
    begin();
}

/// Fills the tables for sub-fields, whose words are set already. `code` returns the address of a code by the
/// order of the scan. The flag of a sub-field is its number modulo 4.
pub fn fill_fields(fields: &Fields, code: impl Fn(usize) -> u32, registers: Registers) {
    registers.set();
    end_words(fields.before(fields.count()));
    let Some(lists) = VALUE.first() else { return };
    for (field, values) in lists.iter().enumerate().take(fields.count()) {
        let first = fields.span(field).start;
        let destination = |turn| code(first + turn * fields.addresses(field));
        let codes = fields.inputs().iter().enumerate().map(|(turn, input)| (*input, destination(turn)));
        let next = if field + 1 < fields.count() { field + 1 } else { 0 };
        set(values, fields.before(field), codes, lists.get(next), flag_of(field));
    }
    begin();
}

/// Flag of a sub-field.
pub fn flag_of(field: usize) -> u32 {
    1 << (field & 3)
}

/// Sets the word for the select lines at an address.
pub fn set_word(index: usize, word: u32) {
    WORDS.get(index).into_iter().for_each(|slot| slot.store(word, Relaxed));
}

/// Repeats the first word at the end: it is read before the list of its stretch leads back to the second.
fn end_words(count: usize) {
    set_word(count, WORDS.first().map_or(0, |word| word.load(Relaxed)));
}

/// Starts with the first list.
fn begin() {
    AHEAD.store(VALUE.first().and_then(|lists| lists.first()).map_or(0, address), Relaxed);
}

/// Leads the chain from the frame at `place` to the one at `next`.
pub fn lead(place: u8, next: u8) {
    let lists = |place: u8| VALUE.get(usize::from(place));
    let last = lists(place).and_then(|lists| lists.get(LAST.load(Relaxed) as usize));
    let first = lists(next).and_then(|lists| lists.first());
    if let (Some(last), Some(first)) = (last.and_then(|values| values.get(NEXT)), first) {
        last.store(address(first), Relaxed);
    }
}
