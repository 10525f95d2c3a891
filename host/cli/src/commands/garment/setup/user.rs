//! Simulates a user who touches a bundle of wires.
//!
//! The finger covers two to three taxels and is up to one taxel off the requested place; its pace varies by
//! half. Each sample has 3 counts of noise, the gains of taxels differ by a third, a dozen of them are dead
//! or stuck.

use super::ask::{Ask, Gesture};
use super::bundle::Bundle;
use super::feel::Feeler;
use super::touch::Touch;
use anyhow::Result;
use fastrand::Rng;
use std::f64::consts::TAU;
use taxel::sim::{Decoder, FULL_SCALE};
use taxel_core::garment::{Garment, Layout, Place};

/// Noise of a sample, counts rms.
const NOISE: f32 = 3.0;
/// Frames at rest before and after a touch.
const REST: u32 = 30;

/// A user who touches as requested.
pub struct User {
    rng: Rng,
    layout: Layout,
    /// Taxel of each address.
    taxels: Vec<Option<usize>>,
    /// Code at rest and gain of each taxel.
    taxel: Vec<(f32, f32)>,
    period: f64,
    now: f64,
    feeler: Feeler,
}

/// A finger at one moment.
struct Finger {
    panel: usize,
    x: f64,
    y: f64,
    radius: f64,
    counts: f64,
}

impl User {
    /// A user of a wired garment, of which one input may be dead, read through the bundle's addresses.
    pub fn new(wired: &Garment, bundle: &Bundle, dead: Option<u8>, mut rng: Rng) -> Result<User> {
        let layout = Layout::build(wired, usize::from(u16::MAX), FULL_SCALE)?;
        let decoder = Decoder::build(wired);
        let taxel = |address: usize| {
            let pin = bundle.inputs[bundle.split(address).0];
            let input = decoder.inputs().iter().position(|input| *input == pin && Some(pin) != dead)?;
            decoder.taxel(decoder.address(bundle.levels(address, wired))?, input)
        };
        let taxels = (0..bundle.addresses()).map(taxel).collect();
        let feels = |rng: &mut Rng| if rng.u8(..200) == 0 { 0.0 } else { 0.7 + 0.6 * rng.f32() };
        let each = (0..layout.taxels()).map(|_| (80.0 + 20.0 * rng.f32(), feels(&mut rng))).collect();
        let period = 1.0 / (25.0 + 35.0 * rng.f64());
        let feeler = Feeler::new(wired.wiring.falling);
        let mut user = User { rng, layout, taxels, taxel: each, period, now: 0.0, feeler };
        user.feel(REST, |_| None);
        Ok(user)
    }

    /// Touches as requested. Returns what the board has felt.
    pub fn touch(&mut self, ask: &Ask) -> Option<Touch> {
        let area = self.layout.areas().get(ask.panel)?;
        let (last_x, last_y) = (f64::from(area.columns - 1), f64::from(area.rows - 1));
        let rng = &mut self.rng;
        let mut off = || 2.0 * rng.f64() - 1.0;
        let (from, to) = match ask.gesture {
            Gesture::Down { column, .. } => {
                let x = f64::from(column) + 0.7 * off();
                ([x, off()], [x, last_y + off()])
            }
            Gesture::Across { row } => {
                let y = f64::from(row) + 0.7 * off();
                ([off(), y], [last_x + off(), y])
            }
            Gesture::Corner => {
                let at = [off(), off()];
                (at, at)
            }
        };
        let (pace, wobble, phase) = (0.08 * off(), 0.3 * off().abs(), off());
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let seconds = 0.5 + length / (12.0 + 18.0 * rng.f64());
        let (radius, counts) = (1.1 + 0.6 * rng.f64(), 500.0 + 1_300.0 * rng.f64());
        let frames = (seconds / self.period) as u32 + 1;
        // Offset across a stroke; a press has none.
        let aside =
            if length < 2.0 { [0.0, 0.0] } else { [(to[1] - from[1]) / length, (to[0] - from[0]) / length] };
        let panel = ask.panel;
        let ended = self.feel(frames, |frame| {
            let part = f64::from(frame) / f64::from(frames.max(2) - 1);
            let part = part + pace * (TAU * part).sin();
            let swing = wobble * (TAU * (part + phase)).sin();
            let at = |axis: usize| from[axis] + part * (to[axis] - from[axis]) + swing * aside[axis];
            Some(Finger { panel, x: at(0), y: at(1), radius, counts })
        });
        ended.or_else(|| self.feel(REST, |_| None))
    }

    /// Simulates this many frames under a finger.
    fn feel(&mut self, frames: u32, finger: impl Fn(u32) -> Option<Finger>) -> Option<Touch> {
        let mut ended = None;
        for frame in 0..frames {
            self.now += self.period;
            let codes = self.codes(finger(frame).as_ref());
            ended = ended.or(self.feeler.take(self.now, &codes));
        }
        ended
    }

    fn codes(&mut self, finger: Option<&Finger>) -> Vec<u16> {
        let mut signals: Vec<f32> = self.taxel.iter().map(|(rest, _)| *rest).collect();
        if let Some(finger) = finger {
            for (place, taxel) in under(&self.layout, finger) {
                let share = 1.0
                    - ((place[0] - finger.x).powi(2) + (place[1] - finger.y).powi(2)) / finger.radius.powi(2);
                signals[taxel] += self.taxel[taxel].1 * (finger.counts * share.max(0.0)) as f32;
            }
        }
        let rng = &mut self.rng;
        // The sum of three has a standard deviation of a half.
        let mut noise = || 2.0 * NOISE * (rng.f32() + rng.f32() + rng.f32() - 1.5);
        let code = |taxel: &Option<usize>| taxel.map_or(0.0, |taxel| signals[taxel]);
        self.taxels
            .iter()
            .map(|taxel| (code(taxel) + noise()).clamp(0.0, f32::from(FULL_SCALE)) as u16)
            .collect()
    }
}

/// Taxels within reach of the finger: column and row, and number.
fn under<'a>(layout: &'a Layout, finger: &Finger) -> impl Iterator<Item = ([f64; 2], usize)> + 'a {
    let (panel, reach) = (finger.panel as u8, finger.radius.ceil() as i32);
    let (x, y) = (finger.x.round() as i32, finger.y.round() as i32);
    let near =
        (y - reach..=y + reach).flat_map(move |row| (x - reach..=x + reach).map(move |column| (row, column)));
    near.filter_map(move |(row, column)| {
        let place = Place { panel, row: u16::try_from(row).ok()?, column: u16::try_from(column).ok()? };
        Some(([f64::from(column), f64::from(row)], layout.taxel(place)?))
    })
}
