//! The choice of contacts among the components, and their moments.

use super::config::ContactConfig;
use super::join::{Joins, weigh};
use super::label::Labels;
use super::moments::{FEW, Moments, is_small};
use super::part::{NONE, Part};
use super::piece::Piece;
use super::strip::{Strip, strips, values_of};
use super::sums::{NARROW, squares};
use crate::condition::{CARRIED, Feedback, Image, Pressed};
use crate::format::{Fixed16, Inverse};
use crate::garment::{Area, Layout, Place, Rect};
use core::slice::from_ref;
use heapless::Vec;

/// A connected touch of one frame, not yet tracked.
#[derive(Debug, Clone)]
pub struct Component {
    /// Root of its parts.
    pub(super) part: u16,
    pub(super) joined: bool,
    /// Sum of the pressure, counts.
    pub total: u32,
    /// Greatest pressure of a taxel, counts.
    pub peak: u16,
    /// First taxel with the greatest value.
    pub peak_at: Option<Place>,
    /// Number of taxels.
    pub area: u16,
    /// Bounding box of its taxels in the home panel.
    pub bounds: Rect,
    /// Moments in the frame of the home panel.
    pub moments: Moments,
    /// Inverse of the total.
    pub(super) inverse: Inverse,
    /// Centroid in the frame of the home panel, column; rounded once: half a step off at most.
    pub x: Fixed16,
    /// Centroid, row; rounded like `x`.
    pub y: Fixed16,
}

const NOWHERE: Rect = Rect { panel: 0, top: u16::MAX, bottom: 0, left: u16::MAX, right: 0 };

/// Sums of a component before its moments are measured.
struct Found {
    part: u16,
    joined: bool,
    total: u32,
    peak: u16,
    area: u16,
    panel: u8,
}

/// The components of a frame.
#[derive(Debug, Clone)]
pub(super) struct Components<const CONTACTS: usize> {
    pub list: Vec<Component, CONTACTS>,
    /// Index of a component, and bounding box of its taxels on a panel other than its home.
    pub beyond: Vec<(u16, Rect), CARRIED>,
    /// Number of contacts of this frame that did not fit.
    pub dropped: u16,
    /// Panels with a component that is nearly a contact, one bit each.
    pub faint: u8,
}

impl<const CONTACTS: usize> Components<CONTACTS> {
    pub const fn new() -> Self {
        const { assert!(CONTACTS < NONE as usize, "a contact is numbered with 16 bits") };
        Components { list: Vec::new(), beyond: Vec::new(), dropped: 0, faint: 0 }
    }

    /// Picks the components that are contacts; if they do not fit, those with the greatest totals.
    pub fn select<const RUNS: usize, const PARTS: usize>(
        &mut self,
        config: &ContactConfig,
        labels: &Labels<RUNS, PARTS>,
    ) {
        self.list.clear();
        self.beyond.clear();
        (self.dropped, self.faint) = (0, 0);
        let mut least = None;
        for (index, part) in labels.whole_parts().filter(|(index, part)| part.group == *index) {
            let (total, peak, area, held) = if part.joined {
                weigh(labels, index)
            } else {
                (part.mass, part.peak as u16, part.area, part.held)
            };
            if area < config.min_area || (peak < config.high && !held) {
                if peak >= config.high - config.high / 4 {
                    self.faint |= 1u8.checked_shl(part.panel.into()).unwrap_or(0);
                }
                continue;
            }
            let found = Found { part: index, joined: part.joined, total, peak, area, panel: part.panel };
            if self.list.is_full() {
                self.dropped = self.dropped.saturating_add(1);
                self.replace_least(&mut least, &found);
            } else if self.list.push(Component::BLANK).is_ok()
                && let Some(component) = self.list.last_mut()
            {
                component.begin(&found);
            }
        }
    }

    /// Replaces the component with the smallest total if `found` has more. `least` caches that component.
    fn replace_least(&mut self, least: &mut Option<(usize, u32)>, found: &Found) {
        // Among equal totals the last one found is replaced.
        let totals = || self.list.iter().map(|kept| kept.total).enumerate().rev();
        let Some((index, smallest)) = least.or_else(|| totals().min_by_key(|(_, total)| *total)) else {
            return;
        };
        *least = Some((index, smallest));
        if smallest < found.total
            && let Some(kept) = self.list.get_mut(index)
        {
            kept.begin(found);
            *least = None;
        }
    }

