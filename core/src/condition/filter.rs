//! The 3x3 filters, applied where the image may be non-zero.

use super::config::Filter;
use super::conservative::conservative;
#[cfg(target_pointer_width = "64")]
use super::eights::{FEWEST, median_by_eights};
use super::median::median;
use super::rows::grain;
use super::slices::{panel_mut, panel_of};
use super::square::square;
use super::state::ConditionState;
use crate::garment::Area;

impl<const TAXELS: usize> ConditionState<TAXELS> {
    /// Filters the calibrated image of a panel whose filtered image is zero. The marks are widened to where
    /// either image may be non-zero.
    pub(super) fn filter(&mut self, area: &Area, filter: Filter) {
        let values = panel_of(&self.calibrated, area);
        let out = panel_mut(&mut self.filtered, area);
        match filter {
            Filter::Off => {}
            Filter::Conservative => {
                conservative(values, out, area, grain(area), &mut self.rows);
            }
            Filter::Persistent => {
                if conservative(values, out, area, grain(area), &mut self.rows) {
                    self.points.restore(values, out, area, &self.rows);
                }
            }
            #[cfg(target_pointer_width = "64")]
            Filter::Median if usize::from(area.columns) >= FEWEST => {
                median_by_eights(values, out, area, grain(area), &mut self.rows)
            }
            Filter::Median => median(values, out, area, grain(area), &mut self.rows),
            Filter::Square => square(values, out, area, &self.rows),
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::super::{ConditionConfig, ConditionState, Feedback, Filter, Sampled};
    use crate::format::{Code, Micros};
    use crate::garment::{Garment, Layout};
    use std::vec::Vec;

    #[test]
    fn what_each_filter_keeps() {
        let layout = Layout::build(&Garment::block(), 64, u16::MAX).unwrap();
        let kept = |filter, taxels: &[(usize, u16)]| {
            let mut codes = [Code(0); 64];
            taxels.iter().for_each(|(taxel, code)| codes[*taxel] = Code(*code));
            let mut state = ConditionState::<64>::new();
            state.reset(&layout, Code(0));
            let condition = ConditionConfig { filter, ..ConditionConfig::default() }.build().unwrap();
            let sampled = Sampled { codes: &codes, falling: false, panels: 1, now: Micros(0) };
            let image = condition.process(&mut state, &layout, &sampled, &Feedback::<1>::new());
            image.values.iter().filter(|v| **v > 0).count()
        };
        let finger = [(20, 900), (21, 900), (36, 900), (37, 900)];
        let line: Vec<(usize, u16)> = (16..32).map(|taxel| (taxel, 500)).collect();
        let filters = [Filter::Conservative, Filter::Median, Filter::Square];
        assert_eq!(filters.map(|f| kept(f, &finger)), [4, 0, 4]);
        assert_eq!(filters.map(|f| kept(f, &line)), [16, 0, 16]);
        // An impulse is removed, on the border too; a gap is bridged.
        assert_eq!(kept(Filter::Conservative, &[(37, 4000)]), 0);
        assert_eq!(kept(Filter::Conservative, &[(0, 4000)]), 0);
        let gap: Vec<_> = (0..64).filter(|t| *t != 37).map(|taxel| (taxel, 500)).collect();
        assert_eq!(kept(Filter::Conservative, &gap), 64);
    }
}
