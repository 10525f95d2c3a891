//! The stage: segmentation and tracking of a frame.

use crate::baseline::feedback::Feedback;
use crate::format::{Invalid, Micros};
use crate::garment::{Area, Layout, PANELS, Rect};
use crate::image::view::Image;
use crate::measure::component::{Component, Components};
use crate::measure::contact::Contact;
use crate::measure::forms::Forms;
use crate::measure::frame_view::FrameView;
use crate::measure::moments::Moments;
use crate::measure::quartic::Quartic;
use crate::segment::config::ContactConfig;
use crate::segment::labeller::Labeller;
use crate::segment::run::Run;
use crate::segment::seams::Joins;
use crate::track::assign::Matching;
use crate::track::motion::Trail;
use crate::track::reunite::reunite;
use crate::track::slot::Slot;
use crate::track::tracks::Tracks;

/// Finds and follows contacts; see the [module](super).
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct Contacts {
    config: ContactConfig,
}

/// State and work space of the stage, for at most CONTACTS contacts, RUNS runs and LABELS labels
/// (connected taxels of one panel; at most 65534). If the columns are even in number, half as many runs as
/// taxels suffice. Labels never exceed the runs, nor the squares of two by two taxels.
#[derive(Debug, Clone)]
pub struct ContactState<const CONTACTS: usize, const RUNS: usize, const LABELS: usize = RUNS, S = Contact> {
    labeller: Labeller<RUNS, LABELS>,
    joins: Joins,
    components: Components<CONTACTS>,
    matching: Matching<CONTACTS>,
    tracks: Tracks<CONTACTS, S>,
    feedback: Feedback<CONTACTS>,
}

/// Touched taxels of some rows of a panel that belong to one contact.
pub(crate) struct PressedRuns<'a> {
    /// Index of the contact, in the order of their onset.
    pub contact: usize,
    /// Index of the panel.
    pub panel: u8,
    /// The panel.
    pub area: &'a Area,
    /// The runs, in the order of rows.
    pub runs: &'a [Run],
}

impl<'a> PressedRuns<'a> {
    /// The runs, each with the number of its first taxel.
    #[inline(always)] // M0+: one loop
    pub fn each(&self) -> impl Iterator<Item = (usize, &'a Run)> + use<'a> {
        let Area { base, first_row, columns, .. } = *self.area;
        self.runs.iter().map(move |run| {
            let row = usize::from(run.row.wrapping_sub(first_row)) * usize::from(columns);
            (usize::from(base) + row + usize::from(run.left), run)
        })
    }
}

/// Number of runs up to one of another label than the first.
#[inline(never)] // M0+: once, for size
fn of_one_label(runs: &[Run]) -> usize {
    let of_first = |run: &&Run| runs.first().is_some_and(|first| run.label == first.label);
    runs.iter().take_while(of_first).count()
}

/// Result of a frame.
#[derive(Debug, Clone, Copy)]
pub struct Touches<'a, S = Contact> {
    /// Contacts that are present, in the order of their onset.
    pub present: &'a [S],
    /// Age of their forms in the same order, frames; saturates at 255. See [`Contact`].
    pub ages: &'a [u8],
    /// Ratios of the fourth order of those whose form is of this frame, in the same order; 0 for the others.
    pub quartics: &'a [Quartic],
    /// Contacts that ended with this frame.
    pub released: &'a [S],
    /// Number of contacts that did not fit into this frame: those with the smallest totals.
    pub dropped: u16,
    /// Panels with a component that is nearly a contact, one bit each: its peak is at least three quarters of
    /// the least peak of a contact there.
    pub faint: u8,
    /// Number of runs and of joins across seams that did not fit: parts of contacts may be missing or
    /// separate.
    pub overflow: u16,
    trails: &'a [Trail],
    components: &'a [Component],
}

impl<const CONTACTS: usize, const RUNS: usize, const LABELS: usize> ContactState<CONTACTS, RUNS, LABELS> {
    /// No contacts; the next id is 1.
    pub const fn new() -> Self {
        ContactState::with_slots()
    }
}