    /// Gives each part the index of its contact.
    pub fn number<const RUNS: usize, const PARTS: usize>(&self, labels: &mut Labels<RUNS, PARTS>) {
        for (index, component) in (0u16..).zip(&self.list) {
            if let Some(part) = labels.parts.get_mut(usize::from(component.part)) {
                part.contact = index;
            }
        }
        // The root of a part has a smaller index, so it has its number already.
        for index in 0..labels.parts.len() {
            let Some(part) = labels.parts.get(index) else { return };
            let first = if usize::from(part.parent) == index { part.group } else { part.parent };
            if usize::from(first) == index {
                continue;
            }
            let contact = labels.parts.get(usize::from(first)).map_or(NONE, |part| part.contact);
            if let Some(part) = labels.parts.get_mut(index) {
                part.contact = contact;
            }
        }
    }

    /// Measures the moments, bounds and centroids of all components.
    pub fn measure<const RUNS: usize, const PARTS: usize>(
        &mut self,
        labels: &Labels<RUNS, PARTS>,
        joins: &mut Joins,
        layout: &Layout,
        image: &Image,
    ) {
        for (index, component) in (0u16..).zip(&mut self.list).filter(|(_, c)| c.joined) {
            component.bounds.panel = joins.settle(labels, layout, index);
        }
        if usize::BITS >= 64 {
            self.take_pieces(labels, joins, layout, image);
        } else {
            self.take_strips(labels, joins, layout, image);
        }
        for (contact, moments) in joins.carried_moments() {
            if let Some(component) = self.list.get_mut(usize::from(contact)) {
                component.moments.add(&moments);
            }
        }
        for component in &mut self.list {
            component.locate();
        }
    }

    /// Adds the pieces to their components, strip by strip, so that the sums of a strip stay in registers.
    #[inline(never)] // M0+: out of line
    fn take_strips<const RUNS: usize, const PARTS: usize>(
        &mut self,
        labels: &Labels<RUNS, PARTS>,
        joins: &mut Joins,
        layout: &Layout,
        image: &Image,
    ) {
        for pieces in strips(&labels.pieces) {
            let Some(part) = pieces.first().and_then(|piece| labels.parts.get(usize::from(piece.part)))
            else {
                continue;
            };
            let Some(component) = self.list.get_mut(usize::from(part.contact)) else { continue };
            let Some(area) = layout.areas().get(usize::from(part.panel)) else { continue };
            let strip = Strip { pieces, part, area, values: image.values };
            if component.take(&strip, joins) {
                self.widen_beyond(&strip);
            }
        }
    }

    /// Adds the pieces to their components one by one. For a machine with many registers: most strips of wide
    /// rows are of one piece.
    fn take_pieces<const RUNS: usize, const PARTS: usize>(
        &mut self,
        labels: &Labels<RUNS, PARTS>,
        joins: &mut Joins,
        layout: &Layout,
        image: &Image,
    ) {
        let areas = layout.areas();
        for piece in &labels.pieces {
            let Some(part) = labels.parts.get(usize::from(piece.part)) else { continue };
            let Some(component) = self.list.get_mut(usize::from(part.contact)) else { continue };
            let Some(area) = areas.get(usize::from(part.panel)) else { continue };
            if component.joined {
                let strip = Strip { pieces: from_ref(piece), part, area, values: image.values };
                if component.take(&strip, joins) {
                    self.widen_beyond(&strip);
                }
            } else {
                component.add_piece(piece, area, image.values);
            }
        }
    }

    #[inline(never)] // only across seams
    fn widen_beyond(&mut self, strip: &Strip) {
        let Part { contact, panel, .. } = *strip.part;
        match self.beyond.iter_mut().find(|(i, rect)| *i == contact && rect.panel == panel) {
            Some((_, rect)) => strip.widen(rect),
            None => {
                let mut rect = Rect { panel, ..NOWHERE };
                strip.widen(&mut rect);
                // Always room: at most one entry per join, and the list has as many places as joins.
                let _ = self.beyond.push((contact, rect));
            }
        }
    }

    /// Fills in the contacts' rectangles and peaks that the next frame's conditioning needs.
    pub fn feed_back(&self, feedback: &mut Feedback<CONTACTS>) {
        feedback.home.clear();
        feedback.beyond.clear();
        // Each list has the capacity of its source. (`extend` would panic on a full one.)
        for component in &self.list {
            let _ = feedback.home.push(Pressed { rect: component.bounds, peak: component.peak });
        }
        for (contact, rect) in &self.beyond {
            let peak = self.list.get(usize::from(*contact)).map_or(0, |component| component.peak);
            let _ = feedback.beyond.push(Pressed { rect: *rect, peak });
        }
    }
}

