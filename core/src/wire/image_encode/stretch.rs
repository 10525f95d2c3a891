//! Encodes a stretch of up to 24 taxels of a difference: a skip over unchanged taxels, then the differences
//! of a run. In an image without a base each taxel of a run is encoded as the difference to the one before
//! it.
//!
//! A changed taxel takes a Cortex-M0+ 16 cycles here, an unchanged one before a run 7, within one 19, counted
//! in its instructions: each position has code of its own, and all values stay in the few registers.

use core::hint::cold_path;

/// Number of taxels of a stretch.
pub(super) const LANES: usize = 24;

/// Bytes for their differences, at most two each.
pub(super) const ROOM: usize = 2 * LANES;

/// The taxels of a stretch and the one behind them, which is needed to know whether a run goes on.
pub(super) type Taxels = [u16; LANES + 1];

/// Result of a stretch: two numbers, which are returned in registers.
pub(super) struct StretchEnd {
    /// Bits 0 to 15: [`StretchEnd::unchanged`]; bits 16 to 30: [`StretchEnd::next`]; bit 31: [`ENDS`].
    taxels: u32,
    /// Address of the end of the written bytes.
    pub end: usize,
}

impl StretchEnd {
    /// Number of unchanged taxels before the run; all of them without a run.
    #[inline(always)]
    pub fn unchanged(&self) -> usize {
        (self.taxels & 0xffff) as usize
    }

    /// Index of the first taxel that is not encoded: the first of two unchanged ones, one whose difference
    /// needs three bytes, or the one behind the stretch.
    #[inline(always)]
    pub fn next(&self) -> usize {
        (self.taxels << 1 >> 17) as usize
    }

    /// True if the run is known to end there.
    #[inline(always)]
    pub fn ends(&self) -> bool {
        self.taxels & ENDS != 0
    }
}

/// Flag: two unchanged taxels follow.
const ENDS: u32 = 1 << 31;

/// Encodes the differences of a run, which begins at the first changed taxel.
#[inline(always)]
pub(super) fn encode(out: &mut [u8; ROOM], now: &Taxels, base: &Taxels) -> StretchEnd {
    let state = LaneState { out, within: false, unchanged: LANES as u32 };
    lanes::<false>(state, now, base).unwrap_or_else(|encoded| encoded)
}

/// Out-of-line [`encode`], for rare callers: it is a long piece of code.
#[inline(never)]
pub(super) fn encode_by_call(out: &mut [u8; ROOM], now: &Taxels, base: &Taxels) -> StretchEnd {
    encode(out, now, base)
}

/// Encodes like [`encode`], within a run that continues with the first taxel. With `ALONE`, each taxel differs
/// from the one before it, `base` begins with that of the first, and a taxel is unchanged if it is 0.
#[inline(never)]
fn encode_within<const ALONE: bool>(out: &mut [u8; ROOM], now: &Taxels, base: &Taxels) -> StretchEnd {
    let state = LaneState { out, within: true, unchanged: 0 };
    lanes::<ALONE>(state, now, base).unwrap_or_else(|encoded| encoded)
}

/// Encodes at most `most` taxels like [`encode_within`]. `None` if there is no room.
#[inline(always)]
pub(super) fn go_on<const ALONE: bool>(
    out: &mut [u8],
    now: &[u16],
    base: &[u16],
    most: usize,
) -> Option<StretchEnd> {
    if most <= LANES {
        cold_path();
        return edge::<ALONE>(out, now, base, most);
    }
    // One by one: a compiler turns joined conditions into numbers first.
    let (Some(near), Some(base_near)) = (now.first_chunk(), base.first_chunk()) else {
        cold_path();
        return edge::<ALONE>(out, now, base, most);
    };
    let Some(room) = out.first_chunk_mut() else {
        cold_path();
        return edge::<ALONE>(out, now, base, most);
    };
    Some(encode_within::<ALONE>(room, near, base_near))
}

/// Encodes like [`go_on`], with fewer taxels or less room: the missing taxels count as unchanged.
#[inline(never)]
fn edge<const ALONE: bool>(out: &mut [u8], now: &[u16], base: &[u16], most: usize) -> Option<StretchEnd> {
    let (mut near, mut base_near): (Taxels, Taxels) = ([0; LANES + 1], [0; LANES + 1]);
    let (places, values) = (near.iter_mut().zip(&mut base_near), now.iter().zip(base));
    for ((place, base_place), (value, base)) in places.zip(values).take(most) {
        (*place, *base_place) = (*value, *base);
    }
    let mut room = [0; ROOM];
    let seen = encode_within::<ALONE>(&mut room, &near, &base_near);
    let used = room.get(..seen.end - room.as_ptr().addr())?;
    let place = out.get_mut(..used.len())?;
    place.copy_from_slice(used);
    Some(StretchEnd { end: place.as_ptr_range().end.addr(), ..seen })
}

