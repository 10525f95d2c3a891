//! The choice of contacts among the components, and their moments.

use super::carried::CarriedLabels;
use super::moments::{FEW, Moments, is_small};
use crate::baseline::feedback::{CARRIED, Feedback, Pressed};
use crate::format::{Fixed16, Inverse, WIDE};
use crate::garment::{Area, Layout, PANELS, Place, Rect};
use crate::image::view::Image;
use crate::segment::config::ContactConfig;
use crate::segment::labeller::Labeller;
use crate::segment::run::Run;
use crate::segment::seams::{Joins, weigh};
use crate::segment::strip::{Strip, strips, values_of};
use crate::segment::sums::{NARROW, squares};
use crate::segment::union_find::{Label, NONE};
use core::slice::from_ref;
use heapless::Vec;

/// A connected touch of one frame, not yet tracked.
#[derive(Debug, Clone)]
pub struct Component {
    /// Root of its labels.
    pub(crate) label: u16,
    /// True if it holds labels that a seam joins.
    pub(super) joined: bool,
    /// True if it may begin a contact; else it only continues one.
    pub(crate) begins: bool,
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
    pub(crate) inverse: Inverse,
    /// Centroid in the frame of the home panel, column; rounded once: half a step off at most.
    pub x: Fixed16,
    /// Centroid, row; rounded like `x`.
    pub y: Fixed16,
}

const NOWHERE: Rect = Rect { panel: 0, top: u16::MAX, bottom: 0, left: u16::MAX, right: 0 };

/// Sums of a component before its moments are measured.
struct Candidate {
    label: u16,
    joined: bool,
    begins: bool,
    total: u32,
    peak: u16,
    area: u16,
    panel: u8,
}

/// The components of a frame.
#[derive(Debug, Clone)]
pub(crate) struct Components<const CONTACTS: usize> {
    pub list: Vec<Component, CONTACTS>,
    /// Index of a component, and bounding box of its taxels on a panel other than its home.
    pub beyond: Vec<(u16, Rect), CARRIED>,
    /// Number of contacts of this frame that did not fit.
    pub dropped: u16,
    /// Panels with a component that is nearly a contact, one bit each.
    pub faint: u8,
    /// True while the baseline of a panel drifts fast.
    pub drifting: bool,
    /// Least peak that is clear of the noise of each panel, counts.
    pub clear: [u16; PANELS],
}

impl<const CONTACTS: usize> Components<CONTACTS> {
    pub const fn new() -> Self {
        const { assert!(CONTACTS < NONE as usize, "a contact is numbered with 16 bits") };
        Components {
            list: Vec::new(),
            beyond: Vec::new(),
            dropped: 0,
            faint: 0,
            drifting: false,
            clear: [0; PANELS],
        }
    }

