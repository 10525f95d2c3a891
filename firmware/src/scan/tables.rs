//! What the chain reads and writes besides codes. The words are atomic because DMA reads and changes them; the chain stands
//! still while they are filled, but for the one that says where the frame after the present one goes.

use super::select::Select;
use core::sync::atomic::{AtomicU16, AtomicU32, Ordering::Relaxed};
use taxel_core::acquire::{PLACES, SWEEP_INPUTS, Sweep};
pub use taxel_core::acquire::{SWEEP_ADDRESSES as ADDRESSES, SWEEP_STRETCHES as STRETCHES};

/// Codes without a taxel in a stretch: as many as a block's row or column has.
const SPARE: usize = 256;

/// Registers that are written at the start of each stretch, by [`Targets`], and the zero that ends the list.
pub const TARGETS: usize = 8;
/// What is written there, in the same order: the destinations of the codes, the word after the present one, where the next
/// values are, the flag of a new frame.
const VALUES: usize = TARGETS - 1;
const WORD: usize = SWEEP_INPUTS;
const NEXT: usize = SWEEP_INPUTS + 1;
const FLAG: usize = SWEEP_INPUTS + 2;

/// Aligned for the ring in which it is read.
#[repr(C, align(32))]
struct Targets([AtomicU32; TARGETS]);

/// What is written at the start of a stretch.
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

/// Where the levels begin.
pub fn words() -> u32 {
    address(&WORDS)
}

/// The levels before an address: those that went out last where they are read from there next.
pub fn word_before(at: u32) -> Option<u32> {
    let index = (at.wrapping_sub(words()) / size_of::<AtomicU32>() as u32).wrapping_sub(1);
    WORDS.get(index as usize).map(|word| word.load(Relaxed))
}

/// Where the list of registers is, in a ring of [`TARGETS`] words.
pub fn targets() -> u32 {
    address(&TARGET)
}

/// Where it stands where the values of the next stretch are.
pub fn ahead() -> u32 {
    address(&AHEAD)
}

/// Where the answers of the select lines' program go.
pub fn answer() -> u32 {
    address(&ANSWER)
}

/// Where codes go that no taxel has.
pub fn nowhere() -> u32 {
    address(&NOWHERE)
}

/// Where codes of the thermometer go.
pub fn warmth() -> u32 {
    address(&THERMOMETER)
}

/// The latest code of the thermometer.
pub fn thermometer() -> u16 {
    THERMOMETER.load(Relaxed)
}

/// Fills the tables. `code` is where the code of a taxel goes in a place; then come the registers that take the destinations
/// of the four inputs' codes, the address of the next word, and the flags of new frames.
pub fn fill(
    sweep: &Sweep<ADDRESSES, STRETCHES>,
    select: Select,
    code: impl Fn(usize, u16) -> u32,
    destinations: [u32; SWEEP_INPUTS],
    word: u32,
    flag: u32,
) {
    let targets = destinations.into_iter().chain([word, ahead(), flag, 0]);
    TARGET.0.iter().zip(targets).for_each(|(slot, register)| slot.store(register, Relaxed));
    let begins = |index: usize| sweep.stretches().iter().any(|s| usize::from(s.first) == index);
    let words = sweep.levels().iter().enumerate().map(|(i, levels)| select.word(*levels, begins(i)));
    // The first word again: it is read before the list of its stretch leads back to the second.
    let again = sweep.levels().first().map(|levels| select.word(*levels, true));
    WORDS.iter().zip(words.chain(again)).for_each(|(slot, word)| slot.store(word, Relaxed));
    LAST.store(sweep.stretches().len().saturating_sub(1) as u32, Relaxed);
    for (place, lists) in VALUE.iter().enumerate() {
        for (index, (values, stretch)) in lists.iter().zip(sweep.stretches()).enumerate() {
            let set = |slot: usize, value| values.get(slot).into_iter().for_each(|v| v.store(value, Relaxed));
            (0..SWEEP_INPUTS).for_each(|channel| set(channel, nowhere()));
            for (input, taxel) in sweep.inputs().iter().zip(stretch.taxels) {
                let destination = taxel.map_or(nowhere(), |taxel| code(place, taxel));
                set(crate::adc::channel(*input), destination);
            }
            set(WORD, WORDS.get(usize::from(stretch.first) + 1).map_or(0, address));
            set(NEXT, lists.get(index + 1).map_or(0, address));
            set(FLAG, if index == 0 { 1 << place } else { 0 });
        }
    }
    AHEAD.store(VALUE.first().and_then(|lists| lists.first()).map_or(0, address), Relaxed);
}

/// The frame after the one at `place` goes to `next`.
pub fn lead(place: u8, next: u8) {
    let lists = |place: u8| VALUE.get(usize::from(place));
    let last = lists(place).and_then(|lists| lists.get(LAST.load(Relaxed) as usize));
    let first = lists(next).and_then(|lists| lists.first());
    if let (Some(last), Some(first)) = (last.and_then(|values| values.get(NEXT)), first) {
        last.store(address(first), Relaxed);
    }
}
