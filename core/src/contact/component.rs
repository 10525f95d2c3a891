//! Which components are contacts, and what is measured on each of them.

use super::config::ContactConfig;
use super::join::{Joins, weigh};
use super::label::Labels;
use super::moments::{FEW, Moments, is_small};
use super::part::{NONE, Part};
use super::piece::Piece;
use super::strip::{Strip, strips};
use super::sums::squares;
use crate::condition::{CARRIED, Feedback, Image};
use crate::format::{Fixed16, Inverse};
use crate::garment::{Layout, Place, Rect};
use heapless::Vec;

/// A connected touch of one frame, not yet tracked.
#[derive(Debug, Clone)]
pub struct Component {
    /// Its first part.
    pub(super) part: u16,
    joined: bool,
    /// Sum of the pressure, counts.
    pub total: u32,
    /// Greatest pressure of a taxel, counts.
    pub peak: u16,
    /// First taxel with the greatest value.
    pub peak_at: Option<Place>,
    /// Taxels.
    pub area: u16,
    /// In the home panel, where it lies there.
    pub bounds: Rect,
    /// In the frame of the home panel.
    pub moments: Moments,
    /// Of its mass, the total.
    pub(super) inverse: Inverse,
    /// Centroid in the frame of the home panel, rounded once: half a step off at most.
    pub x: Fixed16,
    /// As `x`, across the rows.
    pub y: Fixed16,
}

const NOWHERE: Rect = Rect { panel: 0, top: u16::MAX, bottom: 0, left: u16::MAX, right: 0 };

/// What is known of a component before it is measured.
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
    /// Parts of them beyond a seam: which component, where.
    pub beyond: Vec<(u16, Rect), CARRIED>,
    /// Contacts that did not fit, in this frame.
    pub dropped: u16,
}

impl<const CONTACTS: usize> Components<CONTACTS> {
    pub const fn new() -> Self {
        const { assert!(CONTACTS < NONE as usize, "a contact is numbered with 16 bits") };
        Components { list: Vec::new(), beyond: Vec::new(), dropped: 0 }
    }

    /// Picks the components that are contacts; where they do not fit, those with the greatest totals.
    pub fn select<const RUNS: usize, const PARTS: usize>(
        &mut self,
        config: &ContactConfig,
        labels: &Labels<RUNS, PARTS>,
    ) {
        self.list.clear();
        self.beyond.clear();
        self.dropped = 0;
        let mut least = None;
        for (index, part) in labels.whole_parts().filter(|(index, part)| part.group == *index) {
            let (total, peak, area, held) =
                if part.joined { weigh(labels, index) } else { (part.mass, part.peak, part.area, part.held) };
            if area < config.min_area || (peak < config.high && !held) {
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

    /// Puts a component in the place of the one with the smallest total, which `least` remembers, if it has more.
    fn replace_least(&mut self, least: &mut Option<(usize, u32)>, found: &Found) {
        // Of equals the last found gives way.
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

    /// Tells the parts which contact they belong to.
    pub fn number<const RUNS: usize, const PARTS: usize>(&self, labels: &mut Labels<RUNS, PARTS>) {
        for (index, component) in (0u16..).zip(&self.list) {
            if let Some(part) = labels.parts.get_mut(usize::from(component.part)) {
                part.contact = index;
            }
        }
        // The one that stands for a part has a smaller index, and its number already.
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

    /// Measures all components.
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
        self.take_pieces(labels, joins, layout, image);
        for (contact, moments) in joins.carried_moments() {
            if let Some(component) = self.list.get_mut(usize::from(contact)) {
                component.moments.add(&moments);
            }
        }
        for component in &mut self.list {
            component.locate();
        }
    }

    /// Adds the pieces to the components that they belong to.
    #[inline(never)] // the few registers of an M0+ are for its loop
    fn take_pieces<const RUNS: usize, const PARTS: usize>(
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
            component.add(&strip, joins);
            if part.panel == component.bounds.panel {
                strip.widen(&mut component.bounds);
            } else {
                self.widen_beyond(&strip);
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
                // At most one per join, and there are no more joins than places.
                let _ = self.beyond.push((contact, rect));
            }
        }
    }

    /// What the next frame is told.
    pub fn feed_back(&self, feedback: &mut Feedback<CONTACTS>) {
        feedback.home.clear();
        feedback.beyond.clear();
        // Each list has the capacity of its source. (`extend` would panic on a full one.)
        for component in &self.list {
            let _ = feedback.home.push(component.bounds);
        }
        for (_, rect) in &self.beyond {
            let _ = feedback.beyond.push(*rect);
        }
    }
}

impl Component {
    /// Of nothing.
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

    /// Becomes what was found, in place of another that was not measured either.
    fn begin(&mut self, found: &Found) {
        let Found { part, joined, total, peak, area, panel } = *found;
        (self.part, self.joined) = (part, joined);
        (self.total, self.peak, self.area) = (total, peak, area);
        self.bounds.panel = panel;
    }

    /// The pieces of its rows, with their numbers; of one that lies on several panels all.
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

    /// Finds the centroid, rounded once to the nearest 2^-16 taxel.
    fn locate(&mut self) {
        self.inverse = Inverse::of(self.total);
        let mean = |sum: i64| {
            let fits = sum.unsigned_abs() >> 47 == 0;
            Fixed16(self.inverse.nearest(if fits { sum << 16 } else { sum.signum() * i64::MAX }))
        };
        (self.x, self.y) = (mean(self.moments.sx), mean(self.moments.sy));
    }

    /// Adds pieces to the sums.
    #[inline(never)] // the few registers of an M0+ are for this
    fn add(&mut self, strip: &Strip, joins: &mut Joins) {
        // Of parts that are carried the sums are, once all their pieces are in.
        let carried = if self.joined { joins.moments_of(strip.part.parent) } else { None };
        let moments = carried.unwrap_or(&mut self.moments);
        let &Strip { pieces, area, .. } = strip;
        if pieces.len() > 2 && is_small(area.columns, area.rows, self.peak) {
            // One piece in a row.
            pieces.chunks(FEW).for_each(|pieces| moments.add_few(pieces, area.first_row));
        } else {
            for piece in pieces {
                let row = piece.row - area.first_row;
                let squares = || squares(strip.values(piece), piece.rebased());
                moments.add_piece(piece.left.into(), row.into(), &piece.sums, piece.peak, squares);
            }
        }
        let peak = self.peak;
        if let Some(piece) = strip.pieces.iter().find(|piece| piece.peak == peak) {
            self.look_for_peak(strip, piece);
        }
    }

    /// Notes where the greatest value is first found, in a piece that has it. The pieces of a row may come in any order.
    #[inline(never)] // rarely called
    fn look_for_peak(&mut self, strip: &Strip, piece: &Piece) {
        let (panel, row) = (strip.part.panel, piece.row - strip.area.first_row);
        let mut columns = (piece.left..).zip(strip.values(piece));
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
