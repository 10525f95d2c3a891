//! Events as sentences, for the plain lines and for the log in the terminal.

use taxel::client::{Client, Event, Worn, request_name};
use taxel::tell::starts;
use taxel_core::contact::{Hardness, Phase};
use taxel_core::format::Micros;
use taxel_core::intent::Leading;
use taxel_core::surface::{BodyDirection, RegionPhase, RegionSymbol};
use taxel_core::symbol::{Extent, Symbol};
use taxel_core::wire::{GestureReport, RegionsReport};

/// Turns events into sentences.
#[derive(Debug, Clone)]
pub struct Narrator {
    /// Counts per newton, if known: forces are then told in newtons.
    pub counts_per_newton: Option<f32>,
    leading: Leading,
    /// Garbage was reported, and no other event has come since.
    garbage: bool,
    /// Phases and ways of the surface's regions.
    regions: Vec<(RegionPhase, BodyDirection)>,
}

impl Narrator {
    /// A narrator; with counts per newton, forces are told in newtons.
    pub fn new(counts_per_newton: Option<f32>) -> Narrator {
        Narrator { counts_per_newton, leading: Leading::None, garbage: false, regions: Vec::new() }
    }

    /// Returns the lines for an event, if it deserves any.
    pub fn tell(&mut self, client: &Client, event: &Event) -> Vec<String> {
        let garbage = matches!(event, Event::Refused(_));
        if std::mem::replace(&mut self.garbage, garbage) && garbage {
            return Vec::new();
        }
        if let Event::Intent(report) = event {
            let before = std::mem::replace(&mut self.leading, report.leading);
            if before == report.leading {
                return Vec::new();
            }
            return vec![format!("{} intention: {}", seconds(report.time), report.leading.as_str())];
        }
        if let Event::Regions(report) = event {
            return self.regions(client, report);
        }
        sentences(client, event, self.counts_per_newton)
    }

    /// Lines for the regions that feel something else than before.
    fn regions(&mut self, client: &Client, report: &RegionsReport) -> Vec<String> {
        let before = std::mem::take(&mut self.regions);
        self.regions = report.regions.iter().map(|region| (region.phase, region.way)).collect();
        let now = self.regions.iter().zip(&report.regions).enumerate();
        let changed = now.filter(|(number, (now, _))| {
            **now != before.get(*number).copied().unwrap_or((RegionPhase::Free, BodyDirection::None))
        });
        let line = |(number, (_, region)): (usize, (_, &RegionSymbol))| {
            let says = felt(client, region)?;
            Some(format!("{} {}: {says}", seconds(report.time), client.surface_region(number)))
        };
        changed.filter_map(line).collect()
    }
}

/// Formats a time of the board: `  12.345 s`.
pub fn seconds(time: Micros) -> String {
    format!("{:8.3} s", time.0 as f64 / 1e6)
}

/// Sentences that do not depend on earlier events.
fn sentences(client: &Client, event: &Event, per_newton: Option<f32>) -> Vec<String> {
    match event {
        Event::Hello => client.worn().map(hello).into_iter().collect(),
        Event::Unusable(why) => vec![format!("refused: {why}")],
        Event::Boot(boot) => starts::remark(boot).into_iter().collect(),
        Event::Symbols(list) => {
            let line =
                |symbol: &Symbol| format!("{} {}", seconds(list.time), said(client, symbol, per_newton));
            list.events.iter().filter(|e| e.phase != Phase::Held).map(line).collect()
        }
        Event::Shapes { names, prototypes } if *prototypes > 0 => {
            vec![format!("shapes: taught {} by {prototypes} prototypes", names.join(", "))]
        }
        Event::Unsure(report) if !report.contacts.is_empty() => {
            let ids: Vec<String> = report.contacts.iter().map(u32::to_string).collect();
            vec![format!(
                "{} baseline unsure: contact {} may be drift of the garment, so no intention follows from it",
                seconds(report.time),
                ids.join(", ")
            )]
        }
        Event::Gesture(report) => vec![gesture(client, report)],
        Event::Reaction(report) => {
            let verb = if report.reaction.active { "begins" } else { "ends" };
            vec![format!(
                "{} reaction {} {verb} ({})",
                seconds(report.time),
                report.reaction.name,
                report.reaction.value
            )]
        }
        Event::Log { time, level, text } | Event::Note { time, level, text } => {
            vec![format!("{} {}: {text}", seconds(*time), format!("{level:?}").to_lowercase())]
        }
        Event::Answer { request, refusal: Some(why) } => {
            vec![format!("refused: {}: {why}", request_name(*request))]
        }
        Event::Answer { request: 2, refusal: None } => vec!["tare: done".into()],
        Event::Refused(error) => vec![format!("refused: {error}")],
        Event::Lost { why: text, .. } => vec![format!("lost: {text}")],
        Event::Back { how: text, .. } => vec![format!("back: {text}")],
        Event::Other { why } => vec![format!("another board: {why}")],
        _ => Vec::new(),
    }
}

