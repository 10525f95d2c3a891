//! State of a board, as the client knows it.

use super::{BoardDescription, Client, Counts};
use crate::files::calibrate::{ForceScale, Newtons};
use std::collections::BTreeMap;
use taxel_core::body::Placed;
use taxel_core::boot::Boot;
use taxel_core::format::{Celsius, Name, Q15};
use taxel_core::health::TaxelHealth;
use taxel_core::intent::Leading;
use taxel_core::shape::{Base, Class};
use taxel_core::symbol::RegionState;
use taxel_core::wire::{Budget, GestureReport, Health, IntentReport, SelfTestReport};

impl Client {
    /// Counters of the connection.
    pub fn counts(&self) -> &Counts {
        &self.counts
    }

    /// True if the last event is the host's own: the board has sent nothing for it.
    pub fn is_own(&self) -> bool {
        self.is_own
    }

    /// Bytes of the last message including its 0x00; valid right after [`Client::push`] has returned its
    /// event. None of an event of the host's own.
    pub fn line(&self) -> &[u8] {
        if self.is_own { &[] } else { &self.line }
    }

    /// Bytes of the messages of the last event, each with its 0x00: those before the last one that have brought no
    /// event, because they belong to it, and [`Client::line`]; valid as that is.
    pub fn lines(&self) -> impl Iterator<Item = &[u8]> {
        let before = self.unheard.split_inclusive(|byte| *byte == 0).filter(|line| line.len() > 1);
        before.chain(std::iter::once(self.line())).filter(|_| !self.is_own)
    }

    /// Garment, scene and firmware; none before the first `Hello`.
    pub fn description(&self) -> Option<&BoardDescription> {
        self.description.as_ref()
    }

    /// The garment's geometry; none before the first `Hello`.
    pub fn layout(&self) -> Option<&taxel_core::garment::Layout> {
        self.description.as_ref().map(|description| &description.layout)
    }

    /// Last conditioned image by taxel number, with its frame number; none before the first key frame.
    pub fn image(&self) -> Option<(u32, &[u16])> {
        self.picture.image()
    }

    /// Last raw codes by taxel number; empty if none were sent.
    pub fn raw(&self) -> &[u16] {
        &self.raw
    }

    /// Present contacts, by the latest list.
    pub fn contacts(&self) -> &[Placed] {
        &self.contacts
    }

    /// Scale by which forces are computed.
    pub fn scale(&self) -> &ForceScale {
        &self.scale
    }

    /// Newtons of the board's pressure, by what the host knows of it; none before the first `Hello`.
    pub fn newtons(&self) -> Option<&Newtons> {
        self.newtons.as_ref()
    }

    /// Counts per newton for sums of pressure, as of [`Newtons::counts_per_newton`].
    pub fn counts_per_newton(&self) -> Option<f64> {
        self.newtons()?.counts_per_newton()
    }

