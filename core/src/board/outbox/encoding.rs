//! Encodes the most urgent message.

use super::super::tx_frame::TxFrame;
use super::super::{BoardInfo, Setup};
use super::contacts::{ContactQueue, List};
use super::{About, GestureQueue, Outbox, Slow, Waiting};
use crate::body::Placed;
use crate::condition::{Certificate, Image};
use crate::format::{Micros, Name};
use crate::garment::Layout;
use crate::health::Monitor;
use crate::pipeline::CONTACTS;
use crate::shape::Taught;
use crate::unsure::UnsureState;
use crate::wire::*;
use core::fmt::Write;
use heapless::{String, Vec};
use serde::Serialize;

impl<const TAXELS: usize> Outbox<TAXELS> {
    /// Encodes the most urgent message, if there is one. Own frame: its buffers are on the stack only here.
    #[inline(never)]
    pub(super) fn next(
        &mut self,
        now: Micros,
        about: About<'_>,
        image: &Image<'_>,
        (pressing, folds): Slow<impl FnOnce(&mut TxFrame) -> bool, impl FnOnce() -> Option<FoldsReport>>,
        health: &mut Health,
    ) {
        let tx_frame = &mut self.tx_frame;
        self.parting &= self.contacts.waits || self.symbols_wait;
        let parting = self.parting;
        let fits = if let Some((token, received)) = self.synced.pop_front() {
            tx_frame.put(Report::SYNC, &SyncReport { token, received, sent: now })
        } else if let Some(start) = self.start_of_frame.take() {
            tx_frame.put(Report::START_OF_FRAME, &start)
        } else if !parting && self.hello.is_some_and(|due| due <= now) {
            self.hello = None;
            self.greeted = true;
            put_hello(tx_frame, now, about.info, about.setup, about.certificate)
        } else if let Some(boot) = about.boot.filter(|_| core::mem::take(&mut self.greeted)) {
            tx_frame.put(Report::BOOT, &boot)
        } else if let Some(report) = about.examined.filter(|_| core::mem::take(&mut self.examined)) {
            tx_frame.put(Report::SELF_TEST, report)
        } else if let Some((request, refusal)) = (!parting).then(|| self.answers.pop_front()).flatten() {
            let refusal = refusal.as_ref().map(|why| why.0.as_str());
            tx_frame.put(Report::ANSWER, &Answer { request, refusal })
        } else if let Some(report) = self.reflexes.pop_front() {
            tx_frame.put(Report::REFLEX, &report)
        } else if let Some(report) = self.reactions.pop_front() {
            tx_frame.put(Report::REACTION, &report)
        } else if core::mem::take(&mut self.shapes) {
            // Before the contacts, whose classes are indices of these names.
            put_shapes(tx_frame, about.taught)
        } else if core::mem::take(&mut self.ages_wait) {
            put_forms(tx_frame, &self.contacts, about.present, about.form_ages)
        } else if core::mem::take(&mut self.contacts.waits) {
            tx_frame.put(Report::CONTACTS, &List { queue: &self.contacts, present: about.present })
        } else if core::mem::take(&mut self.unsure) {
            put_unsure(tx_frame, self.contacts.frame, self.contacts.time, about.unsure)
        } else if self.symbols_wait {
            self.symbols_wait = false;
            tx_frame.put(Report::SYMBOLS, &self.symbols)
        } else if let Some(report) = self.changes.front().or(self.intent.as_ref()) {
            // Encoded in place: it may have 64 concepts.
            let fits = tx_frame.put(Report::INTENT, report);
            if self.changes.pop_front().is_none() {
                self.intent = None;
            }
            fits
        } else if !self.gestures.is_empty() {
            put_gesture(tx_frame, &mut self.gestures)
        } else if let Some((level, text)) = self.logs.pop_front() {
            tx_frame.put(Report::LOG, &Log { time: now, level, text: &text })
        } else if let Some(first) = self.map.take_if(|_| self.streaming) {
            self.put_map(now, first, about.setup.layout.taxels(), about.monitor)
        } else if self.health.is_some_and(|due| due <= now) {
            self.health = None;
            tx_frame.put(Report::HEALTH, &Health { time: now, ..*health })
        } else if let Some(budget) = self.budget.take() {
            tx_frame.put(Report::BUDGET, &budget)
        } else if let Some(temperature) = self.temperature.take() {
            tx_frame.put(Report::TEMPERATURE, &temperature)
        } else if let Some(pressing) = pressing.filter(|_| cfg!(feature = "surface") && self.streaming) {
            pressing(tx_frame)
        } else if let Some(folds) = folds.filter(|_| cfg!(feature = "folds") && self.streaming) {
            put_made(tx_frame, Report::FOLDS, folds)
        } else if let Some((frame, time)) = self.image.due.take() {
            let is_light = || !about.took_picture && measures_little(about.present, about.form_ages);
            self.put_image(frame, time, &about.setup.layout, image, is_light, health)
        } else if let Some((frame, time)) = self.raw.take().filter(|_| cfg!(feature = "raw")) {
            self.put_raw(frame, time)
        } else {
            true
        };
        health.lost = health.lost.wrapping_add(u32::from(!fits));
    }