    /// Picks the components that are contacts; if they do not fit, those with the greatest totals.
    #[inline(never)] // own frame: locals stay within short SP offsets
    pub fn select<const RUNS: usize, const LABELS: usize>(
        &mut self,
        config: &ContactConfig,
        labeller: &Labeller<RUNS, LABELS>,
        layout: &Layout,
    ) {
        self.list.clear();
        self.beyond.clear();
        (self.dropped, self.faint) = (0, 0);
        let mut least = None;
        // The last label's panel, and its least peak.
        let mut of = (u8::MAX, 0);
        for (index, label) in labeller.roots().filter(|(index, label)| label.group == *index) {
            let (total, peak, area, held) = if label.joined {
                weigh(labeller, index)
            } else {
                (label.mass, label.peak as u16, label.area, label.held)
            };
            let panel = label.panel;
            let mut found =
                Candidate { label: index, joined: label.joined, begins: true, total, peak, area, panel };
            if panel != of.0 {
                let Some(area) = layout.areas().get(usize::from(panel)) else { continue };
                let clear = self.clear.get(usize::from(panel)).copied().unwrap_or(0);
                of = (panel, config.least_peak(area, self.drifting, clear));
            }
            let least_peak = of.1;
            found.begins = u32::from(peak) >= least_peak;
            let goes_on = found.begins || held && config.goes_on(peak.into(), least_peak);
            if area < config.min_area || !goes_on {
                self.miss(&found, least_peak);
                continue;
            }
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

    /// Marks its panel if what is no contact is nearly one.
    fn miss(&mut self, found: &Candidate, least_peak: u32) {
        if u32::from(found.peak) >= least_peak - least_peak / 4 {
            self.faint |= 1u8.checked_shl(found.panel.into()).unwrap_or(0);
        }
    }

    /// Replaces the component with the smallest total if `found` has more. `least` caches that component.
    fn replace_least(&mut self, least: &mut Option<(usize, u32)>, found: &Candidate) {
        let Some((index, smallest)) = least.or_else(|| self.smallest()) else { return };
        *least = Some((index, smallest));
        if smallest < found.total
            && let Some(kept) = self.list.get_mut(index)
        {
            kept.begin(found);
            *least = None;
        }
    }

    /// The component with the smallest total, the last of equal ones, and that total.
    #[inline(never)] // seldom
    fn smallest(&self) -> Option<(usize, u32)> {
        let mut least = None;
        for (index, kept) in self.list.iter().enumerate() {
            if least.is_none_or(|(_, total)| kept.total <= total) {
                least = Some((index, kept.total));
            }
        }
        least
    }

    /// Merges component `lost` into `whole`.
    pub(crate) fn join(&mut self, whole: usize, lost: usize) {
        let part = self.list.get(lost).cloned();
        if let (Some(whole), Some(part)) = (self.list.get_mut(whole), part) {
            whole.absorb(&part);
        }
        let mut index = 0;
        self.list.retain(|_| {
            index += 1;
            index - 1 != lost
        });
    }

    /// Gives each label the index of its contact.
    pub fn number<const RUNS: usize, const LABELS: usize>(&self, labeller: &mut Labeller<RUNS, LABELS>) {
        for (index, component) in (0u16..).zip(&self.list) {
            if let Some(label) = labeller.labels.get_mut(usize::from(component.label)) {
                label.contact = index;
            }
        }
        // The root of a label has a smaller index, so it has its number already.
        for index in 0..labeller.labels.len() {
            let Some(label) = labeller.labels.get(index) else { return };
            let first = if usize::from(label.parent) == index { label.group } else { label.parent };
            if usize::from(first) == index {
                continue;
            }
            let contact = labeller.labels.get(usize::from(first)).map_or(NONE, |label| label.contact);
            if let Some(label) = labeller.labels.get_mut(index) {
                label.contact = contact;
            }
        }
    }

    /// Measures the moments, bounds and centroids of all components.
    pub fn measure<const RUNS: usize, const LABELS: usize>(
        &mut self,
        labeller: &Labeller<RUNS, LABELS>,
        joins: &Joins,
        layout: &Layout,
        image: &Image,
    ) {
        // On the stack, because nothing of it outlasts the call.
        let mut carried = CarriedLabels::new();
        self.measure_with(&mut carried, (labeller, joins), layout, image);
    }

    #[inline(never)] // own frame: locals stay within short SP offsets
    fn measure_with<const RUNS: usize, const LABELS: usize>(
        &mut self,
        carried: &mut CarriedLabels,
        (labeller, joins): (&Labeller<RUNS, LABELS>, &Joins),
        layout: &Layout,
        image: &Image,
    ) {
        for (index, component) in (0u16..).zip(&mut self.list).filter(|(_, c)| c.joined) {
            component.bounds.panel = carried.settle(labeller, joins, layout, index);
        }
        if WIDE {
            self.take_runs(labeller, carried, layout, image);
        } else {
            self.take_strips(labeller, carried, layout, image);
        }
        for (contact, moments) in carried.moments() {
            if let Some(component) = self.list.get_mut(usize::from(contact)) {
                component.moments.add(&moments);
            }
        }
        for component in &mut self.list {
            component.locate();
        }
    }

    /// Adds the runs to their components, strip by strip, so that the sums of a strip stay in registers.
    #[inline(never)] // M0+: out of line
    fn take_strips<const RUNS: usize, const LABELS: usize>(
        &mut self,
        labeller: &Labeller<RUNS, LABELS>,
        carried: &mut CarriedLabels,
        layout: &Layout,
        image: &Image,
    ) {
        for runs in strips(&labeller.runs) {
            let Some(label) = runs.first().and_then(|run| labeller.labels.get(usize::from(run.label))) else {
                continue;
            };
            let Some(component) = self.list.get_mut(usize::from(label.contact)) else { continue };
            let Some(area) = layout.areas().get(usize::from(label.panel)) else { continue };
            let strip = Strip { runs, label, area, values: image.values };
            if component.take(&strip, carried) {
                self.widen_beyond(&strip);
            }
        }
    }

    /// Adds the runs to their components one by one. For a machine with many registers: most strips of wide
    /// rows are of one run.
    fn take_runs<const RUNS: usize, const LABELS: usize>(
        &mut self,
        labeller: &Labeller<RUNS, LABELS>,
        carried: &mut CarriedLabels,
        layout: &Layout,
        image: &Image,
    ) {
        let areas = layout.areas();
        for run in &labeller.runs {
            let Some(label) = labeller.labels.get(usize::from(run.label)) else { continue };
            let Some(component) = self.list.get_mut(usize::from(label.contact)) else { continue };
            let Some(area) = areas.get(usize::from(label.panel)) else { continue };
            if component.joined {
                let strip = Strip { runs: from_ref(run), label, area, values: image.values };
                if component.take(&strip, carried) {
                    self.widen_beyond(&strip);
                }
            } else {
                component.add_run(run, area, image.values);
            }
        }
    }

    #[inline(never)] // only across seams
    fn widen_beyond(&mut self, strip: &Strip) {
        let Label { contact, panel, .. } = *strip.label;
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
            let _ = feedback.home.push(Pressed { rect: component.bounds, peak: component.peak, slow: false });
        }
        for (contact, rect) in &self.beyond {
            let peak = self.list.get(usize::from(*contact)).map_or(0, |component| component.peak);
            let _ = feedback.beyond.push(Pressed { rect: *rect, peak, slow: false });
        }
    }
}

impl Component {
    /// A component without taxels.
    const BLANK: Component = Component {
        label: NONE,
        joined: false,
        begins: false,
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
    #[inline(never)] // has two callers
    fn begin(&mut self, found: &Candidate) {
        let Candidate { label, joined, begins, total, peak, area, panel } = *found;
        (self.label, self.joined, self.begins) = (label, joined, begins);
        (self.total, self.peak, self.area) = (total, peak, area);
        self.bounds.panel = panel;
    }

    /// Runs in the rows of its box, with their indices; all runs if it lies on several panels.
    #[inline]
    pub(crate) fn runs<'l, const RUNS: usize, const LABELS: usize>(
        &self,
        labeller: &'l Labeller<RUNS, LABELS>,
        layout: &Layout,
    ) -> impl Iterator<Item = (usize, &'l Run)> {
        let area = layout.areas().get(usize::from(self.bounds.panel)).filter(|_| !self.joined);
        let rows = area.map_or((0, u16::MAX), |area| {
            (area.first_row + self.bounds.top, area.first_row + self.bounds.bottom)
        });
        labeller.in_rows(rows.0, rows.1)
    }

