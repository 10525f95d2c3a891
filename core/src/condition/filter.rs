//! The 3x3 filters, one row at a time.

/// Clamps each taxel to the range of its neighbours in the panel (conservative smoothing). Neighbours beyond the border do
/// not count: were the border replicated, a taxel there would be its own neighbour and an impulse would survive.
pub(super) fn conservative(above: Option<&[u16]>, here: &[u16], below: Option<&[u16]>, out: &mut [u16]) {
    // A row that is missing lends from the other: a neighbour that counts twice changes neither end of the range.
    match above.or(below).zip(below.or(above)) {
        Some((above, below)) => {
            let columns = above.iter().zip(here).zip(below);
            smooth(columns.map(|((a, h), b)| (Range::of(*a).and(Range::of(*b)), u32::from(*h))), out);
        }
        None => smooth(here.iter().map(|h| (Range::NONE, u32::from(*h))), out),
    }
}

/// One row, column by column: the range of the taxels above and below, and the taxel.
#[inline(never)]
fn smooth(mut columns: impl Iterator<Item = (Range, u32)>, out: &mut [u16]) {
    let Some((mut ends, mut value)) = columns.next() else { return };
    let mut left = Range::NONE;
    let mut out = out.iter_mut();
    // The columns go first, so that the last taxel is left for them to leave.
    for ((next_ends, next), out) in columns.zip(out.by_ref()) {
        *out = left.and(ends).and(next_ends).and_value(next).clamp(value);
        left = ends.and_value(value);
        (ends, value) = (next_ends, next);
    }
    if let Some(out) = out.next() {
        *out = left.and(ends).clamp(value);
    }
}

/// The smallest and the largest of some taxels; whole words, which need no masking.
#[derive(Clone, Copy)]
struct Range {
    low: u32,
    high: u32,
}

impl Range {
    const NONE: Range = Range { low: u32::MAX, high: 0 };

    fn of(value: u16) -> Range {
        Range { low: value.into(), high: value.into() }
    }

