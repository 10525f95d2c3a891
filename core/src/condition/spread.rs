//! How far the witnesses of a panel have drifted: what most of them agree on.

/// Displacements that are told apart, counts: those further off count as these.
const REACH: i32 = 32;
const BINS: usize = 2 * REACH as usize;

/// Displacements of some witnesses, counted.
pub(super) struct Spread {
    bins: [u8; BINS],
    count: u8,
}

impl Spread {
    pub const fn new() -> Self {
        Spread { bins: [0; BINS], count: 0 }
    }

    /// Takes one in; at most 255.
    pub fn add(&mut self, displacement: i32) {
        let bin = displacement.clamp(-REACH, REACH - 1) + REACH;
        if let Some(bin) = self.bins.get_mut(bin as usize) {
            *bin = bin.saturating_add(1);
            self.count = self.count.saturating_add(1);
        }
    }

    /// How many there are.
    pub const fn count(&self) -> u32 {
        self.count as u32
    }

    /// The displacement below which there are so many eighths of them.
    pub fn eighth(&self, eighths: u32) -> i32 {
        let mut left = u32::from(self.count) * eighths / 8;
        for (displacement, bin) in (-REACH..).zip(self.bins) {
            match left.checked_sub(bin.into()) {
                Some(rest) => left = rest,
                None => return displacement,
            }
        }
        REACH - 1
    }

    /// How far all have drifted: what three quarters agree on. A touch may cover nearly so many, and leaves others where they are.
    pub fn agreed(&self) -> i32 {
        self.eighth(2).max(0) + self.eighth(6).min(0)
    }

    /// How far the middle one has come if nearly all have gone the same way, further than `noise`, as no touch makes them.
    pub fn unanimous(&self, noise: i32) -> i32 {
        if self.eighth(1) > noise || self.eighth(7) < -noise { self.eighth(4) } else { 0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spread(displacements: impl IntoIterator<Item = i32>) -> Spread {
        let mut spread = Spread::new();
        displacements.into_iter().for_each(|one| spread.add(one));
        spread
    }

    #[test]
    fn eighths_are_those_of_the_sorted_list() {
        let mut state = 1u32;
        for count in 1..=32 {
            let list: [i32; 32] = core::array::from_fn(|_| {
                state = state.wrapping_mul(1664525).wrapping_add(1013904223);
                (state >> 24) as i32 % 64 - 32
            });
            let mut sorted = list;
            sorted[..count].sort_unstable();
            let spread = spread(list[..count].iter().copied());
            for eighths in 0..8 {
                assert_eq!(spread.eighth(eighths), sorted[count * eighths as usize / 8]);
            }
        }
    }

    #[test]
    fn three_quarters_agree() {
        let of = |share: usize, by: i32| spread((0..32).map(|at| if at < share { by } else { 0 })).agreed();
        assert_eq!([of(32, 5), of(24, 5), of(23, 5), of(20, 12)], [5, 5, 0, 0]);
        assert_eq!([of(32, -5), of(25, -5), of(24, -5), of(0, 0)], [-5, -5, 0, 0]);
        let of =
            |share: usize, by: i32| spread((0..32).map(|at| if at < share { by } else { 0 })).unanimous(3);
        assert_eq!([of(32, 9), of(28, 9), of(27, 9), of(32, -9), of(32, 3)], [9, 9, 0, -9, 0]);
    }
}
