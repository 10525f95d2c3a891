//! Faint labels near contacts of the previous frame, which continue those contacts.

use super::labeller::Labeller;
use crate::baseline::feedback::{Feedback, Pressed};
use crate::garment::{Area, Layout, Rect};

impl<const RUNS: usize, const LABELS: usize> Labeller<RUNS, LABELS> {
    /// Marks the labels that come within one taxel of a contact of the previous frame. Only labels that begin
    /// no contact by themselves need the mark, and most frames have none.
    pub fn mark_held<const CONTACTS: usize>(
        &mut self,
        layout: &Layout,
        last: &Feedback<CONTACTS>,
        high: u16,
    ) {
        // The least peak is at most twice the threshold.
        if self.roots().all(|(_, label)| label.peak >= 2 * u32::from(high)) {
            return;
        }
        for Pressed { rect, .. } in last.home.iter().chain(&last.beyond) {
            if let Some(area) = layout.areas().get(usize::from(rect.panel)) {
                self.mark_held_by(area, rect);
            }
        }
    }

    fn mark_held_by(&mut self, area: &Area, rect: &Rect) {
        let top = area.first_row.saturating_add(rect.top.saturating_sub(1));
        let bottom = area.first_row.saturating_add(rect.bottom.saturating_add(1));
        let (left, right) = (rect.left.saturating_sub(1), rect.right.saturating_add(1));
        let from = self.runs.partition_point(|run| run.row < top);
        for run in self.runs.iter().skip(from).take_while(|run| run.row <= bottom) {
            let label = self.labels.get(usize::from(run.label)).filter(|label| label.panel == rect.panel);
            if let Some(first) = label.map(|label| label.parent).filter(|_| run.within(left, right) != 0)
                && let Some(label) = self.labels.get_mut(usize::from(first))
            {
                label.held = true;
            }
        }
    }
}
