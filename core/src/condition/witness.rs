//! The taxels of a panel that tell how it drifts, and what they say in a turn.

use super::factor::ONE;
use super::spread::Spread;

/// Taxels of a panel that are asked.
pub(super) const WITNESSES: usize = 32;

/// Where a witness is in a panel of so many taxels: spread over its rows in ascending order, and over its columns.
pub(super) const fn place(witness: usize, taxels: usize) -> usize {
    let scattered = (witness * 101) % 256;
    (witness * taxels + scattered * taxels / 256) / WITNESSES
}

/// A witness in the turn of its row; counts towards pressure.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    /// Where the panel's drift puts its baseline now.
    pub expected: i32,
    /// How far off its code is from there.
    pub off: i32,
    pub factor: u8,
    /// A contact's rectangle covers it, or touches it.
    pub held: bool,
}

/// What the witnesses of a panel have said in a turn. Panels are heard one after the other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Said {
    /// The next that is asked.
    pub next: u8,
    /// How far those that nothing touches have drifted beyond their anchors.
    pub spread: Spread,
    /// How many witnesses there are.
    pub asked: u8,
    /// Those that no contact holds; of these, those off by more than noise either way; by how much all of them are off.
    pub free: u8,
    pub up: u8,
    pub down: u8,
    pub total: i32,
    /// Those that are further off than drift leaves them, though no contact is there.
    pub clutter: u8,
    /// Those that have followed further than a touch could have gone unfelt, towards pressure and away from it.
    pub ahead: u8,
    pub behind: u8,
    /// Those whose factor is above 1, and below.
    pub above: u8,
    pub below: u8,
}

impl Said {
    /// Nothing yet.
    pub const NONE: Said = Said {
        next: 0,
        spread: Spread::NONE,
        asked: 0,
        free: 0,
        up: 0,
        down: 0,
        total: 0,
        clutter: 0,
        ahead: 0,
        behind: 0,
        above: 0,
        below: 0,
    };

    /// Counts a witness of that factor.
    pub fn ask(&mut self, factor: u8) {
        self.asked += 1;
        self.above += u8::from(factor > ONE);
        self.below += u8::from(factor < ONE);
    }

    /// Counts how far off the code of one that no contact holds is.
    pub fn show(&mut self, off: i32, noise: i32) {
        self.free += 1;
        self.up += u8::from(off > noise);
        self.down += u8::from(off < -noise);
        self.total += off.clamp(-256, 256);
    }

    /// How far the panel has drifted. While its factors are not known, they are `fresh`.
    pub fn agreed(&self, noise: i32, fresh: bool) -> i32 {
        let half = self.spread.count() / 2;
        let far = i32::from(u32::from(self.ahead) > half) - i32::from(u32::from(self.behind) > half);
        let together = if fresh { self.together(noise) } else { 0 };
        let unanimous = if 2 * self.free > self.asked { self.unanimous() } else { 0 };
        let steps = [together, unanimous, self.spread.agreed(), far];
        steps.into_iter().find(|step| *step != 0).unwrap_or(0)
    }

    /// How far the middle one has drifted if nearly all have drifted the same way, further than noise.
    fn together(&self, noise: i32) -> i32 {
        let most = 2 * self.spread.count() > self.asked.into();
        let together = self.spread.eighth(1) > noise || self.spread.eighth(7) < -noise;
        if most && together { self.spread.eighth(4) } else { 0 }
    }

    /// How far they have come if nearly all have gone the same way, further than noise, as no touch makes them.
    fn unanimous(&self) -> i32 {
        let most = self.free - self.free / 8;
        if self.up < most && self.down < most {
            return 0;
        }
        let off = self.total.checked_div(self.free.into()).unwrap_or(0);
        // What they have followed already counts, too, unless most are further off than is looked at.
        let middle = self.spread.eighth(4);
        let seen = 2 * self.spread.count() > self.asked.into() && middle.signum() == off.signum();
        if seen { middle } else { off }
    }

    /// A touch hides nearly all of the panel.
    pub fn is_hidden(&self) -> bool {
        8 * self.spread.count() < self.asked.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn witnesses_follow_each_other_in_other_columns() {
        for (rows, columns) in [(32, 16), (64, 32), (4, 16), (20, 27), (4, 8), (3, 5)] {
            let places: [usize; WITNESSES] = core::array::from_fn(|at| place(at, rows * columns));
            assert!(places.is_sorted() && places[WITNESSES - 1] < rows * columns, "{places:?}");
            let used = (0..columns).filter(|column| places.iter().any(|place| place % columns == *column));
            assert!(2 * used.count() > columns, "{places:?}");
        }
    }

    #[test]
    fn nearly_all_go_one_way_or_none_does() {
        let of = |share: u8, by: i32| {
            let mut said = Said::NONE;
            (0..32).for_each(|at| {
                said.ask(ONE);
                said.show(if at < share { by } else { 0 }, 3);
            });
            said.unanimous()
        };
        assert_eq!([of(32, 9), of(28, 9), of(27, 9), of(32, -9), of(32, 3)], [9, 7, 0, -9, 0]);
    }
}
