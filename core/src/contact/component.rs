//! Which components are contacts, and what is measured on each of them.

use super::config::ContactConfig;
use super::join::{Joins, weigh};
use super::label::Labels;
use super::moments::Moments;
use super::run::{NONE, Run};
use crate::condition::{CARRIED, Feedback, Image, row_of};
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
    pub fn select<const RUNS: usize>(&mut self, config: &ContactConfig, labels: &Labels<RUNS>) {
        self.list.clear();
        self.beyond.clear();
        self.dropped = 0;
        let mut least = None;
        for (part, run) in labels.parts().filter(|(part, run)| run.group == *part) {
            let (total, peak, area, held) =
                if run.joined { weigh(labels, part) } else { (run.mass, run.peak, run.area, run.held) };
            if area < config.min_area || (peak < config.high && !held) {
                continue;
            }
            let found = || Component {
                part,
                joined: run.joined,
                total,
                peak,
                peak_at: None,
                area,
                bounds: Rect { panel: run.panel, ..NOWHERE },
                moments: Moments::default(),
                inverse: Inverse::of(0),
                x: Fixed16(0),
                y: Fixed16(0),
            };
            if self.list.is_full() {
                self.dropped = self.dropped.saturating_add(1);
                self.replace_least(&mut least, total, found);
            } else {
                let _ = self.list.push(found());
            }
        }
    }

    /// Puts a component in the place of the one with the smallest total, which `least` remembers, if it has more.
    fn replace_least(
        &mut self,
        least: &mut Option<(usize, u32)>,
        total: u32,
        found: impl FnOnce() -> Component,
    ) {
        // Of equals the last found gives way.
        let totals = || self.list.iter().map(|kept| kept.total).enumerate().rev();
        let Some((index, smallest)) = least.or_else(|| totals().min_by_key(|(_, total)| *total)) else {
            return;
        };
        *least = Some((index, smallest));
        if smallest < total
            && let Some(kept) = self.list.get_mut(index)
        {
            *kept = found();
            *least = None;
        }
    }

    /// Tells the parts which contact they belong to.
    pub fn number<const RUNS: usize>(&self, labels: &mut Labels<RUNS>) {
        for (index, component) in (0u16..).zip(&self.list) {
            if let Some(run) = labels.runs.get_mut(usize::from(component.part)) {
                run.contact = index;
            }
        }
        if self.list.iter().all(|component| !component.joined) {
            return;
        }
        for part in 0..labels.runs.len() {
            let Some(run) = labels.runs.get(part).filter(|run| run.joined) else { continue };
            // A smaller part stands for this one, and it has its number already.
            let contact = labels.runs.get(usize::from(run.group)).map_or(NONE, |run| run.contact);
            if let Some(run) = labels.runs.get_mut(part) {
                run.contact = contact;
            }
        }
    }

    /// Measures all components.
    pub fn measure<const RUNS: usize>(
        &mut self,
        labels: &Labels<RUNS>,
        joins: &mut Joins,
        layout: &Layout,
        image: &Image,
        low: u16,
    ) {
        for (index, component) in (0u16..).zip(&mut self.list).filter(|(_, c)| c.joined) {
            component.bounds.panel = joins.settle(labels, layout, index);
        }
        self.take_runs(labels, joins, layout, image, low);
        for (contact, moments) in joins.carried_moments() {
            if let Some(component) = self.list.get_mut(usize::from(contact)) {
                component.moments.add(&moments);
            }
        }
        for component in &mut self.list {
            component.locate();
        }
    }

    /// Adds the runs to the components that they belong to, those of one part and row at once.
    #[inline(never)] // the few registers of an M0+ are for its loop
    fn take_runs<const RUNS: usize>(
        &mut self,
        labels: &Labels<RUNS>,
        joins: &mut Joins,
        layout: &Layout,
        image: &Image,
        low: u16,
    ) {
        let mut rest = labels.runs.as_slice();
        while let Some((first, after)) = rest.split_first() {
            let more = after.iter().take_while(|run| run.row == first.row && run.parent == first.parent);
            let (runs, later) = rest.split_at_checked(1 + more.count()).unwrap_or((rest, &[]));
            rest = later;
            let Some(index) = labels.contact_of(first) else { continue };
            let Some(component) = self.list.get_mut(usize::from(index)) else { continue };
            let Some(area) = layout.areas().get(usize::from(first.panel)) else { continue };
            let row = first.row - area.first_row;
            let Some(span) = Span::of(runs, row) else { continue };
            component.add(&span, row_of(image.values, area, row), joins, low);
            if span.panel != component.bounds.panel {
                self.widen_beyond(index, &span);
            }
        }
    }

    fn widen_beyond(&mut self, index: u16, span: &Span) {
        match self.beyond.iter_mut().find(|(i, rect)| *i == index && rect.panel == span.panel) {
            Some((_, rect)) => widen(rect, span),
            None => {
                let mut rect = Rect { panel: span.panel, ..NOWHERE };
                widen(&mut rect, span);
                // At most one per join, and there are no more joins than places.
                let _ = self.beyond.push((index, rect));
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

/// The runs of one part in one row, and what is between them.
struct Span {
    part: u16,
    panel: u8,
    /// in the panel
    row: u16,
    left: u16,
    /// last column
    right: u16,
    /// At least the greatest value.
    peak: u16,
    /// There is nothing between.
    whole: bool,
}

impl Span {
    /// Of at least one run.
    fn of(runs: &[Run], row: u16) -> Option<Span> {
        let (first, last) = (runs.first()?, runs.last()?);
        let peak = runs.iter().map(|run| run.peak).fold(0, u16::max);
        let whole = runs.len() == 1;
        Some(Span {
            part: first.parent,
            panel: first.panel,
            row,
            left: first.left,
            right: last.right,
            peak,
            whole,
        })
    }
}

fn widen(rect: &mut Rect, span: &Span) {
    // The rows come one after the other.
    if span.row < rect.top {
        rect.top = span.row;
    }
    rect.bottom = span.row;
    rect.left = rect.left.min(span.left);
    rect.right = rect.right.max(span.right);
}

impl Component {
    /// Its runs; its number is `index`.
    pub(super) fn runs<'l, const RUNS: usize>(
        &self,
        index: u16,
        labels: &'l Labels<RUNS>,
        layout: &Layout,
    ) -> impl Iterator<Item = &'l Run> {
        let (part, joined) = (self.part, self.joined);
        let area = layout.areas().get(usize::from(self.bounds.panel)).filter(|_| !joined);
        let runs = match area {
            Some(area) => {
                labels.in_rows(area.first_row + self.bounds.top, area.first_row + self.bounds.bottom)
            }
            None => &labels.runs,
        };
        runs.iter().filter(move |run| run.parent == part || (joined && labels.contact_of(run) == Some(index)))
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

    /// Adds runs to the sums, given with the values of their row; those below `low` are between the runs.
    #[inline(never)] // the few registers of an M0+ are for this
    fn add(&mut self, span: &Span, row: &[u16], joins: &mut Joins, low: u16) {
        let values = row.get(span.left.into()..usize::from(span.right) + 1).unwrap_or(&[]);
        // Of parts that are carried the sums are, once all their runs are in.
        let carried = if self.joined { joins.moments_of(span.part) } else { None };
        let (x, y) = (span.left.into(), span.row.into());
        let floor = if span.whole { 0 } else { low };
        carried.unwrap_or(&mut self.moments).add_run(x, y, values, floor, self.peak);
        if self.peak_at.is_none()
            && span.peak == self.peak
            && let Some((column, _)) = (span.left..).zip(values).find(|(_, value)| **value == self.peak)
        {
            self.peak_at = Some(Place { panel: span.panel, row: span.row, column });
        }
        if span.panel == self.bounds.panel {
            widen(&mut self.bounds, span);
        }
    }
}
