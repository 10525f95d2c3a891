//! Events as sentences, for the plain lines and for the log in the terminal.

use super::shape::is_sure;
use std::collections::BTreeMap;
use taxel::client::{BoardDescription, Client, Event, request_name};
use taxel::text::starts;
use taxel_core::body::Placed;
use taxel_core::contact::{Hardness, Phase};
use taxel_core::format::Micros;
use taxel_core::intent::Leading;
use taxel_core::shape::Class;
use taxel_core::surface::{BodyDirection, RegionPhase, RegionSymbol};
use taxel_core::symbol::{Extent, Symbol};
use taxel_core::wire::{GestureReport, RegionsReport, Request, SymbolList};

/// Number of the request for a tare.
const TARE: u8 = Request::Tare { frames: 0 }.number();

/// Turns events into sentences.
#[derive(Debug, Default, Clone)]
pub struct Narrator {
    leading: Leading,
    /// Garbage was reported, and no other event has come since.
    garbage: bool,
    /// Phases and ways of the surface's regions.
    regions: Vec<(RegionPhase, BodyDirection)>,
    /// Shapes of present and just released contacts of which the recogniser was sure.
    shapes: BTreeMap<u32, Class>,
}

impl Narrator {
    /// Returns the lines for an event, if it deserves any.
    pub fn narrate(&mut self, client: &Client, event: &Event) -> Vec<String> {
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
        match event {
            Event::Regions(report) => self.regions(client, report),
            Event::Symbols(list) => self.symbols(client, list),
            Event::Contacts { released, .. } => {
                self.look(client, released);
                Vec::new()
            }
            event => sentences(client, event),
        }
    }

    /// Remembers the shapes of present and just released contacts.
    fn look(&mut self, client: &Client, released: &[Placed]) {
        let all = || client.contacts().iter().chain(released);
        self.shapes.retain(|id, _| all().any(|placed| placed.contact.id == *id));
        let sure = all().filter(|placed| is_sure(client, placed));
        self.shapes.extend(sure.map(|placed| (placed.contact.id, placed.shape.class)));
    }