    /// Encodes as much of the health map as fits a message.
    #[inline(never)]
    fn put_map(&mut self, time: Micros, first: u16, taxels: usize, monitor: &Monitor) -> bool {
        let mut map = HealthMap { time, first, end: taxels as u16, taxels: Vec::new() };
        for faulty in monitor.faulty().iter().filter(|faulty| faulty.taxel >= first) {
            match map.taxels.last_mut() {
                Some(run) if run.health == faulty.health && run.first + run.count == faulty.taxel => {
                    run.count += 1
                }
                _ => {
                    if map
                        .taxels
                        .push(FaultyTaxels { first: faulty.taxel, count: 1, health: faulty.health })
                        .is_err()
                    {
                        map.end = faulty.taxel;
                        break;
                    }
                }
            }
        }
        self.map = (usize::from(map.end) < taxels).then_some(map.end);
        self.tx_frame.put(Report::HEALTH_MAP, &map)
    }

    /// Returns `false` if the message does not fit. An image without room for its code is thinned. A key
    /// frame takes longer to encode, so a light frame shortly before it is due becomes it.
    fn put_image(
        &mut self,
        frame: u32,
        time: Micros,
        layout: &Layout,
        image: &Image<'_>,
        is_light: impl Fn() -> bool,
        health: &mut Health,
    ) -> bool {
        let Outbox { tx_frame, image: Waiting { base, key, last, .. }, rates, .. } = self;
        let rest_us = rates.key_us.saturating_sub(time.since(*key));
        let is_key_due = rest_us == 0 || rest_us <= rates.key_us / 16 && is_light();
        let against = base.filter(|_| !is_key_due);
        let Some(length) = last.advance(layout, image, against.is_none(), tx_frame.scratch()) else {
            last.clear();
            *base = None;
            health.thinned_frames += 1;
            return true;
        };
        let head = Frame { frame, time, base: against, sum: last.sum(), data: &[] };
        let fits = tx_frame.put_data(Report::FRAME, &head, length);
        *base = fits.then_some(frame);
        if fits && against.is_none() {
            *key = time;
        }
        fits
    }

    fn put_raw(&mut self, frame: u32, time: Micros) -> bool {
        let mut plain = [0; TAXELS];
        for (value, code) in plain.iter_mut().zip(&self.codes) {
            *value = code.0;
        }
        let plain = plain.get(..self.codes.len()).unwrap_or(&[]);
        let length = encode_image(plain, None, self.tx_frame.scratch());
        let head = Raw { frame, time, data: &[] };
        length.is_some_and(|length| self.tx_frame.put_data(Report::RAW, &head, length))
    }
}