impl<'a, S> Touches<'a, S> {
    /// Moments of the contacts that are present, in the frame of the home panel, in the same order.
    pub fn moments(&self) -> impl Iterator<Item = &'a Moments> + use<'a, S> {
        let components = self.components;
        let of = |trail: &Trail| components.get(usize::from(trail.component));
        self.trails.iter().filter_map(of).map(|component| &component.moments)
    }
}

impl<const CONTACTS: usize, const RUNS: usize, const LABELS: usize, S: Slot>
    ContactState<CONTACTS, RUNS, LABELS, S>
{
    /// No contacts; the next id is 1. The table has entries of any kind.
    pub const fn with_slots() -> Self {
        ContactState {
            labeller: Labeller::new(),
            joins: Joins::new(),
            components: Components::new(),
            matching: Matching::new(),
            tracks: Tracks::new(),
            feedback: Feedback::new(),
        }
    }

    /// Releases all contacts, for example for another garment; ids go on.
    pub fn reset(&mut self) {
        self.labeller.clear();
        self.tracks.clear();
        self.feedback = Feedback::new();
    }

    /// Sets whether the baseline of a panel drifts fast: then no contact begins below the high threshold,
    /// however small the taxels are; and the least peak that is clear of the noise of each panel, counts.
    pub fn set_drifting(&mut self, drifting: bool, clear: [u16; PANELS]) {
        (self.components.drifting, self.components.clear) = (drifting, clear);
    }

    /// Sets where each of the present contacts, by index, holds the baseline, and whether it may be drift.
    pub(crate) fn hold(&mut self, hold: impl Fn(usize) -> Option<(Rect, bool)> + Clone) {
        let contacts = self.tracks.contacts().iter().map(S::contact).enumerate();
        self.feedback.hold(
            contacts
                .filter_map(|(index, contact)| hold(index).map(|hold| (contact.bounds, contact.peak, hold))),
        );
    }

    /// The contacts' rectangles and peaks, for the conditioning of the next frame.
    pub fn feedback(&self) -> &Feedback<CONTACTS> {
        &self.feedback
    }

    /// Contacts of the last frame, in the order of their onset.
    pub fn present(&self) -> &[S] {
        self.tracks.contacts()
    }

    /// Contacts that ended with the last frame.
    pub fn released(&self) -> &[S] {
        self.tracks.released()
    }

    /// The entries of the present contacts, for what later stages keep there.
    pub(crate) fn slots(&mut self) -> &mut [S] {
        &mut self.tracks.contacts
    }

    /// The entries of the present contacts, each with moments and ratios of the fourth order if its form is
    /// of the last frame.
    pub(crate) fn looked(&mut self) -> impl Iterator<Item = (&mut S, Option<(&Moments, &Quartic)>)> {
        let components = &self.components.list;
        let Tracks { contacts, trails, quartics, .. } = &mut self.tracks;
        contacts.iter_mut().zip(trails.iter().zip(&*quartics)).map(|(slot, (trail, quartic))| {
            let looked = components.get(usize::from(trail.component)).filter(|_| trail.age == 0);
            (slot, looked.map(|component| (&component.moments, quartic)))
        })
    }

    /// Hands over the runs of the last frame's contacts, in the order of rows; those that follow each other
    /// under one label together.
    #[inline(always)] // M0+: what a panel has in common stays in registers
    pub(crate) fn each_pressed(&self, layout: &Layout, mut take: impl FnMut(PressedRuns<'_>)) {
        let contacts = self.tracks.contacts_of_components();
        let mut runs = &self.labeller.runs[..];
        for (panel, area) in (0..).zip(layout.areas()) {
            let end = area.first_row.saturating_add(area.rows);
            let count = runs.partition_point(|run| run.row < end);
            let mut own = runs.split_off(..count).unwrap_or_default();
            while let [first, ..] = own {
                let runs = own.split_off(..of_one_label(own)).unwrap_or_default();
                let Some(label) = self.labeller.labels.get(usize::from(first.label)) else { continue };
                // NONE, if it is of no component.
                let contact = contacts.get(usize::from(label.contact)).copied().flatten();
                if let Some(contact) = contact.map(usize::from) {
                    take(PressedRuns { contact, panel, area, runs });
                }
            }
        }
    }

    /// Age of the forms of the last frame's contacts, frames, in the order of their onset.
    pub fn form_ages(&self) -> &[u8] {
        self.tracks.ages()
    }

    /// Index in [`Touches::present`] of the last frame's contact at a taxel.
    pub fn contact_at(&self, layout: &Layout, place: crate::garment::Place) -> Option<usize> {
        let area = layout.areas().get(usize::from(place.panel))?;
        self.tracks.index_of(self.labeller.contact_at(area, place.row, place.column)?)
    }
}

impl<const CONTACTS: usize, const RUNS: usize, const LABELS: usize, S: Slot> Default
    for ContactState<CONTACTS, RUNS, LABELS, S>
{
    fn default() -> Self {
        ContactState::with_slots()
    }
}

impl ContactConfig {
    /// Checks the settings. Error if one is out of range.
    pub fn build(&self) -> Result<Contacts, Invalid> {
        let refuse = |parameter, must| Err(Invalid { parameter, must });
        if self.low == 0 {
            return refuse("contact.low", "must be at least 1 count");
        }
        if self.high < self.low {
            return refuse("contact.high", "must not be below contact.low");
        }
        if self.gate == 0 || self.gate > 1000 {
            return refuse("contact.gate", "must be 1 to 1000 cm");
        }
        if self.slip_speed == 0 {
            return refuse("contact.slip_speed", "must be at least 1 (1/16 cm/s)");
        }
        Ok(Contacts { config: *self })
    }
}

impl Contacts {
    /// The settings.
    pub const fn config(&self) -> &ContactConfig {
        &self.config
    }

    /// Processes one frame that was scanned at `now`: [`Contacts::segment`], then [`Contacts::track`].
    pub fn process<'a, const CONTACTS: usize, const RUNS: usize, const LABELS: usize, S: Slot>(
        &self,
        state: &'a mut ContactState<CONTACTS, RUNS, LABELS, S>,
        layout: &Layout,
        image: &Image,
        now: Micros,
    ) -> Touches<'a, S> {
        self.segment(state, layout, image);
        self.track(state, layout, image, now)
    }

    /// Returns the components of a frame that are contacts, measured, in the order of their first taxels.
    /// This suffices if you need no ids and no velocities. Of earlier contacts it uses only the positions,
    /// which keep faint ones.
    pub fn segment<'a, const CONTACTS: usize, const RUNS: usize, const LABELS: usize, S: Slot>(
        &self,
        state: &'a mut ContactState<CONTACTS, RUNS, LABELS, S>,
        layout: &Layout,
        image: &Image,
    ) -> &'a [Component] {
        let ContactState { labeller, joins, components, feedback, .. } = state;
        labeller.scan(layout, image, self.config.low);
        labeller.mark_held(layout, feedback, self.config.high);
        joins.find(labeller, layout);
        components.select(&self.config, labeller, layout);
        components.number(labeller);
        components.measure(labeller, joins, layout, image);
        components.feed_back(feedback);
        &components.list
    }

    /// Follows contacts from the last frame to the components that [`Contacts::segment`] found in this image.
    pub fn track<'a, const CONTACTS: usize, const RUNS: usize, const LABELS: usize, S: Slot>(
        &self,
        state: &'a mut ContactState<CONTACTS, RUNS, LABELS, S>,
        layout: &Layout,
        image: &Image,
        now: Micros,
    ) -> Touches<'a, S> {
        let ContactState { labeller, joins, components, matching, tracks, .. } = state;
        matching.assign(&self.config, tracks, &components.list, layout, now);
        reunite(components, labeller, layout, tracks);
        tracks.merge(labeller, layout);
        let view = FrameView { labeller, layout, image };
        tracks.update(&self.config, &components.list, &view, (now, Forms::of(self.config.forms_in_frame)));
        Touches {
            present: tracks.contacts(),
            ages: tracks.ages(),
            quartics: tracks.quartics(),
            released: tracks.released(),
            dropped: components.dropped,
            faint: components.faint,
            overflow: labeller.overflow.saturating_add(joins.overflow),
            trails: &tracks.trails,
            components: &components.list,
        }
    }
}
