//! How far the witnesses of a panel have drifted: what most of them agree on.

use super::witness::WITNESSES;

/// Displacements of some witnesses in ascending order, counts; those beyond an `i8` count as its end.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Spread {
    sorted: [i8; WITNESSES],
    count: u8,
}

impl Spread {
    pub const NONE: Spread = Spread { sorted: [0; WITNESSES], count: 0 };

    /// Takes one in; what comes after the last witness is left out.
    pub fn add(&mut self, displacement: i32) {
        let mut new = displacement.clamp(i8::MIN.into(), i8::MAX.into()) as i8;
        let (kept, free) = self.sorted.split_at_mut(usize::from(self.count).min(WITNESSES));
        let Some(next) = free.first_mut() else { return };
        for old in kept {
            if *old > new {
                core::mem::swap(old, &mut new);
            }
        }
        *next = new;
        self.count += 1;
    }

    /// How many there are.
    pub const fn count(&self) -> u32 {
        self.count as u32
    }

    /// The displacement below which there are so many eighths of them, fewer than eight; 0 if there are none.
    pub fn eighth(&self, eighths: u32) -> i32 {
        let at = u32::from(self.count) * eighths / 8;
        self.sorted
            .get(at as usize)
            .filter(|_| self.count > 0)
            .map_or(0, |displacement| (*displacement).into())
    }

    /// How far all have drifted: what three quarters agree on. A touch may cover nearly so many, and leaves others
    /// where they are.
    pub fn agreed(&self) -> i32 {
        self.eighth(2).max(0) + self.eighth(6).min(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spread(displacements: impl IntoIterator<Item = i32>) -> Spread {
        let mut spread = Spread::NONE;
        displacements.into_iter().for_each(|one| spread.add(one));
        spread
    }

    #[test]
    fn eighths_are_those_of_the_sorted_list() {
        let mut state = 1u32;
        for count in 1..=40 {
            let list: [i32; 40] = core::array::from_fn(|_| {
                state = state.wrapping_mul(1664525).wrapping_add(1013904223);
                (state >> 23) as i32 - 256
            });
            let kept = count.min(WITNESSES);
            let mut sorted = list;
            sorted[..kept].sort_unstable();
            let spread = spread(list[..count].iter().copied());
            for eighths in 0..8 {
                assert_eq!(spread.eighth(eighths), sorted[kept * eighths as usize / 8].clamp(-128, 127));
            }
        }
        assert_eq!((Spread::NONE.eighth(4), Spread::NONE.agreed()), (0, 0));
    }

    #[test]
    fn three_quarters_agree() {
        let of = |share: usize, by: i32| spread((0..32).map(|at| if at < share { by } else { 0 })).agreed();
        assert_eq!([of(32, 5), of(24, 5), of(23, 5), of(20, 12)], [5, 5, 0, 0]);
        assert_eq!([of(32, -5), of(25, -5), of(24, -5), of(0, 0)], [-5, -5, 0, 0]);
    }
}
