//! Copies of bytes between places that stand otherwise in their words, as messages meet them on their way
//! through the rings of a link.

use core::hint::black_box;

/// Places in a word.
const PLACES: usize = 4;
/// Pairs of places, from and to.
pub const PAIRS: usize = PLACES * PLACES;
/// Bytes of a packet on USB.
const PACKET: usize = 64;
/// The longest copy.
const LONGEST: usize = 80;

/// Room for the longest copy at the last place, and for what must stay as it is.
pub type Space = [u8; PLACES + LONGEST + PLACES];

/// Copies a packet once for each pair of places.
#[inline(never)]
pub fn packets(from: &Space, to: &mut Space) {
    for pair in 0..PAIRS {
        copy(from, to, pair, black_box(PACKET));
    }
}

/// Copies and moves of all lengths, for each pair of places: every byte of the room after each of them.
pub fn all(from: &Space) -> impl Iterator<Item = u8> {
    let pairs = (0..=LONGEST).flat_map(|length| (0..PAIRS).map(move |pair| (length, pair)));
    pairs.flat_map(|(length, pair)| {
        let (mut to, mut moved) = ([0xa5; size_of::<Space>()], *from);
        copy(from, &mut to, pair, length);
        shift(&mut moved, pair, length);
        to.into_iter().chain(moved)
    })
}

#[inline(never)]
fn copy(from: &Space, to: &mut Space, pair: usize, length: usize) {
    let (at, source) = (pair / PLACES, pair % PLACES);
    if let (Some(to), Some(from)) = (to.get_mut(at..at + length), from.get(source..source + length)) {
        to.copy_from_slice(from);
    }
}

/// Within the room, to the front and to the back.
#[inline(never)]
fn shift(space: &mut Space, pair: usize, length: usize) {
    let (at, source) = (pair / PLACES, pair % PLACES);
    if source + length <= space.len() && at + length <= space.len() {
        space.copy_within(source..source + length, at);
    }
}
