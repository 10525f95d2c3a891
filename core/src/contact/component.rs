//! Which components are contacts, and what is measured on each of them.

use super::config::ContactConfig;
use super::join::{Joins, weigh};
use super::label::{Labels, NONE, Run};
use super::moments::Moments;
use crate::condition::{CARRIED, Feedback, Image, Neighbourhood};
use crate::format::{Fixed16, Inverse};
use crate::garment::{Area, Layout, Place, Rect};
use heapless::Vec;

/// A connected touch of one frame, not yet tracked.
#[derive(Debug, Clone)]
pub(super) struct Component {
    /// Its first part.
    pub part: u16,
    joined: bool,
    pub total: u32,
    pub peak: u16,
    /// First taxel with the greatest value.
    pub peak_at: Option<Place>,
    pub area: u16,
    pub perimeter: u16,
    /// Sum of the Sobel magnitudes over the contour, in eighths.
    pub slope: u32,
    /// In the home panel, where it lies there.
    pub bounds: Rect,
    /// In the frame of the home panel.
    pub moments: Moments,
    pub x: Fixed16,
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
        for (part, run) in labels.parts().filter(|(part, run)| run.group == *part) {
            let (total, peak, area, held) =
                if run.joined { weigh(labels, part) } else { (run.mass, run.peak, run.area, run.held) };
            if area < config.min_area || (peak < config.high && !held) {
                continue;
            }
            self.keep(Component {
                part,
                joined: run.joined,
                total,
                peak,
                peak_at: None,
                area,
                perimeter: 0,
                slope: 0,
                bounds: Rect { panel: run.panel, ..NOWHERE },
                moments: Moments::default(),
                x: Fixed16(0),
                y: Fixed16(0),
            });
        }
    }

    fn keep(&mut self, found: Component) {
        let Err(found) = self.list.push(found) else { return };
        self.dropped = self.dropped.saturating_add(1);
        // Of equals the last found gives way.
        if let Some(least) = self.list.iter_mut().rev().min_by_key(|kept| kept.total)
            && least.total < found.total
        {
            *least = found;
        }
    }

    /// Numbers the parts: the group of each becomes the index of its contact, or [`NONE`].
    pub fn number<const RUNS: usize>(&self, labels: &mut Labels<RUNS>) {
        for part in 0..labels.runs.len() as u16 {
            let Some(run) = labels.runs.get(usize::from(part)).copied() else { return };
            let group = match run.group {
                _ if run.parent != part => continue,
                own if own == part => {
                    self.list.iter().position(|c| c.part == part).map_or(NONE, |index| index as u16)
                }
                // A smaller part stands for this one, and it has its number already.
                first => labels.runs.get(usize::from(first)).map_or(NONE, |run| run.group),
            };
            if let Some(run) = labels.runs.get_mut(usize::from(part)) {
                run.group = group;
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
        for run in &labels.runs {
            let Some(index) = labels.contact_of(run) else { continue };
            let Some(component) = self.list.get_mut(usize::from(index)) else { continue };
            let Some(area) = layout.areas().get(usize::from(run.panel)) else { continue };
            let row = run.row.saturating_sub(area.first_row);
            component.add_moments(run, row, area, image, joins);
            component.add_contour(run, row, area, image, low);
            if run.panel == component.bounds.panel {
                widen(&mut component.bounds, run, row);
            } else {
                self.widen_beyond(index, run, row);
            }
        }
        for (contact, moments) in joins.carried_moments() {
            if let Some(component) = self.list.get_mut(usize::from(contact)) {
                component.moments.add(&moments);
            }
        }
        for component in &mut self.list {
            // The mass is the total, which fits in 32 bits; rounded once, to the nearest 2^-16 taxel.
            let mass = Inverse::of(component.total);
            component.x = Fixed16(mass.nearest(component.moments.sx.saturating_mul(1 << 16)));
            component.y = Fixed16(mass.nearest(component.moments.sy.saturating_mul(1 << 16)));
        }
    }

    fn widen_beyond(&mut self, index: u16, run: &Run, row: u16) {
        match self.beyond.iter_mut().find(|(i, rect)| *i == index && rect.panel == run.panel) {
            Some((_, rect)) => widen(rect, run, row),
            None => {
                let mut rect = Rect { panel: run.panel, ..NOWHERE };
                widen(&mut rect, run, row);
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

fn widen(rect: &mut Rect, run: &Run, row: u16) {
    rect.top = rect.top.min(row);
    rect.bottom = rect.bottom.max(row);
    rect.left = rect.left.min(run.left);
    rect.right = rect.right.max(run.right);
}

/// Columns `left ..= right` of a row.
fn piece<'a>(run: &Run, row: &'a [u16]) -> &'a [u16] {
    row.get(usize::from(run.left)..=usize::from(run.right)).unwrap_or(&[])
}

impl Component {
    fn add_moments(&mut self, run: &Run, row: u16, area: &Area, image: &Image, joins: &mut Joins) {
        let values = piece(run, image.row(area, row));
        let here = Moments::of_run(run.left.into(), row.into(), values);
        // Of parts that are carried the sums are, once all their runs are in.
        if !self.joined || !joins.collect(run.parent, &here) {
            self.moments.add(&here);
        }
        if self.peak_at.is_none()
            && let Some((column, _)) = (run.left..).zip(values).find(|(_, value)| **value == self.peak)
        {
            self.peak_at = Some(Place { panel: run.panel, row, column });
        }
    }

    /// Taxels with at least one of four neighbours in the panel, or beyond its border, below the threshold.
    fn add_contour(&mut self, run: &Run, row: u16, area: &Area, image: &Image, low: u16) {
        let above = row.checked_sub(1).map_or(&[][..], |row| piece(run, image.row(area, row)));
        let below = piece(run, image.row(area, row.saturating_add(1)));
        let neighbourhood = Neighbourhood::of(image.values, area, row);
        let mut count = |column: u16| {
            self.perimeter = self.perimeter.saturating_add(1);
            let slope = neighbourhood.gradient(column).magnitude() >> 3;
            self.slope = self.slope.saturating_add(slope);
        };
        if above.is_empty() || below.is_empty() {
            return (run.left..=run.right).for_each(count);
        }
        count(run.left);
        // Between the ends only what is above and below matters.
        let inner = 1..usize::from(run.right - run.left).max(1);
        let vertical = above.get(inner.clone()).unwrap_or(&[]).iter().zip(below.get(inner).unwrap_or(&[]));
        for (index, (above, below)) in vertical.enumerate() {
            if *above < low || *below < low {
                count(run.left + 1 + index as u16);
            }
        }
        if run.right > run.left {
            count(run.right);
        }
    }
}