    /// The word for what forces in newtons rest on; none if they are unknown.
    pub fn force_basis(&self) -> Option<&'static str> {
        Some(self.newtons()?.basis()?.as_str())
    }

    /// Normal force of a contact, N; none if it is unknown. With a calibration in force, by the newest image.
    pub fn force(&self, placed: &Placed) -> Option<f64> {
        let (description, image) = (self.description()?, self.image().map_or(&[][..], |(_, image)| image));
        self.newtons()?.contact(&description.layout, image, description.scene.contact.low, &placed.contact)
    }

    /// Apparent hardness of a present or just released contact, counts per cm2; none if its growth does not
    /// show it.
    pub fn hardness(&self, contact: u32) -> Option<u32> {
        self.growths.hardness(contact, self.layout()?)
    }

    /// Greatest force of a present or just released contact since its onset, counts; none if the contact is unknown.
    pub fn greatest_force(&self, contact: u32) -> Option<u32> {
        self.growths.greatest_force(contact)
    }

    /// True if the contact may be drift of its baseline; no intention follows from it.
    pub fn is_unsure(&self, contact: u32) -> bool {
        self.unsure.contains(&contact)
    }

    /// Age of a contact's form in frames, 255 for at least that; none unless the scene's stream has them.
    pub fn form_age(&self, contact: u32) -> Option<u8> {
        let age = self.form_ages.iter().find(|(id, _)| *id == contact).map_or(0, |(_, age)| *age);
        self.description.as_ref()?.scene.stream.form_ages.then_some(age)
    }

    /// Name of a region of the robot's surface, by its number; empty if it is not known.
    pub fn surface_region(&self, region: usize) -> &str {
        self.surface_regions.get(region).map_or("", String::as_str)
    }

    /// Ids of the contacts released with the last frame; at most the last 1,024.
    pub fn released(&self) -> &[u32] {
        &self.released
    }

    /// Touched regions, by the latest list.
    pub fn regions(&self) -> &[RegionState] {
        &self.regions
    }

    /// Names of the concepts of the scene's map.
    pub fn concepts(&self) -> &[Name] {
        self.description.as_ref().map_or(&[], BoardDescription::concepts)
    }

    /// The announced intention.
    pub fn leading(&self) -> Leading {
        self.intention.as_ref().map_or(Leading::None, |report| report.leading)
    }

    /// Activations of the concepts; 0 before the first inference.
    pub fn activations(&self) -> Vec<Q15> {
        let mut all = self.intention.as_ref().map_or_else(Vec::new, |report| report.concepts.to_vec());
        all.resize(self.concepts().len(), Q15(0));
        all
    }

    /// Activations of the concepts when the announced intention last led; these are drawn under its name. A
    /// board announces an intention a little longer than the touch activates it.
    pub fn activations_of_leading(&self) -> Vec<Q15> {
        let mut all = self.led.as_ref().map_or_else(Vec::new, |report| report.concepts.to_vec());
        all.resize(self.concepts().len(), Q15(0));
        all
    }

    /// Gesture that the touch of a panel looks like; none if it was not recognised, or is over.
    pub fn gesture(&self, panel: u8) -> Option<&GestureReport> {
        self.gesture.as_ref().filter(|report| report.panel == panel && !report.ended)
    }

    /// Faulty taxels by number, by the latest report.
    pub fn faulty(&self) -> &BTreeMap<u16, TaxelHealth> {
        &self.faulty
    }

    /// Last self-test of lines and inputs; none before the first.
    pub fn self_test(&self) -> Option<&SelfTestReport> {
        self.self_test.as_ref()
    }

    /// Cause of the board's start; none if not reported.
    pub fn boot(&self) -> Option<Boot> {
        self.description.as_ref()?.boot
    }

    /// True if the board recognises shapes that it was taught, not those of its built-in base.
    pub fn is_taught(&self) -> bool {
        !self.shapes.is_empty()
    }

    /// Name of a class of the board's base of shapes.
    pub fn shape_name(&self, class: Class) -> String {
        if self.shapes.is_empty() {
            return Base::BUILT_IN.name(class).into();
        }
        let index = usize::from(class.0).checked_sub(1);
        index.and_then(|index| self.shapes.get(index)).map_or("unknown", String::as_str).into()
    }

    /// Name of a region of the board's garment.
    pub fn region_name(&self, region: u8) -> &str {
        let regions = self.layout().map_or(&[][..], |layout| layout.regions());
        regions.get(usize::from(region)).map_or("?", Name::as_str)
    }

    /// Name of a panel of the board's garment.
    pub fn panel_name(&self, panel: u8) -> &str {
        let areas = self.layout().map_or(&[][..], |layout| layout.areas());
        areas.get(usize::from(panel)).map_or("?", |area| &area.name)
    }

    /// Latest counters of the board.
    pub fn health(&self) -> Option<&Health> {
        self.health.as_ref()
    }

    /// Latest time budget of the board.
    pub fn budget(&self) -> Option<&Budget> {
        self.budget.as_ref()
    }

    /// Latest temperature of the board's converter; none without a thermometer, or before the first report.
    pub fn celsius(&self) -> Option<Celsius> {
        self.celsius
    }
}

/// True if the announced intention is the most active of a map with these concepts, or none is announced.
pub fn leads(concepts: &[Name], report: &IntentReport) -> bool {
    let of = |leading: Leading| {
        let at = concepts.iter().position(|name| name.as_str() == leading.as_str())?;
        report.concepts.get(at).copied()
    };
    let own = of(report.leading);
    let most = Leading::INTENTIONS.into_iter().filter_map(of).max();
    report.leading == Leading::None || own.is_none() || (own == most && own > Some(Q15(0)))
}