/// Remaining room, whether a run has begun, and number of unchanged taxels before it.
struct LaneState<'a> {
    out: &'a mut [u8],
    within: bool,
    unchanged: u32,
}

/// Unrolled by hand: the compiler would keep a loop.
#[inline(always)]
fn lanes<const ALONE: bool>(
    state: LaneState<'_>,
    now: &Taxels,
    base: &Taxels,
) -> Result<StretchEnd, StretchEnd> {
    let state = lane::<ALONE, 0>(state, now, base)?;
    let state = lane::<ALONE, 1>(state, now, base)?;
    let state = lane::<ALONE, 2>(state, now, base)?;
    let state = lane::<ALONE, 3>(state, now, base)?;
    let state = lane::<ALONE, 4>(state, now, base)?;
    let state = lane::<ALONE, 5>(state, now, base)?;
    let state = lane::<ALONE, 6>(state, now, base)?;
    let state = lane::<ALONE, 7>(state, now, base)?;
    let state = lane::<ALONE, 8>(state, now, base)?;
    let state = lane::<ALONE, 9>(state, now, base)?;
    let state = lane::<ALONE, 10>(state, now, base)?;
    let state = lane::<ALONE, 11>(state, now, base)?;
    let state = lane::<ALONE, 12>(state, now, base)?;
    let state = lane::<ALONE, 13>(state, now, base)?;
    let state = lane::<ALONE, 14>(state, now, base)?;
    let state = lane::<ALONE, 15>(state, now, base)?;
    let state = lane::<ALONE, 16>(state, now, base)?;
    let state = lane::<ALONE, 17>(state, now, base)?;
    let state = lane::<ALONE, 18>(state, now, base)?;
    let state = lane::<ALONE, 19>(state, now, base)?;
    let state = lane::<ALONE, 20>(state, now, base)?;
    let state = lane::<ALONE, 21>(state, now, base)?;
    let state = lane::<ALONE, 22>(state, now, base)?;
    let state = lane::<ALONE, 23>(state, now, base)?;
    Ok(state.encoded(LANES))
}

impl LaneState<'_> {
    #[inline(always)]
    fn encoded(&self, next: usize) -> StretchEnd {
        StretchEnd { taxels: self.unchanged | (next as u32) << 16, end: self.out.as_ptr().addr() }
    }

    #[inline(always)]
    fn ended(&self, next: usize) -> StretchEnd {
        let StretchEnd { taxels, end } = self.encoded(next);
        StretchEnd { taxels: taxels | ENDS, end }
    }
}

/// Encodes one taxel. Error: the run ends before it, or its difference is too long.
#[inline(always)]
fn lane<'a, const ALONE: bool, const LANE: usize>(
    mut state: LaneState<'a>,
    now: &Taxels,
    base: &Taxels,
) -> Result<LaneState<'a>, StretchEnd> {
    if !state.within {
        if now[LANE] == base[LANE] {
            return Ok(state);
        }
        (state.within, state.unchanged) = (true, LANE as u32);
    }
    // The first of two unchanged taxels ends a run.
    let last = if ALONE {
        // Two instructions for both; two conditions cost a jump more for each taxel that is 0.
        if u32::from(now[LANE]) | u32::from(now[LANE + 1]) << 16 == 0 {
            cold_path();
            return Err(state.ended(LANE));
        }
        if LANE == 0 { base[0] } else { now[LANE - 1] }
    } else {
        base[LANE]
    };
    let difference = i32::from(now[LANE]) - i32::from(last);
    if !ALONE && difference == 0 && now[LANE + 1] == base[LANE + 1] {
        return Err(state.ended(LANE));
    }
    let encoded = state.encoded(LANE);
    match write(state.out, difference) {
        Some(out) => Ok(LaneState { out, ..state }),
        None => Err(encoded),
    }
}

/// Writes a number of one or two bytes; `None` if it needs more.
#[inline(always)]
fn write(out: &mut [u8], number: i32) -> Option<&mut [u8]> {
    let number = zigzag(number);
    if number < 1 << 7 {
        return push(out, number as u8);
    }
    if number >> 14 != 0 {
        return None;
    }
    push(push(out, number as u8 | 128)?, (number >> 7) as u8)
}

pub(super) const fn zigzag(number: i32) -> u32 {
    (number << 1 ^ number >> 31) as u32
}

#[inline(always)]
pub(super) fn push(out: &mut [u8], byte: u8) -> Option<&mut [u8]> {
    let (to, rest) = out.split_first_mut()?;
    *to = byte;
    Some(rest)
}
