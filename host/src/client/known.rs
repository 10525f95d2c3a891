//! What is known of a board by what it told.

use super::{Client, Counts, Worn};
use std::collections::BTreeMap;
use taxel_core::body::Placed;
use taxel_core::boot::Boot;
use taxel_core::format::{Celsius, Name, Q15};
use taxel_core::health::TaxelHealth;
use taxel_core::intent::Leading;
use taxel_core::shape::{BUILT_IN, Base, Class};
use taxel_core::symbol::RegionState;
use taxel_core::wire::{Budget, ConfidenceReport, GestureReport, Health, IntentReport, SelfTestReport};

impl Client {
    /// What was counted on the line.
    pub fn counts(&self) -> &Counts {
        &self.counts
    }

    /// The bytes of the last message as they came, its 0x00 included, when [`Client::push`] has just told of
    /// it.
    pub fn line(&self) -> &[u8] {
        &self.line
    }

    /// Garment, scene and firmware; none before the first `Hello`.
    pub fn worn(&self) -> Option<&Worn> {
        self.worn.as_ref()
    }

    /// The garment's geometry; none before the first `Hello`.
    pub fn layout(&self) -> Option<&taxel_core::garment::Layout> {
        self.worn.as_ref().map(|worn| &worn.layout)
    }

    /// The last conditioned image by taxel number, with its frame's number; none before the first that stands
    /// alone.
    pub fn image(&self) -> Option<(u32, &[u16])> {
        self.picture.image()
    }

    /// The last raw codes by taxel number; empty where none were sent.
    pub fn raw(&self) -> &[u16] {
        &self.raw
    }

    /// Contacts that are there, as told last.
    pub fn contacts(&self) -> &[Placed] {
        &self.contacts
    }

    /// How hard a contact seems that is there or has just gone, counts per cm2; none where its growth does
    /// not tell.
    pub fn hardness(&self, contact: u32) -> Option<u32> {
        self.growths.hardness(contact, self.layout()?)
    }

    /// Whether a contact may be nothing but drift of its baseline: no intention follows from it.
    pub fn is_unsure(&self, contact: u32) -> bool {
        self.unsure.contains(&contact)
    }

    /// How many frames old the form of a contact is that was told last, 255 for at least so many; none where
    /// the board was not asked for it.
    pub fn form_age(&self, contact: u32) -> Option<u8> {
        let told = self.forms.as_ref().filter(|report| report.frame == self.contacts_of);
        let age = told.and_then(|report| report.ages.iter().find(|(id, _)| *id == contact));
        self.ages_asked.then(|| age.map_or(0, |(_, age)| *age))
    }

    /// Ids of the contacts that have gone with the last frame; of very many, the last 1,024.
    pub fn released(&self) -> &[u32] {
        &self.released
    }

    /// Regions that are touched, as told last.
    pub fn regions(&self) -> &[RegionState] {
        &self.regions
    }

    /// Names of the concepts of the scene's map.
    pub fn concepts(&self) -> &[Name] {
        self.worn.as_ref().map_or(&[], Worn::concepts)
    }

    /// The announced intention.
    pub fn leading(&self) -> Leading {
        self.intention.as_ref().map_or(Leading::None, |report| report.leading)
    }

    /// Activation of each of the concepts; 0 before the first inference.
    pub fn activations(&self) -> Vec<Q15> {
        let mut all = self.intention.as_ref().map_or_else(Vec::new, |report| report.concepts.to_vec());
        all.resize(self.concepts().len(), Q15(0));
        all
    }

    /// Activation of each of the concepts at the last moment at which the announced intention led: what is
    /// drawn under its name. A board announces an intention a moment longer than the touch activates it.
    pub fn activations_of_leading(&self) -> Vec<Q15> {
        let mut all = self.led.as_ref().map_or_else(Vec::new, |report| report.concepts.to_vec());
        all.resize(self.concepts().len(), Q15(0));
        all
    }

    /// How sure a gesture is that has just been told; none: the board does not know.
    pub fn confidence(&self, gesture: &GestureReport) -> Option<Q15> {
        let of_it = |told: &&ConfidenceReport| (told.frame, told.touch) == (gesture.frame, gesture.touch);
        self.confidence.as_ref().filter(of_it).map(|told| told.confidence)
    }

    /// The taxels that are ill, by number, as told last.
    pub fn ill(&self) -> &BTreeMap<u16, TaxelHealth> {
        &self.ill
    }

    /// The last self-test of lines and inputs; none before the board has told of one.
    pub fn self_test(&self) -> Option<&SelfTestReport> {
        self.self_test.as_ref()
    }

    /// How the board came to start; none: it has not said.
    pub fn boot(&self) -> Option<Boot> {
        self.boot
    }

    /// What the board calls a class of its base of shapes.
    pub fn shape_name(&self, class: Class) -> String {
        if self.shapes.is_empty() {
            return Base::<BUILT_IN>::built_in().name(class).into();
        }
        let index = usize::from(class.0).checked_sub(1);
        index.and_then(|index| self.shapes.get(index)).map_or("unknown", String::as_str).into()
    }

    /// The board's counters, as told last.
    pub fn health(&self) -> Option<&Health> {
        self.health.as_ref()
    }

    /// Where the board's time goes, as told last.
    pub fn budget(&self) -> Option<&Budget> {
        self.budget.as_ref()
    }

    /// The temperature of the board's converter, as told last; none: it has no thermometer, or has not told
    /// yet.
    pub fn celsius(&self) -> Option<Celsius> {
        self.celsius
    }
}

/// Whether the announced intention is the most active of a map with these concepts, or none is announced.
pub(crate) fn leads(concepts: &[Name], report: &IntentReport) -> bool {
    let of = |leading: Leading| {
        let at = concepts.iter().position(|name| name.as_str() == leading.as_str())?;
        report.concepts.get(at).copied()
    };
    let own = of(report.leading);
    let most = Leading::INTENTIONS.into_iter().filter_map(of).max();
    report.leading == Leading::None || own.is_none() || (own == most && own > Some(Q15(0)))
}
