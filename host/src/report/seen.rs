//! What is kept of a stream for its report.

use crate::client::{Client, Counts, Event, ImageNews, Worn};
use crate::live::Show;
use crate::live::narrate::Narrator;
use anyhow::Result;
use std::collections::BTreeMap;
use taxel_core::body::Placed;
use taxel_core::garment::Area;
use taxel_core::health::TaxelHealth;
use taxel_core::wire::Health;

/// Most sentences of a report.
const SENTENCES: usize = 500;

/// What is kept.
#[derive(Debug)]
pub struct Seen {
    pub(super) label: String,
    pub(super) counts_per_newton: Option<f32>,
    pub(super) worn: Option<Worn>,
    pub(super) counts: Counts,
    /// The moment of the greatest force.
    pub(super) top: Moment,
    /// Greatest pressure of each taxel, counts.
    pub(super) hold: Vec<u16>,
    /// Total of each panel over time.
    pub(super) totals: Vec<(u64, Vec<u32>)>,
    /// Each contact at its greatest total, with its last duration.
    pub(super) contacts: BTreeMap<u32, Placed>,
    /// Names of the shapes that they had.
    pub(super) shapes: BTreeMap<u8, String>,
    /// Activation of each concept over time, -1 ..= 1.
    pub(super) activations: Vec<(u64, Vec<f64>)>,
    pub(super) concepts: Vec<String>,
    pub(super) sentences: Vec<String>,
    /// Sentences that found no place.
    pub(super) unsaid: usize,
    pub(super) health: Option<Health>,
    pub(super) ill: BTreeMap<u16, TaxelHealth>,
    narrator: Narrator,
}

/// An image and the contacts in it.
#[derive(Debug, Default, Clone)]
pub(super) struct Moment {
    pub time_us: u64,
    pub total: u64,
    pub image: Vec<u16>,
    pub contacts: Vec<Placed>,
}

impl Seen {
    /// Nothing yet, of a source with that name.
    pub fn new(label: String, counts_per_newton: Option<f32>) -> Seen {
        Seen {
            label,
            counts_per_newton,
            worn: None,
            counts: Counts::default(),
            top: Moment::default(),
            hold: Vec::new(),
            totals: Vec::new(),
            contacts: BTreeMap::new(),
            shapes: BTreeMap::new(),
            activations: Vec::new(),
            concepts: Vec::new(),
            sentences: Vec::new(),
            unsaid: 0,
            health: None,
            ill: BTreeMap::new(),
            narrator: Narrator::new(counts_per_newton),
        }
    }

    /// The garment's panels.
    pub(super) fn areas(&self) -> &[Area] {
        self.worn.as_ref().map_or(&[], |worn| worn.layout.areas())
    }

    fn image(&mut self, client: &Client, time_us: u64) {
        let Some((_, image)) = client.image() else { return };
        let sum = |values: &[u16]| values.iter().map(|value| u32::from(*value)).sum::<u32>();
        let totals: Vec<u32> = self.areas().iter().map(|area| sum(of(area, image))).collect();
        let total = totals.iter().map(|total| u64::from(*total)).sum();
        self.totals.push((time_us, totals));
        self.hold.resize(image.len(), 0);
        self.hold.iter_mut().zip(image).for_each(|(held, value)| *held = (*held).max(*value));
        if total > self.top.total || self.top.image.is_empty() {
            self.top = Moment { time_us, total, image: image.to_vec(), contacts: client.contacts().to_vec() };
        }
    }

    fn contact(&mut self, placed: &Placed) {
        let kept = self.contacts.entry(placed.contact.id).or_insert_with(|| placed.clone());
        let duration = placed.contact.duration_ms;
        if placed.contact.total > kept.contact.total {
            *kept = placed.clone();
        }
        kept.contact.duration_ms = duration;
    }
}

/// The values of a panel, row by row.
pub(super) fn of<'v>(area: &Area, values: &'v [u16]) -> &'v [u16] {
    let start = usize::from(area.base);
    values.get(start..start + usize::from(area.rows) * usize::from(area.columns)).unwrap_or(&[])
}

impl Show for Seen {
    fn event(&mut self, client: &Client, event: &Event) -> Result<()> {
        match event {
            Event::Hello => {
                self.worn = client.worn().cloned();
                self.concepts = client.concepts().iter().map(ToString::to_string).collect();
            }
            Event::Frame { time, image: ImageNews::Whole, .. } => self.image(client, time.0),
            Event::Contacts { released, .. } => {
                for placed in client.contacts().iter().chain(released) {
                    let class = placed.shape.class;
                    self.shapes.entry(class.0).or_insert_with(|| client.shape_name(class));
                    self.contact(placed);
                }
            }
            Event::Intent(report) => {
                let values = report.concepts.iter().map(|value| value.to_f64()).collect();
                self.activations.push((report.time.0, values));
            }
            Event::Health(health) => self.health = Some(*health),
            Event::HealthMap { .. } => self.ill.clone_from(client.ill()),
            _ => {}
        }
        for sentence in self.narrator.tell(client, event) {
            if self.sentences.len() < SENTENCES { self.sentences.push(sentence) } else { self.unsaid += 1 }
        }
        Ok(())
    }

    fn end(&mut self, client: &Client) -> Result<()> {
        self.counts.clone_from(client.counts());
        Ok(())
    }
}