impl Component {
    /// A component without taxels.
    const BLANK: Component = Component {
        part: NONE,
        joined: false,
        total: 0,
        peak: 0,
        peak_at: None,
        area: 0,
        bounds: NOWHERE,
        moments: Moments::NONE,
        inverse: Inverse::of(0),
        x: Fixed16(0),
        y: Fixed16(0),
    };

    /// Starts over with what was found; neither component has been measured yet.
    fn begin(&mut self, found: &Found) {
        let Found { part, joined, total, peak, area, panel } = *found;
        (self.part, self.joined) = (part, joined);
        (self.total, self.peak, self.area) = (total, peak, area);
        self.bounds.panel = panel;
    }

    /// Pieces in the rows of its box, with their indices; all pieces if it lies on several panels.
    pub(super) fn pieces<'l, const RUNS: usize, const PARTS: usize>(
        &self,
        labels: &'l Labels<RUNS, PARTS>,
        layout: &Layout,
    ) -> impl Iterator<Item = (usize, &'l Piece)> {
        let area = layout.areas().get(usize::from(self.bounds.panel)).filter(|_| !self.joined);
        let rows = area.map_or((0, u16::MAX), |area| {
            (area.first_row + self.bounds.top, area.first_row + self.bounds.bottom)
        });
        labels.in_rows(rows.0, rows.1)
    }

    /// Adds another component of the same home panel.
    pub(super) fn absorb(&mut self, other: &Component) {
        let place = |component: &Component| component.peak_at.map(|at| (at.panel, at.row, at.column));
        if (other.peak, place(self)) > (self.peak, place(other)) {
            (self.peak, self.peak_at) = (other.peak, other.peak_at);
        }
        self.joined |= other.joined;
        self.total = self.total.saturating_add(other.total);
        self.area = self.area.saturating_add(other.area);
        self.moments.add(&other.moments);
        let (bounds, more) = (&mut self.bounds, &other.bounds);
        (bounds.top, bounds.bottom) = (bounds.top.min(more.top), bounds.bottom.max(more.bottom));
        (bounds.left, bounds.right) = (bounds.left.min(more.left), bounds.right.max(more.right));
        self.locate();
    }

    /// Computes the centroid, rounded once to the nearest 2^-16 taxel.
    fn locate(&mut self) {
        self.inverse = Inverse::of(self.total);
        let mean = |sum: i64| {
            let fits = sum.unsigned_abs() >> 47 == 0;
            Fixed16(self.inverse.nearest(if fits { sum << 16 } else { sum.signum() * i64::MAX }))
        };
        (self.x, self.y) = (mean(self.moments.sx), mean(self.moments.sy));
    }

    /// Adds a strip; returns true if it lies on a panel other than the home.
    #[inline(always)]
    fn take(&mut self, strip: &Strip, joins: &mut Joins) -> bool {
        self.add(strip, joins);
        let beyond = strip.part.panel != self.bounds.panel;
        if !beyond {
            strip.widen(&mut self.bounds);
        }
        beyond
    }

    /// Adds a piece of a component that lies on one panel.
    #[inline(always)]
    fn add_piece(&mut self, piece: &Piece, area: &Area, values: &[u16]) {
        let row = piece.row - area.first_row;
        let squares = match piece.peak {
            0..=NARROW => piece.sums.squares.into(),
            _ => squares(values_of(piece, area, values), piece.rebased()),
        };
        self.moments.add(&Moments::of_sums(piece.left.into(), row.into(), &piece.sums, squares));
        let Rect { top, bottom, left, right, .. } = &mut self.bounds;
        (*top, *bottom) = (row.min(*top), row);
        (*left, *right) = (piece.left.min(*left), piece.right.max(*right));
        if piece.peak == self.peak && self.peak_at.is_none_or(|at| at.row == row) {
            self.look_for_peak(piece, self.bounds.panel, area, values);
        }
    }

    /// Adds the pieces of a strip to the moments.
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))] // M0+: out of line
    fn add(&mut self, strip: &Strip, joins: &mut Joins) {
        // Moments of a carried part stay in its own coordinates until all its pieces are added.
        let carried = if self.joined { joins.moments_of(strip.part.parent) } else { None };
        let moments = carried.unwrap_or(&mut self.moments);
        let &Strip { pieces, area, .. } = strip;
        if pieces.len() > 2 && is_small(area.columns, area.rows, self.peak) {
            // One piece per row, so that a chunk has at most FEW rows.
            pieces.chunks(FEW).for_each(|pieces| moments.add_few(pieces, area.first_row));
        } else {
            for piece in pieces {
                let row = piece.row - area.first_row;
                let squares = || squares(values_of(piece, area, strip.values), piece.rebased());
                moments.add_piece(piece.left.into(), row.into(), &piece.sums, piece.peak, squares);
            }
        }
        let peak = self.peak;
        if let Some(piece) = strip.pieces.iter().find(|piece| piece.peak == peak) {
            self.look_for_peak(piece, strip.part.panel, area, strip.values);
        }
    }

    /// Updates `peak_at` from a piece that has the peak, to the first such taxel of the row. The pieces of a
    /// row may come in any order.
    #[inline(never)] // rarely called
    fn look_for_peak(&mut self, piece: &Piece, panel: u8, area: &Area, values: &[u16]) {
        let row = piece.row - area.first_row;
        let mut columns = (piece.left..).zip(values_of(piece, area, values));
        let mine = |column| piece.holds(column);
        let Some((column, _)) = columns.find(|(column, value)| **value == self.peak && mine(*column)) else {
            return;
        };
        let first = |at: Place| at.panel == panel && at.row == row && column < at.column;
        if self.peak_at.is_none_or(first) {
            self.peak_at = Some(Place { panel, row, column });
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::condition::Rows;
    use crate::garment::{Edge, Garment, Seam, Side};
    use std::vec;
    use std::vec::Vec;

    /// Panels of one or several words a row, with and without a seam.
    #[test]
    fn strips_add_up_to_what_their_pieces_do() {
        let mut noise = 1u32;
        let mut next = |end: u32| {
            noise = noise.wrapping_mul(1664525).wrapping_add(1013904223);
            (noise >> 16) % end
        };
        for (round, columns) in (0..60).flat_map(|round| [16, 31, 40, 64].map(|columns| (round, columns))) {
            let mut garment = Garment::recorded(12, columns);
            let mut second = garment.panels[0].clone();
            second.name = crate::format::Name::try_from("second").unwrap();
            garment.panels.push(second).unwrap();
            if round % 2 == 0 {
                let [a, b] =
                    [(0, Side::Bottom), (1, Side::Top)].map(|(panel, side)| Edge { panel, side, start: 0 });
                garment.seams.push(Seam { a, b, length: columns, reversed: false }).unwrap();
            }
            let layout = Layout::build(&garment, 3072, 4095).unwrap();
            let (share, peak) = (next(80), [4095, u16::MAX][round / 2 % 2]);
            let mut values = vec![0; layout.taxels()];
            values.fill_with(|| if next(100) < share { 1 + next(peak.into()) as u16 } else { 0 });
            let rows = Rows::of(&layout, &values);
            let image = Image { values: &values, rows: &rows };
            let (mut labels, mut joins) = (Labels::<2048, 2048>::new(), Joins::new());
            labels.scan(&layout, &image, 1);
            joins.find(&mut labels, &layout);
            let mut components = Components::<40>::new();
            components.select(&ContactConfig { low: 1, high: 1, ..Default::default() }, &labels);
            components.number(&mut labels);
            let mut found = [false, true].map(|strips| {
                let (mut components, mut joins) = (components.clone(), joins.clone());
                for (index, component) in (0u16..).zip(&mut components.list).filter(|(_, c)| c.joined) {
                    component.bounds.panel = joins.settle(&labels, &layout, index);
                }
                if strips {
                    components.take_strips(&labels, &mut joins, &layout, &image);
                } else {
                    components.take_pieces(&labels, &mut joins, &layout, &image);
                }
                let each = components.list.iter().map(|c| (c.moments, c.bounds, c.peak_at));
                let carried: Vec<_> = joins.carried_moments().collect();
                (each.collect::<Vec<_>>(), components.beyond, carried)
            });
            found[0].1.sort_unstable_by_key(|(index, _)| *index);
            found[1].1.sort_unstable_by_key(|(index, _)| *index);
            assert_eq!(found[0], found[1], "{columns} columns, {share} %");
        }
    }
}
