//! Data of a stream collected for its report.

use super::scale::PageUnit;
use super::series::Series;
use crate::fault::own;
use crate::folding::{Folding, FoldingLine};
use crate::on_robot::ShownRobot;
use crate::watch::narrate::Narrator;
use crate::watch::shape::shape;
use serde_json::Value;
use std::collections::BTreeMap;
use taxel::client::{BoardDescription, Client, Counts, Event, ImageNews, Stamp};
use taxel::recording::Skipped;
use taxel::session::Observer;
use taxel_core::body::Placed;
use taxel_core::format::Micros;
use taxel_core::garment::Area;
use taxel_core::health::TaxelHealth;
use taxel_core::wire::Health;

/// Most contacts listed: the strongest.
pub(super) const LISTED: usize = 60;
/// Most sentences of a report.
const SENTENCES: usize = 500;

/// Collected data.
#[derive(Debug)]
pub struct Seen {
    /// Name of the recording or the board.
    pub label: String,
    pub(super) counts_per_newton: Option<f64>,
    pub(super) description: Option<BoardDescription>,
    pub(super) counts: Counts,
    /// The moment of the greatest force.
    pub(super) top: Moment,
    /// Greatest pressure of each taxel, counts.
    pub(super) hold: Vec<u16>,
    /// Total of each panel over time, counts.
    pub(super) totals: Series,
    /// The strongest and the present contacts, each at its greatest total, with its last duration.
    pub(super) contacts: BTreeMap<u32, SeenContact>,
    /// Number of contacts.
    pub(super) touches: u64,
    /// Activation of each concept over time, -1 ..= 1.
    pub(super) activations: Series,
    pub(super) concepts: Vec<String>,
    pub(super) sentences: Vec<String>,
    /// Number of sentences left out.
    pub(super) unsaid: usize,
    pub(super) health: Option<Health>,
    pub(super) faulty: BTreeMap<u16, TaxelHealth>,
    /// The robot that carries the garment; none if it is not shown.
    pub(super) shown_robot: Option<ShownRobot>,
    /// Folds of the garment; none without a table.
    folding: Option<Folding>,
    /// Damage of a recording.
    pub skipped: Skipped,
    narrator: Narrator,
}

/// A contact at its greatest total.
#[derive(Debug)]
pub(super) struct SeenContact {
    pub placed: Placed,
    /// Shape in words.
    pub shape: String,
}

/// An image and its contacts.
#[derive(Debug, Default, Clone)]
pub(super) struct Moment {
    pub time_us: u64,
    pub total: u64,
    pub image: Vec<u16>,
    pub contacts: Vec<Placed>,
    /// Contacts and forces on the robot: the message `pressing`; null without one.
    pub pressing: Value,
    /// Folds of the garment; none if they are not known.
    pub folding: Option<FoldingLine>,
}

impl Seen {
    /// No data yet, of a source with this label.
    pub fn new(label: String) -> Seen {
        Seen {
            label,
            counts_per_newton: None,
            description: None,
            counts: Counts::default(),
            top: Moment::default(),
            hold: Vec::new(),
            totals: Series::default(),
            contacts: BTreeMap::new(),
            touches: 0,
            activations: Series::default(),
            concepts: Vec::new(),
            sentences: Vec::new(),
            unsaid: 0,
            health: None,
            faulty: BTreeMap::new(),
            shown_robot: None,
            folding: None,
            skipped: Skipped::default(),
            narrator: Narrator::default(),
        }
    }

    /// Shows the garment on this robot, too.
    pub fn on(self, shown_robot: Option<ShownRobot>) -> Seen {
        Seen { shown_robot, ..self }
    }

    /// Shows where the garment folds, too.
    pub fn folding(self, folding: Option<Folding>) -> Seen {
        Seen { folding, ..self }
    }

    /// Unit of the page.
    pub(super) fn scale(&self) -> PageUnit {
        PageUnit::of(self.counts_per_newton)
    }

    /// Panels of the garment.
    pub(super) fn areas(&self) -> &[Area] {
        self.description.as_ref().map_or(&[], |description| description.layout.areas())
    }