    /// Adds another component of the same home panel.
    pub(crate) fn absorb(&mut self, other: &Component) {
        let place = |component: &Component| component.peak_at.map(|at| (at.panel, at.row, at.column));
        if (other.peak, place(self)) > (self.peak, place(other)) {
            (self.peak, self.peak_at) = (other.peak, other.peak_at);
        }
        self.joined |= other.joined;
        self.begins |= other.begins;
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
    fn take(&mut self, strip: &Strip, carried: &mut CarriedLabels) -> bool {
        self.add(strip, carried);
        let beyond = strip.label.panel != self.bounds.panel;
        if !beyond {
            strip.widen(&mut self.bounds);
        }
        beyond
    }

    /// Adds a run of a component that lies on one panel.
    #[inline(always)]
    fn add_run(&mut self, run: &Run, area: &Area, values: &[u16]) {
        let row = run.row - area.first_row;
        let squares = match run.peak {
            0..=NARROW => run.sums.squares.into(),
            _ => squares(values_of(run, area, values), run.rebased()),
        };
        self.moments.add(&Moments::of_sums(run.left.into(), row.into(), &run.sums, squares));
        let Rect { top, bottom, left, right, .. } = &mut self.bounds;
        (*top, *bottom) = (row.min(*top), row);
        (*left, *right) = (run.left.min(*left), run.right.max(*right));
        if run.peak == self.peak && self.peak_at.is_none_or(|at| at.row == row) {
            self.look_for_peak(run, self.bounds.panel, area, values);
        }
    }

    /// Adds the runs of a strip to the moments.
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))] // M0+: out of line
    fn add(&mut self, strip: &Strip, carried: &mut CarriedLabels) {
        // Moments of a carried label stay in its own coordinates until all its runs are added.
        let carried = if self.joined { carried.moments_of(strip.label.parent) } else { None };
        let moments = carried.unwrap_or(&mut self.moments);
        let &Strip { runs, area, .. } = strip;
        if runs.len() > 2 && is_small(area.columns, area.rows, self.peak) {
            // One run per row, so that a chunk has at most FEW rows.
            runs.chunks(FEW).for_each(|runs| moments.add_few(runs, area.first_row));
        } else {
            for run in runs {
                let row = run.row - area.first_row;
                let squares = || squares(values_of(run, area, strip.values), run.rebased());
                moments.add_run(run.left.into(), row.into(), &run.sums, run.peak, squares);
            }
        }
        let peak = self.peak;
        if let Some(run) = strip.runs.iter().find(|run| run.peak == peak) {
            self.look_for_peak(run, strip.label.panel, area, strip.values);
        }
    }

    /// Updates `peak_at` from a run that has the peak, to the first such taxel of the row. The runs of a
    /// row may come in any order.
    #[inline(never)] // rarely called
    fn look_for_peak(&mut self, run: &Run, panel: u8, area: &Area, values: &[u16]) {
        let row = run.row - area.first_row;
        let mut columns = (run.left..).zip(values_of(run, area, values));
        let mine = |column| run.holds(column);
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
    use crate::garment::{Garment, Seam, SeamEdge, Side};
    use crate::image::rows::Rows;
    use std::vec;
    use std::vec::Vec;

    /// Panels of one or several words a row, with and without a seam.
    #[test]
    fn strips_add_up_to_what_their_runs_do() {
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
                let [a, b] = [(0, Side::Bottom), (1, Side::Top)].map(|(panel, side)| SeamEdge {
                    panel,
                    side,
                    start: 0,
                });
                garment.seams.push(Seam { a, b, length: columns, reversed: false }).unwrap();
            }
            let layout = Layout::build(&garment, 3072, 4095).unwrap();
            let (share, peak) = (next(80), [4095, u16::MAX][round / 2 % 2]);
            let mut values = vec![0; layout.taxels()];
            values.fill_with(|| if next(100) < share { 1 + next(peak.into()) as u16 } else { 0 });
            let rows = Rows::of(&layout, &values);
            let image = Image { values: &values, rows: &rows };
            let (mut labeller, mut joins) = (Labeller::<2048, 2048>::new(), Joins::new());
            labeller.scan(&layout, &image, 1);
            joins.find(&mut labeller, &layout);
            let mut components = Components::<40>::new();
            components.select(&ContactConfig { low: 1, high: 1, ..Default::default() }, &labeller, &layout);
            components.number(&mut labeller);
            let mut found = [false, true].map(|strips| {
                let mut carried = CarriedLabels::new();
                let mut components = components.clone();
                for (index, component) in (0u16..).zip(&mut components.list).filter(|(_, c)| c.joined) {
                    component.bounds.panel = carried.settle(&labeller, &joins, &layout, index);
                }
                if strips {
                    components.take_strips(&labeller, &mut carried, &layout, &image);
                } else {
                    components.take_runs(&labeller, &mut carried, &layout, &image);
                }
                let each = components.list.iter().map(|c| (c.moments, c.bounds, c.peak_at));
                let carried: Vec<_> = carried.moments().collect();
                (each.collect::<Vec<_>>(), components.beyond, carried)
            });
            found[0].1.sort_unstable_by_key(|(index, _)| *index);
            found[1].1.sort_unstable_by_key(|(index, _)| *index);
            assert_eq!(found[0], found[1], "{columns} columns, {share} %");
        }
    }

    #[test]
    fn the_peak_of_two_is_the_greater_one_and_the_first_of_equal_ones() {
        let places = [(0, 0, 3), (0, 1, 0), (0, 1, 5), (2, 0, 0)];
        let all = places
            .into_iter()
            .flat_map(|(panel, row, column)| [7, 9].map(|peak| (peak, Some(Place { panel, row, column }))));
        let with = |(peak, peak_at)| Component { peak, peak_at, ..Component::BLANK };
        let order = |(peak, at): (u16, Option<Place>)| {
            (core::cmp::Reverse(peak), at.map(|at| (at.panel, at.row, at.column)))
        };
        for (one, other) in all.clone().flat_map(|one| all.clone().map(move |other| (one, other))) {
            let mut whole = with(one);
            whole.absorb(&with(other));
            let expected = if order(one) <= order(other) { one } else { other };
            assert_eq!((whole.peak, whole.peak_at), expected, "{one:?} {other:?}");
        }
    }

    #[test]
    fn a_contact_begins_and_ends_at_the_same_pressure_on_every_pitch() {
        let config = ContactConfig { low: 16, high: 40, ..Default::default() };
        for (mm, least, last) in [
            ([0, 0], 40, 24),
            ([12, 10], 40, 24),
            ([10, 10], 34, 21),
            ([9, 9], 29, 19),
            ([6, 6], 24, 16),
            ([14, 14], 60, 34),
            ([30, 30], 72, 40),
        ] {
            let mut garment = Garment::recorded(12, 16);
            garment.panels[0].pitch_um = mm.map(|mm| 1_000 * mm);
            let layout = Layout::build(&garment, 3072, 4095).unwrap();
            let mut felt = Feedback::<4>::new();
            let rect = Rect { panel: 0, top: 1, bottom: 1, left: 4, right: 5 };
            felt.home.push(Pressed { rect, peak: 100, slow: false }).unwrap();
            for (peak, area, drifting, goes_on) in (16..100)
                .flat_map(|peak| [1, 2].map(|area| (peak, area)))
                .flat_map(|(peak, area)| [false, true].map(|drifting| (peak, area, drifting)))
                .flat_map(|(peak, area, drifting)| [false, true].map(|on| (peak, area, drifting, on)))
            {
                let mut values = vec![0; layout.taxels()];
                values[20..][..area].fill(peak);
                let rows = Rows::of(&layout, &values);
                let mut labeller = Labeller::<64, 64>::new();
                labeller.scan(&layout, &Image { values: &values, rows: &rows }, config.low);
                if goes_on {
                    labeller.mark_held(&layout, &felt, config.high);
                }
                let mut components = Components::<4>::new();
                components.drifting = drifting;
                components.select(&config, &labeller, &layout);
                let (least, last) = if drifting { (least.max(40), last.max(24)) } else { (least, last) };
                let is_one = peak >= if goes_on { last } else { least };
                assert_eq!(components.list.len(), usize::from(is_one), "{area} of {peak} at {mm:?} mm");
            }
        }
    }

    #[test]
    fn a_panel_is_faint_from_three_quarters_of_a_contact_on() {
        let mut garment = Garment::recorded(12, 16);
        garment.panels.push(garment.panels[0].clone()).unwrap();
        garment.panels[1].name = crate::format::Name::try_from("second").unwrap();
        let layout = Layout::build(&garment, 3072, 4095).unwrap();
        let config = ContactConfig { low: 100, high: 400, min_area: 2, ..Default::default() };
        for (panel, area, peak) in [0, 1].into_iter().flat_map(|panel| {
            [1, 2].into_iter().flat_map(move |area| (100..500).map(move |peak| (panel, area, peak)))
        }) {
            let mut values = vec![0; layout.taxels()];
            values[usize::from(layout.areas()[panel].base) + 20..][..area].fill(peak);
            let rows = Rows::of(&layout, &values);
            let mut labeller = Labeller::<64, 64>::new();
            labeller.scan(&layout, &Image { values: &values, rows: &rows }, config.low);
            let mut components = Components::<4>::new();
            components.select(&config, &labeller, &layout);
            let is_contact = area == 2 && peak >= 400;
            let faint = if !is_contact && peak >= 300 { 1 << panel } else { 0 };
            let found = (components.list.len(), components.faint);
            assert_eq!(found, (usize::from(is_contact), faint), "{area} of {peak}");
        }
    }
}
