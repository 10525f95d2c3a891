//! Copies of bytes between places of different alignment, like those of messages in the rings of a link.

use core::hint::black_box;

/// Number of positions in a word.
const PLACES: usize = 4;
/// Number of pairs of positions, source and destination.
pub const PAIRS: usize = PLACES * PLACES;
/// Number of bytes of a packet on USB.
const PACKET: usize = 64;
/// Length of the longest copy.
const LONGEST: usize = 80;

/// Room for the longest copy at the last position, and for bytes that must not change.
pub type CopySpace = [u8; PLACES + LONGEST + PLACES];

/// Copies a packet once for each pair of places.
#[inline(never)]
pub fn packets(from: &CopySpace, to: &mut CopySpace) {
    for pair in 0..PAIRS {
        copy(from, to, pair, black_box(PACKET));
    }
}

/// Copies, moves and clears with all lengths and pairs of positions; returns every byte of the room after each
/// of them.
pub fn all(from: &CopySpace) -> impl Iterator<Item = u8> {
    let pairs = (0..=LONGEST).flat_map(|length| (0..PAIRS).map(move |pair| (length, pair)));
    pairs.flat_map(|(length, pair)| {
        let (mut to, mut moved, mut cleared) = ([0xa5; size_of::<CopySpace>()], *from, *from);
        copy(from, &mut to, pair, length);
        shift(&mut moved, pair, length);
        clear(&mut cleared, pair, length);
        to.into_iter().chain(moved).chain(cleared)
    })
}

#[inline(never)]
fn copy(from: &CopySpace, to: &mut CopySpace, pair: usize, length: usize) {
    let (at, source) = (pair / PLACES, pair % PLACES);
    if let (Some(to), Some(from)) = (to.get_mut(at..at + length), from.get(source..source + length)) {
        to.copy_from_slice(from);
    }
}

/// Moves bytes within the room, in both directions.
#[inline(never)]
fn shift(space: &mut CopySpace, pair: usize, length: usize) {
    let (at, source) = (pair / PLACES, pair % PLACES);
    if source + length <= space.len() && at + length <= space.len() {
        space.copy_within(source..source + length, at);
    }
}

/// Clears bytes at the first position of the pair.
#[inline(never)]
fn clear(space: &mut CopySpace, pair: usize, length: usize) {
    let at = pair / PLACES;
    if let Some(space) = space.get_mut(at..at + length) {
        space.fill(0);
    }
}