/// True if no contact that is larger than the mean has its form measured in this frame, or in the next one,
/// when the rest of the message is sent. Unlike a measured time, this is the same on every machine.
fn measures_little(present: &[Placed], form_ages: &[u8]) -> bool {
    let area = |placed: &Placed| u32::from(placed.contact.area);
    let all: u32 = present.iter().map(area).sum();
    let oldest = form_ages.iter().max();
    let turns = present.iter().zip(form_ages).filter(|(_, age)| **age == 0 || Some(*age) == oldest);
    turns.map(|(placed, _)| area(placed)).all(|area| area * present.len() as u32 <= all)
}

/// Encodes the confidence of the first waiting gesture, then that gesture, so that a reader has the
/// confidence first.
fn put_gesture(tx_frame: &mut TxFrame, waiting: &mut GestureQueue) -> bool {
    let Some((report, confidence)) = waiting.front_mut() else { return true };
    let GestureReport { frame, time, touch, .. } = *report;
    if let Some(confidence) = confidence.take() {
        return tx_frame.put(Report::CONFIDENCE, &ConfidenceReport { frame, time, touch, confidence });
    }
    let fits = tx_frame.put(Report::GESTURE, report);
    waiting.pop_front();
    fits
}

fn put_forms(tx_frame: &mut TxFrame, list: &ContactQueue, present: &[Placed], ages: &[u8]) -> bool {
    let mut report = FormsReport { frame: list.frame, time: list.time, ages: Vec::new() };
    for (placed, age) in list.listed(present).zip(ages).filter(|(_, age)| **age > 0) {
        // There are as many places as in the list.
        let _ = report.ages.push((placed.contact.id, *age));
    }
    tx_frame.put(Report::FORMS, &report)
}

fn put_unsure(tx_frame: &mut TxFrame, frame: u32, time: Micros, unsure: &UnsureState<CONTACTS>) -> bool {
    let mut contacts = Vec::new();
    for id in unsure.ids() {
        // There are as many places as contacts.
        let _ = contacts.push(id);
    }
    tx_frame.put(Report::UNSURE, &UnsureReport { frame, time, contacts })
}

/// Encodes a report that is made here, of much that is summed up. Own frame: it needs much stack.
#[inline(never)]
fn put_made<T: Serialize>(tx_frame: &mut TxFrame, number: u32, make: impl FnOnce() -> Option<T>) -> bool {
    make().is_none_or(|report| tx_frame.put(number, &report))
}

/// Encodes a [`ShapesReport`].
fn put_shapes(tx_frame: &mut TxFrame, taught: &Taught<CONTACTS>) -> bool {
    match taught.gallery() {
        Some(gallery) => tx_frame.put(Report::SHAPES, &(gallery.prototypes.len() as u16, &gallery.names)),
        None => tx_frame.put(Report::SHAPES, &(0u16, Vec::<Name, 0>::new())),
    }
}

fn put_hello(
    tx_frame: &mut TxFrame,
    now: Micros,
    info: &BoardInfo,
    setup: &Setup,
    certificate: Option<&Certificate>,
) -> bool {
    let mut calibration: String<48> = String::new();
    // Its longest form has 35 characters.
    let _ = certificate.map(|it| write!(calibration, "{it}"));
    let (mut clock, mut garment, mut scene) = ([0; 10], [0; 2048], [0; LONGEST_REQUEST]);
    let hello = Hello {
        magic: MAGIC,
        protocol: PROTOCOL,
        garment: written(&setup.garment, &mut garment),
        firmware: info.firmware.as_bytes(),
        clock: written(&now, &mut clock),
        scene: written(&setup.scene, &mut scene),
        calibration: calibration.as_bytes(),
    };
    tx_frame.put(Report::HELLO, &hello)
}

/// Writes a value as postcard; returns no bytes if it does not fit.
fn written<'a, T: Serialize>(value: &T, buffer: &'a mut [u8]) -> &'a [u8] {
    let bytes = write(value, buffer).unwrap_or(0);
    buffer.get(..bytes).unwrap_or(&[])
}