    fn and(self, other: Range) -> Range {
        Range { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    fn and_value(self, value: u32) -> Range {
        Range { low: self.low.min(value), high: self.high.max(value) }
    }

    fn clamp(self, value: u32) -> u16 {
        let clamped = if self.low > self.high { value } else { value.max(self.low).min(self.high) };
        clamped as u16
    }
}

/// The exact median of nine with the border replicated.
///
/// Each column of three is sorted once and used three times; the median of nine is the median of the largest low, the
/// median middle and the smallest high one (Smith 1996; 113 cycles per taxel on a Cortex-M0+ instead of 350).
#[inline(never)]
pub(super) fn median(above: &[u16], here: &[u16], below: &[u16], out: &mut [u16]) {
    let mut columns =
        above.iter().zip(here).zip(below).map(|((a, h), b)| sorted((*a).into(), (*h).into(), (*b).into()));
    let Some(mut middle) = columns.next() else { return };
    let mut left = middle;
    for out in out {
        let right = columns.next().unwrap_or(middle);
        *out = match left.2 | middle.2 | right.2 {
            0 => 0,
            _ => median_of_columns(left, middle, right) as u16,
        };
        left = middle;
        middle = right;
    }
}

type Sorted = (u32, u32, u32);

fn median_of_columns(a: Sorted, b: Sorted, c: Sorted) -> u32 {
    let low = a.0.max(b.0).max(c.0);
    let middle = sorted(a.1, b.1, c.1).1;
    let high = a.2.min(b.2).min(c.2);
    sorted(low, middle, high).1
}

fn sorted(a: u32, b: u32, c: u32) -> Sorted {
    let (a, b) = (a.min(b), a.max(b));
    let (b, c) = (b.min(c), b.max(c));
    (a.min(b), a.max(b), c)
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::super::{Condition, ConditionConfig, ConditionState, Feedback, Filter};
    use crate::format::Code;
    use crate::garment::{Area, Garment, Layout};
    use std::vec::Vec;

    /// The definition: all nine of the neighbourhood, the border replicated; or the eight that exist.
    fn dense(filter: Filter, values: &[u16], area: &Area) -> Vec<u16> {
        let (rows, columns) = (i32::from(area.rows), i32::from(area.columns));
        let at = |y: i32, x: i32| values[(y.clamp(0, rows - 1) * columns + x.clamp(0, columns - 1)) as usize];
        let mut out = Vec::new();
        for (y, x) in (0..rows).flat_map(|y| (0..columns).map(move |x| (y, x))) {
            let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dy, dx)));
            out.push(match filter {
                Filter::Off => at(y, x),
                Filter::Median => {
                    let mut nine: Vec<u16> = around.map(|(dy, dx)| at(y + dy, x + dx)).collect();
                    nine.sort_unstable();
                    nine[4]
                }
                Filter::Conservative => {
                    let inside = |(dy, dx): &(i32, i32)| {
                        (0..rows).contains(&(y + dy))
                            && (0..columns).contains(&(x + dx))
                            && (*dy, *dx) != (0, 0)
                    };
                    let eight: Vec<u16> = around.filter(inside).map(|(dy, dx)| at(y + dy, x + dx)).collect();
                    match (eight.iter().min(), eight.iter().max()) {
                        (Some(low), Some(high)) => at(y, x).clamp(*low, *high),
                        _ => at(y, x),
                    }
                }
            });
        }
        out
    }

    /// A small generator; sparse images, dense ones and empty ones.
    struct Noise(u32);

    impl Noise {
        fn next(&mut self) -> u32 {
            self.0 = self.0.wrapping_mul(1664525).wrapping_add(1013904223);
            self.0 >> 8
        }

        fn image(&mut self, taxels: usize) -> Vec<Code> {
            let share = [0, 1, 4, 40, 90, 100][self.next() as usize % 6];
            let depth = [2, 40, 4096, 65536][self.next() as usize % 4];
            let one = |_| Code(if self.next() % 100 < share { (self.next() % depth) as u16 } else { 0 });
            (0..taxels).map(one).collect()
        }
    }

    #[test]
    fn filters_are_what_they_are_defined_to_be() {
        let mut noise = Noise(1);
        for (rows, columns) in [(1, 1), (1, 9), (9, 1), (2, 2), (3, 3), (4, 16), (32, 16), (8, 8), (5, 40)] {
            let layout = Layout::build(&Garment::recorded(rows, columns), 512, u16::MAX).unwrap();
            let mut state = ConditionState::<512>::new();
            state.reset(&layout, Code(0));
            // One state for all filters: nothing of the frame before may show.
            for round in 0..600 {
                let filter = [Filter::Conservative, Filter::Median, Filter::Off][round % 3];
                let config = ConditionConfig { filter, ..ConditionConfig::default() };
                let condition: Condition = config.build().unwrap();
                let codes = noise.image(layout.taxels());
                let image = condition.process(&mut state, &layout, &codes, false, 1, &Feedback::<1>::new());
                let floored: Vec<u16> = codes.iter().map(|c| if c.0 < 24 { 0 } else { c.0 }).collect();
                let want = dense(filter, &floored, &layout.areas()[0]);
                assert_eq!(image.values, want, "{filter:?} {rows} x {columns}");
                for (row, values) in want.chunks(columns.into()).enumerate() {
                    assert!(image.rows.contains(row as u16) || values.iter().all(|v| *v == 0));
                }
            }
        }
    }

    #[test]
    fn conservative_keeps_what_a_median_deletes() {
        let layout = Layout::build(&Garment::block(), 64, u16::MAX).unwrap();
        let kept = |filter, taxels: &[(usize, u16)]| {
            let mut codes = [Code(0); 64];
            taxels.iter().for_each(|(taxel, code)| codes[*taxel] = Code(*code));
            let mut state = ConditionState::<64>::new();
            state.reset(&layout, Code(0));
            let condition = ConditionConfig { filter, ..ConditionConfig::default() }.build().unwrap();
            let image = condition.process(&mut state, &layout, &codes, false, 1, &Feedback::<1>::new());
            image.values.iter().filter(|v| **v > 0).count()
        };
        let finger = [(20, 900), (21, 900), (36, 900), (37, 900)];
        let line: Vec<(usize, u16)> = (16..32).map(|taxel| (taxel, 500)).collect();
        assert_eq!([Filter::Conservative, Filter::Median].map(|f| kept(f, &finger)), [4, 0]);
        assert_eq!([Filter::Conservative, Filter::Median].map(|f| kept(f, &line)), [16, 0]);
        // An impulse goes, on the border too; a gap is bridged.
        assert_eq!(kept(Filter::Conservative, &[(37, 4000)]), 0);
        assert_eq!(kept(Filter::Conservative, &[(0, 4000)]), 0);
        let gap: Vec<_> = (0..64).filter(|t| *t != 37).map(|taxel| (taxel, 500)).collect();
        assert_eq!(kept(Filter::Conservative, &gap), 64);
    }
}
