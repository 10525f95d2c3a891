//! The 3x3 filters, where there is something in reach.

use super::config::Filter;
use super::conservative::conservative;
use super::image::{panel_mut, panel_of};
use super::median::median;
use super::rows::grain;
use super::state::ConditionState;
use crate::garment::Area;

impl<const TAXELS: usize> ConditionState<TAXELS> {
    /// Filters the calibrated image of a panel whose filtered image is empty. What either of them may hold takes the place
    /// of what the calibrated one held.
    pub(super) fn filter(&mut self, area: &Area, filter: Filter) {
        let values = panel_of(&self.calibrated, area);
        let out = panel_mut(&mut self.filtered, area);
        match filter {
            Filter::Off => {}
            Filter::Conservative => conservative(values, out, area, grain(area), &mut self.rows),
            Filter::Median => median(values, out, area, grain(area), &mut self.rows),
        }
    }
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