    fn image(&mut self, client: &Client, time_us: u64) {
        let Some((_, image)) = client.image() else { return };
        let sum = |values: &[u16]| values.iter().map(|value| u32::from(*value)).sum::<u32>();
        let totals: Vec<u32> = self.areas().iter().map(|area| sum(of(area, image))).collect();
        let total = totals.iter().map(|total| u64::from(*total)).sum();
        self.totals.push(time_us, totals.iter().map(|total| f64::from(*total)).collect());
        self.hold.resize(image.len(), 0);
        self.hold.iter_mut().zip(image).for_each(|(held, value)| *held = (*held).max(*value));
        if total > self.top.total || self.top.image.is_empty() {
            let pressing = self
                .shown_robot
                .as_ref()
                .and_then(|shown_robot| shown_robot.pressing(client, Micros(time_us)));
            self.top = Moment {
                time_us,
                total,
                image: image.to_vec(),
                contacts: client.contacts().to_vec(),
                // Numbers, texts, and keys that are texts: this cannot fail.
                pressing: serde_json::to_value(pressing).unwrap_or_default(),
                folding: self.folding.as_ref().and_then(|folding| folding.at(time_us)),
            };
        }
    }

    fn contact(&mut self, client: &Client, placed: &Placed) {
        let known = self.contacts.len();
        let seen = || SeenContact { placed: placed.clone(), shape: shape(client, placed) };
        let kept = self.contacts.entry(placed.contact.id).or_insert_with(seen);
        if placed.contact.total > kept.placed.contact.total {
            *kept = seen();
        }
        kept.placed.contact.duration_ms = placed.contact.duration_ms;
        self.touches += (self.contacts.len() - known) as u64;
    }

    /// Removes the weakest of many contacts, except for present ones.
    fn forget_weak(&mut self, present: &[Placed]) {
        if self.contacts.len() < 4 * LISTED {
            return;
        }
        let mut totals: Vec<u32> = self.contacts.values().map(|seen| seen.placed.contact.total).collect();
        totals.sort_unstable_by_key(|total| std::cmp::Reverse(*total));
        let least = totals[LISTED - 1];
        self.contacts.retain(|id, seen| {
            seen.placed.contact.total >= least || present.iter().any(|placed| placed.contact.id == *id)
        });
    }
}

/// Values of a panel, row by row.
pub(super) fn of<'v>(area: &Area, values: &'v [u16]) -> &'v [u16] {
    let start = usize::from(area.base);
    values.get(start..start + usize::from(area.rows) * usize::from(area.columns)).unwrap_or(&[])
}

impl Observer for Seen {
    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        match event {
            Event::Hello => {
                self.description = client.description().cloned();
                self.counts_per_newton = client.counts_per_newton();
                if let (Some(shown_robot), Some(description)) = (&mut self.shown_robot, client.description())
                    && !shown_robot.has(description)
                {
                    shown_robot.put_on(description).map_err(own)?;
                }
                if let (Some(folding), Some(description)) = (&mut self.folding, client.description()) {
                    folding.use_garment(description).map_err(own)?;
                }
                self.concepts = client.concepts().iter().map(ToString::to_string).collect();
            }
            Event::Frame { time, image: ImageNews::Whole, .. } => self.image(client, time.0),
            Event::Contacts { released, .. } => {
                for placed in client.contacts().iter().chain(released) {
                    self.contact(client, placed);
                }
                self.forget_weak(client.contacts());
            }
            Event::Intent(report) => {
                let values = report.concepts.iter().map(|value| value.to_f64()).collect();
                self.activations.push(report.time.0, values);
            }
            Event::Pressing(report) => {
                self.shown_robot.iter_mut().for_each(|shown_robot| shown_robot.take(report))
            }
            Event::Health(health) => self.health = Some(*health),
            Event::HealthMap { .. } => self.faulty.clone_from(client.faulty()),
            _ => {}
        }
        for sentence in self.narrator.narrate(client, event) {
            if self.sentences.len() < SENTENCES { self.sentences.push(sentence) } else { self.unsaid += 1 }
        }
        Ok(())
    }

    fn sent(&mut self, client: &Client, requests: &[u8], _: Stamp) -> taxel::Result<()> {
        self.folding.iter_mut().for_each(|folding| folding.asked(client, requests));
        Ok(())
    }

    fn ended(&mut self, client: &Client, _: Stamp) -> taxel::Result<()> {
        self.counts.clone_from(client.counts());
        Ok(())
    }
}