/// What a region feels; none if it is free again.
fn felt(client: &Client, region: &RegionSymbol) -> Option<String> {
    Some(match region.phase {
        RegionPhase::Free => return None,
        RegionPhase::Onset => {
            let words = [region.strength.as_str(), region.extent.as_str()];
            format!("touched ({}, {})", words.join(" "), client.shape_name(region.class))
        }
        RegionPhase::Held => "held".into(),
        RegionPhase::Moving => format!("moves {}", direction(region.way)),
        RegionPhase::Released => "released".into(),
    })
}

fn direction(way: BodyDirection) -> &'static str {
    match way {
        BodyDirection::None => "nowhere",
        BodyDirection::Forward => "forward",
        BodyDirection::Back => "back",
        BodyDirection::Left => "left",
        BodyDirection::Right => "right",
        BodyDirection::Up => "up",
        BodyDirection::Down => "down",
    }
}

fn hello(worn: &Worn) -> String {
    let (taxels, panels) = (worn.layout.taxels(), worn.layout.areas().len());
    let simulated = if worn.is_simulated() { "simulated board, " } else { "" };
    format!(
        "hello: {simulated}{}, garment {} ({taxels} taxels, {panels} panels), scene {}",
        worn.firmware, worn.garment.name, worn.scene.name
    )
}

/// Describes the class of a touch.
fn gesture(client: &Client, report: &GestureReport) -> String {
    let (time, panel, name) = (seconds(report.time), client.panel_name(report.panel), &report.name);
    let observed = f64::from(report.observed_ms) / 1e3;
    let verb = if report.ended { "was" } else { "looks like" };
    let sure = client.confidence(report).map(|share| format!("{:.0} % sure after ", 100.0 * share.to_f64()));
    let sure = sure.unwrap_or_default();
    format!("{time} touch {} of the {panel} {verb}: {name} ({sure}{observed:.1} s)", report.touch)
}

/// Describes an onset or a release.
fn said(client: &Client, symbol: &Symbol, counts_per_newton: Option<f32>) -> String {
    let region = client.region_name(symbol.region);
    if symbol.phase != Phase::Released {
        return format!("contact {} on the {region} begins", symbol.contact);
    }
    let strength = symbol.words.strength.as_str();
    let extent = symbol.words.extent.as_str();
    let moving = if symbol.words.moving { ", sliding" } else { "" };
    let feels = match client.hardness(symbol.contact).map(Hardness::of) {
        None | Some(Hardness::Firm) => String::new(),
        Some(word) => format!(", feels {}", word.as_str()),
    };
    // A saturated taxel gives only a lower bound.
    let bound = if symbol.words.extent == Extent::Sharp { "at least" } else { "at most" };
    format!(
        "contact {} on the {region} ends: {strength}, {extent}, {}{moving}, {} ms, {bound} {}{feels}",
        symbol.contact,
        client.shape_name(symbol.words.class),
        symbol.duration_ms,
        force(symbol.peak_total, counts_per_newton)
    )
}

/// Formats a total in newtons if the calibration is known, else in counts.
pub fn force(total: u32, counts_per_newton: Option<f32>) -> String {
    match counts_per_newton {
        Some(counts) => format!("{:.1} N", total as f32 / counts),
        None => format!("{total} counts"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::shape::Class;
    use taxel_core::symbol::{Span, Strength, Words};

    #[test]
    fn what_fills_a_taxel_is_told_as_at_least_so_much() {
        let line = |extent| {
            let (strength, span) = (Strength::Hard, Span::Long);
            let words = Words { strength, extent, span, moving: false, class: Class(0) };
            let (phase, region) = (Phase::Released, 0);
            let symbol = Symbol { contact: 7, phase, region, words, peak_total: 4_800, duration_ms: 900 };
            said(&Client::new(), &symbol, Some(1_000.0))
        };
        assert!(
            line(Extent::Sharp).ends_with("sharp, unknown, 900 ms, at least 4.8 N"),
            "{}",
            line(Extent::Sharp)
        );
        assert!(
            line(Extent::Point).ends_with("point, unknown, 900 ms, at most 4.8 N"),
            "{}",
            line(Extent::Point)
        );
    }
}
