//! Faint parts near contacts of the previous frame, which continue those contacts.

use super::labels::Labels;
use crate::baseline::feedback::{Feedback, Pressed};
use crate::garment::{Area, Layout, Rect};

impl<const RUNS: usize, const PARTS: usize> Labels<RUNS, PARTS> {
    /// Marks the parts that come within one taxel of a contact of the previous frame. Only parts with a peak
    /// below `high` need the mark, and most frames have none.
    pub fn mark_held<const CONTACTS: usize>(
        &mut self,
        layout: &Layout,
        last: &Feedback<CONTACTS>,
        high: u16,
    ) {
        if self.whole_parts().all(|(_, part)| part.peak >= high.into()) {
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
        let from = self.pieces.partition_point(|piece| piece.row < top);
        for piece in self.pieces.iter().skip(from).take_while(|piece| piece.row <= bottom) {
            let part = self.parts.get(usize::from(piece.part)).filter(|part| part.panel == rect.panel);
            if let Some(first) = part.map(|part| part.parent).filter(|_| piece.within(left, right) != 0)
                && let Some(part) = self.parts.get_mut(usize::from(first))
            {
                part.held = true;
            }
        }
    }
}