    /// Lines for onsets and releases.
    fn symbols(&self, client: &Client, list: &SymbolList) -> Vec<String> {
        let line = |symbol: &Symbol| {
            let is_sure = self.shapes.get(&symbol.contact) == Some(&symbol.words.class);
            format!("{} {}", seconds(list.time), said(client, symbol, is_sure))
        };
        list.events.iter().filter(|symbol| symbol.phase != Phase::Held).map(line).collect()
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
            let says = felt(region)?;
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
fn sentences(client: &Client, event: &Event) -> Vec<String> {
    match event {
        Event::Hello => {
            let remark = client.boot().as_ref().and_then(starts::remark);
            client.description().map(hello).into_iter().chain(remark).collect()
        }
        Event::Unusable(why) => vec![format!("refused: {why}")],
        Event::Shapes { names, prototypes } if *prototypes > 0 => {
            vec![format!("shapes: taught {} by {prototypes} prototypes", names.join(", "))]
        }
        Event::Contacts { time, doubted, .. } if !doubted.is_empty() => {
            let ids: Vec<String> = doubted.iter().map(u32::to_string).collect();
            vec![format!(
                "{} baseline unsure: contact {} may be drift of the garment, so no intention follows from it",
                seconds(*time),
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
        Event::Answer { request: TARE, refusal: None } => vec!["tare: done".into()],
        Event::Refused(error) => vec![format!("refused: {error}")],
        Event::Lost { why: text, .. } => vec![format!("lost: {text}")],
        Event::Back { how: text, .. } => vec![format!("back: {text}")],
        Event::Other { why } => vec![format!("another board: {why}")],
        _ => Vec::new(),
    }
}

/// Returns what a region feels; none if it is free again.
fn felt(region: &RegionSymbol) -> Option<String> {
    Some(match region.phase {
        RegionPhase::Free => return None,
        RegionPhase::Onset => {
            format!("touched ({} {})", region.strength.as_str(), region.extent.as_str())
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

fn hello(description: &BoardDescription) -> String {
    let (taxels, panels) = (description.layout.taxels(), description.layout.areas().len());
    let simulated = if description.is_simulated() { "simulated board, " } else { "" };
    format!(
        "hello: {simulated}{}, garment {} ({taxels} taxels, {panels} panels), scene {}",
        description.firmware, description.garment.name, description.scene.name
    )
}

/// Describes the class of a touch.
fn gesture(client: &Client, report: &GestureReport) -> String {
    let (time, panel, name) = (seconds(report.time), client.panel_name(report.panel), &report.name);
    let observed = f64::from(report.observed_ms) / 1e3;
    let verb = if report.ended { "was" } else { "looks like" };
    let sure = report.confidence.map(|share| format!("{:.0} % sure after ", 100.0 * share.to_f64()));
    let sure = sure.unwrap_or_default();
    format!("{time} touch {} of the {panel} {verb}: {name} ({sure}{observed:.1} s)", report.touch)
}

/// Describes an onset or a release, with the shape if the recogniser was sure of it.
fn said(client: &Client, symbol: &Symbol, is_sure: bool) -> String {
    let region = client.region_name(symbol.region);
    if symbol.phase != Phase::Released {
        return format!("contact {} on the {region} begins", symbol.contact);
    }
    let strength = symbol.words.strength.as_str();
    let extent = symbol.words.extent.as_str();
    let shape = if is_sure { format!(", {}", client.shape_name(symbol.words.class)) } else { String::new() };
    let moving = if symbol.words.moving { ", sliding" } else { "" };
    let feels = match client.hardness(symbol.contact).map(Hardness::of) {
        None | Some(Hardness::Firm) => String::new(),
        Some(word) => format!(", feels {}", word.as_str()),
    };
    // A saturated taxel gives only a lower bound.
    let bound = if symbol.words.extent == Extent::Sharp { "at least" } else { "at most" };
    format!(
        "contact {} on the {region} ends: {strength}, {extent}{shape}{moving}, {} ms, {bound} {}{feels}",
        symbol.contact,
        symbol.duration_ms,
        force(client, symbol.peak_total)
    )
}

/// Formats a total in newtons if they are known, else in counts.
pub fn force(client: &Client, total: u32) -> String {
    match client.counts_per_newton() {
        Some(counts) => format!("{:.1} N", f64::from(total) / counts),
        None => format!("{total} counts"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::watch::{WatchOptions, watch};
    use taxel::client::Stamp;
    use taxel::session::Observer;
    use taxel::source::{SourceOptions, SourceSpec, open};
    use taxel_core::shape::Base;
    use taxel_core::symbol::{Span, Strength, Words};

    #[test]
    fn what_fills_a_taxel_is_reported_as_at_least_so_much() {
        let line = |extent| {
            let (strength, span) = (Strength::Hard, Span::Long);
            let words = Words { strength, extent, span, moving: false, class: Class(0) };
            let (phase, region) = (Phase::Released, 0);
            let symbol = Symbol { contact: 7, phase, region, words, peak_total: 4_800, duration_ms: 900 };
            said(&Client::new(), &symbol, false)
        };
        let ends = |extent, end: &str| assert!(line(extent).ends_with(end), "{}", line(extent));
        ends(Extent::Sharp, "sharp, 900 ms, at least 4800 counts");
        ends(Extent::Point, "point, 900 ms, at most 4800 counts");
    }

    /// A narrator, and what it has reported.
    struct Heard(Narrator, String);

    impl Observer for Heard {
        fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
            self.0.narrate(client, event).iter().for_each(|line| self.1 += &format!("{line}\n"));
            Ok(())
        }
    }

    /// The lines of a script, to a board with this base of shapes.
    fn lines(script: &str, shapes: Option<&str>) -> String {
        let spec: SourceSpec = script.parse().unwrap();
        let source = open(&spec, &SourceOptions::default()).unwrap();
        let mut heard = Heard(Narrator::default(), String::new());
        let mut args = WatchOptions::of(spec);
        args.board.config.shapes = shapes.map(Into::into);
        watch(&args, source, &mut heard).unwrap();
        heard.1
    }

    #[test]
    fn a_shape_is_reported_only_where_the_recogniser_is_sure() {
        // The built-in base takes a palm, a ball and a box for rectangles, and is never in doubt.
        for script in ["sim:pat", "sim:ball", "sim:box"] {
            let reported = lines(script, None);
            assert!(reported.contains(" ends: "), "{reported}");
            assert!(!Base::BUILT_IN.names.iter().any(|name| reported.contains(name)), "{reported}");
        }
        let taught = lines("sim:box", Some("drawn"));
        assert!(taught.contains(", rectangle, "), "{taught}");
    }
}
