//! A stretch of taxels of a difference: what is unchanged first, then a run, as far as both go.
//!
//! A taxel that has changed takes a Cortex-M0+ 16 cycles here, an unchanged one before a run 7, within one 19, counted in its
//! instructions: each place has its own code, and the few registers hold all it needs.

/// Taxels of a stretch.
pub(super) const LANES: usize = 24;

/// Bytes for their differences, each of which has two at most.
pub(super) const ROOM: usize = 2 * LANES;

/// The taxels of a stretch, and the one behind them: a run is not known to go on before the next taxel is seen.
pub(super) type Taxels = [u16; LANES + 1];

/// What was seen and written: two numbers, which are returned in registers.
pub(super) struct Told {
    /// Taxels before the run, 65536 times those before the first that is not told, and [`ENDS`].
    taxels: u32,
    /// Where the bytes that were written end: an address.
    pub end: usize,
}

impl Told {
    /// Taxels before the run: all of them where there is none.
    #[inline(always)]
    pub fn quiet(&self) -> usize {
        (self.taxels & 0xffff) as usize
    }

    /// First taxel that is not told: the first of two unchanged ones, or one whose difference needs three bytes, or the one behind
    /// the stretch.
    #[inline(always)]
    pub fn next(&self) -> usize {
        (self.taxels << 1 >> 17) as usize
    }

    /// Whether the run is known to end there.
    #[inline(always)]
    pub fn ends(&self) -> bool {
        self.taxels & ENDS != 0
    }
}

/// Two unchanged taxels follow.
const ENDS: u32 = 1 << 31;

/// Writes the differences of a run, which begins `within` the stretch before it or at the first taxel that has changed.
#[inline(always)]
pub(super) fn tell(out: &mut [u8; ROOM], now: &Taxels, base: &Taxels, within: bool) -> Told {
    let state = State { out, within, quiet: if within { 0 } else { LANES as u32 } };
    lanes(state, now, base).unwrap_or_else(|told| told)
}

/// As [`tell`], for all who do it seldom: it is a long piece of code.
#[inline(never)]
pub(super) fn tell_by_call(out: &mut [u8; ROOM], now: &Taxels, base: &Taxels, within: bool) -> Told {
    tell(out, now, base, within)
}

/// As [`tell`] within a run, at most so many taxels. `None`: no room.
#[inline(always)]
pub(super) fn go_on(out: &mut [u8], now: &[u16], base: &[u16], most: usize) -> Option<Told> {
    if most > LANES
        && let (Some(now), Some(base)) = (now.first_chunk(), base.first_chunk())
        && let Some(out) = out.first_chunk_mut()
    {
        return Some(tell_by_call(out, now, base, true));
    }
    edge(out, now, base, most)
}

/// As [`go_on`], where there are fewer taxels or less room: behind them nothing changes.
#[inline(never)]
fn edge(out: &mut [u8], now: &[u16], base: &[u16], most: usize) -> Option<Told> {
    let (mut near, mut base_near): (Taxels, Taxels) = ([0; LANES + 1], [0; LANES + 1]);
    let (places, values) = (near.iter_mut().zip(&mut base_near), now.iter().zip(base));
    for ((place, base_place), (value, base)) in places.zip(values).take(most) {
        (*place, *base_place) = (*value, *base);
    }
    let mut room = [0; ROOM];
    let seen = tell_by_call(&mut room, &near, &base_near, true);
    let used = room.get(..seen.end - room.as_ptr().addr())?;
    let place = out.get_mut(..used.len())?;
    place.copy_from_slice(used);
    Some(Told { end: place.as_ptr_range().end.addr(), ..seen })
}

/// What is left of the room, and whether a run has begun, and where.
struct State<'a> {
    out: &'a mut [u8],
    within: bool,
    quiet: u32,
}

/// Each lane by itself: a compiler keeps a loop of as many.
#[inline(always)]
fn lanes(state: State<'_>, now: &Taxels, base: &Taxels) -> Result<Told, Told> {
    let state = lane::<0>(state, now, base)?;
    let state = lane::<1>(state, now, base)?;
    let state = lane::<2>(state, now, base)?;
    let state = lane::<3>(state, now, base)?;
    let state = lane::<4>(state, now, base)?;
    let state = lane::<5>(state, now, base)?;
    let state = lane::<6>(state, now, base)?;
    let state = lane::<7>(state, now, base)?;
    let state = lane::<8>(state, now, base)?;
    let state = lane::<9>(state, now, base)?;
    let state = lane::<10>(state, now, base)?;
    let state = lane::<11>(state, now, base)?;
    let state = lane::<12>(state, now, base)?;
    let state = lane::<13>(state, now, base)?;
    let state = lane::<14>(state, now, base)?;
    let state = lane::<15>(state, now, base)?;
    let state = lane::<16>(state, now, base)?;
    let state = lane::<17>(state, now, base)?;
    let state = lane::<18>(state, now, base)?;
    let state = lane::<19>(state, now, base)?;
    let state = lane::<20>(state, now, base)?;
    let state = lane::<21>(state, now, base)?;
    let state = lane::<22>(state, now, base)?;
    let state = lane::<23>(state, now, base)?;
    Ok(state.told(LANES))
}

impl State<'_> {
    #[inline(always)]
    fn told(&self, next: usize) -> Told {
        Told { taxels: self.quiet | (next as u32) << 16, end: self.out.as_ptr().addr() }
    }
}

/// Takes a taxel. An error: the run ends before it, or its difference is too long.
#[inline(always)]
fn lane<'a, const LANE: usize>(mut state: State<'a>, now: &Taxels, base: &Taxels) -> Result<State<'a>, Told> {
    if !state.within {
        if now[LANE] == base[LANE] {
            return Ok(state);
        }
        (state.within, state.quiet) = (true, LANE as u32);
    }
    let difference = i32::from(now[LANE]) - i32::from(base[LANE]);
    if difference == 0 && now[LANE + 1] == base[LANE + 1] {
        let Told { taxels, end } = state.told(LANE);
        return Err(Told { taxels: taxels | ENDS, end });
    }
    let told = state.told(LANE);
    match write(state.out, difference) {
        Some(out) => Ok(State { out, ..state }),
        None => Err(told),
    }
}

/// Writes a number of one or two bytes.
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
