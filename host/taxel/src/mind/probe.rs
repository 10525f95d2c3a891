//! Properties of an object that a limb feels as it moves into it: how it yields, how pointed it is, whether it moves.

use super::felt::FeltContact;
use super::mover::SurfaceSpot;
use super::speeds::LinksAt;
use crate::body::DVec3;
use serde::Serialize;
use std::collections::VecDeque;

/// Depth from which on a hardness is known, and the least that is taken, mm: joints are read to a tenth of
/// that.
const DEEP_MM: f64 = 0.5;
/// Load from which on what is not as deep is hard, counts.
const PRESSED: u32 = 2000;
/// Time over which a speed along the surface is taken, us.
const SLIDE_US: u64 = 120_000;
/// Age of a contact from which it may slide, us: while it grows, its centroid moves.
const GROWN_US: u64 = 150_000;
/// Distance that the limb may still move while it is still, mm.
const STILL_MM: f64 = 0.6;
/// Longest time that is looked back, us.
const KEPT_US: u64 = 500_000;
/// Shortest time of a still limb from which the change of the force counts, us.
const QUIET_US: u64 = 100_000;

/// Properties of an object that a limb feels.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Probe {
    /// Greatest force over greatest depth, counts/mm, the depth of at least half a millimetre; none before
    /// that depth or 2,000 counts.
    #[cfg_attr(feature = "schema", schemars(with = "u32"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hardness: Option<u32>,
    /// Share of the force on the taxel with the greatest pressure, at the greatest force, percent.
    pub point: u32,
    /// Greatest speed of the contact along the surface, mm/s.
    pub slide: u32,
    /// Greatest change of the force while the limb was still, percent.
    pub stir: u32,
}

/// A moment of a touch.
#[derive(Debug, Clone, Copy, PartialEq)]
struct ProbeMoment {
    us: u64,
    /// Centroid on its panel, mm.
    at_mm: [f64; 2],
    panel: u8,
    load: u32,
    /// Way of the limb along the normal since the onset, mm.
    depth_mm: Option<f64>,
}

/// The course of a touch, as far as it says something of the object.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ProbeCourse {
    /// The spot of the onset, and where it was in the base: place and normal.
    began: Option<(SurfaceSpot, DVec3, DVec3)>,
    onset_us: u64,
    /// Greatest depth, mm.
    deepest_mm: f64,
    /// Greatest load.
    most: u32,
    last: VecDeque<ProbeMoment>,
    probe: Probe,
}

impl ProbeCourse {
    /// Begins with the first moment of a contact, at the host's time, us, at which the links are there.
    pub fn begin(felt: &FeltContact, links: Option<&LinksAt<'_>>, host_us: u64) -> ProbeCourse {
        let began = felt.spot.as_ref().zip(links).and_then(|(spot, links)| {
            let (at, normal) = spot.in_base(links)?;
            Some((spot.clone(), at, normal))
        });
        let mut course = ProbeCourse { began, onset_us: host_us, ..ProbeCourse::default() };
        course.take(felt, links, host_us);
        course
    }

    /// Takes a later moment.
    pub fn take(&mut self, felt: &FeltContact, links: Option<&LinksAt<'_>>, host_us: u64) {
        let depth_mm = self.began.as_ref().zip(links).and_then(|((spot, from, normal), links)| {
            let (at, _) = spot.in_base(links)?;
            Some((at - *from).dot(*normal) * 1e3)
        });
        let moment =
            ProbeMoment { us: host_us, at_mm: felt.at_mm, panel: felt.panel, load: felt.load, depth_mm };
        // Of the same time and later ones nothing is known any longer: the board's clock has been learned anew.
        while self.last.back().is_some_and(|last| last.us >= host_us) {
            self.last.pop_back();
        }
        while self.last.front().is_some_and(|first| host_us - first.us > KEPT_US) {
            self.last.pop_front();
        }
        self.last.push_back(moment);
        if felt.load >= self.most {
            self.most = felt.load;
            self.probe.point = percent(felt.peak, felt.load);
        }
        if let Some(depth_mm) = depth_mm {
            self.deepest_mm = self.deepest_mm.max(depth_mm);
            // Before the onset was reported, it was a little deeper already: that much a soft thing seems harder.
            if self.deepest_mm >= DEEP_MM || self.most >= PRESSED {
                let hardness = f64::from(self.most) / self.deepest_mm.max(DEEP_MM);
                self.probe.hardness = Some(hardness.round() as u32);
            }
        }
        self.probe.slide = self.probe.slide.max(self.slide(&moment));
        self.probe.stir = self.probe.stir.max(self.stir(&moment));
    }

    /// Returns what is felt so far.
    pub fn probe(&self) -> Probe {
        self.probe
    }

    /// Speed along the surface now, mm/s.
    fn slide(&self, now: &ProbeMoment) -> u32 {
        if now.us.saturating_sub(self.onset_us) < GROWN_US + SLIDE_US {
            return 0;
        }
        let mut before = self.last.iter().rev().filter(|moment| now.us - moment.us >= SLIDE_US);
        let Some(before) = before.next().filter(|before| before.panel == now.panel) else { return 0 };
        let [x, y] = [0, 1].map(|axis| now.at_mm[axis] - before.at_mm[axis]);
        (x.hypot(y) / ((now.us - before.us) as f64 * 1e-6)).round() as u32
    }

    /// Change of the force while the limb has been still until now, percent.
    fn stir(&self, now: &ProbeMoment) -> u32 {
        let Some(depth_mm) = now.depth_mm else { return 0 };
        let is_still = |moment: &&ProbeMoment| {
            moment.depth_mm.is_some_and(|before| (depth_mm - before).abs() <= STILL_MM / 2.0)
        };
        let quiet: Vec<&ProbeMoment> = self.last.iter().rev().take_while(is_still).collect();
        let lasts_us = quiet.last().map_or(0, |first| now.us - first.us);
        if lasts_us < QUIET_US {
            return 0;
        }
        // The limb has just come to rest: what it has pressed together counts, not what is still coming.
        let settled = quiet.iter().filter(|moment| moment.us + lasts_us - QUIET_US / 2 >= now.us);
        let loads = settled.map(|moment| moment.load);
        let (least, most) =
            loads.fold((u32::MAX, 0), |(least, most), load| (least.min(load), most.max(load)));
        percent(most.saturating_sub(least), most)
    }
}

/// A share of a whole, percent; 0 of nothing.
fn percent(part: u32, whole: u32) -> u32 {
    let share = (u64::from(part) * 100).checked_div(whole.into()).unwrap_or(0);
    u32::try_from(share).unwrap_or(u32::MAX)
}
