//! The JSON message of an event.
//!
//! A line of type `frame` holds what `taxel process` prints for a frame: the present contacts, the released
//! ones (`released`) and the intention; and the counts of lost and thinned messages so far. `time_us` is the
//! board's time.

use super::contact::ContactLine;
use super::lines::{
    AnswerLine, BackLine, ContactsLine, DoubtLine, FaultyTaxel, FoldsLine, FrameLine, GestureLine,
    HealthMapLine, HelloLine, HelloPanel, IntentLine, JsonLine, LogLine, LostLine, OtherLine, PinFaultLine,
    RawLine, ReactionLine, ReflexLine, RefusedLine, RegionLine, RegionsLine, SelfTestLine, ShapesLine,
    StartLine, StartOfFrameLine, SurfaceRegionLine, SymbolLine, SymbolsLine, SyncLine, TemperatureLine,
    UnusableLine, WordsLine,
};
use super::meaning::MeaningOfTouch;
use super::pressing;
use crate::client::{Client, Event, ImageNews, request_name};
use serde_json::Value;
use taxel_core::body::Placed;
use taxel_core::format::{Micros, Name, Q15};
use taxel_core::intent::Outcome;
use taxel_core::surface::RegionSymbol;
use taxel_core::symbol::Symbol;
use taxel_core::wire::{
    GestureReport, IntentReport, Level, ReactionReport, ReflexReport, RegionsReport, SelfTestReport,
    SymbolList,
};

/// Encodes one event as a JSON object; null for a `Hello` that cannot be used.
pub fn message(client: &Client, event: &Event) -> Value {
    // Numbers, texts and keys that are texts: this cannot fail.
    line(client, event).and_then(|line| serde_json::to_value(line).ok()).unwrap_or_default()
}

/// The message of an event; none for a `Hello` that cannot be used.
pub fn line<'a>(client: &'a Client, event: &'a Event) -> Option<JsonLine<'a>> {
    Some(match event {
        Event::Hello => JsonLine::Hello(hello(client)?),
        Event::Unusable(why) => JsonLine::Unusable(UnusableLine { why }),
        Event::Frame { frame, time, alone, image } => {
            JsonLine::Frame(self::frame(client, *frame, *time, *alone, *image == ImageNews::Whole))
        }
        Event::Contacts { frame, time, dropped, released, .. } => JsonLine::Contacts(ContactsLine {
            frame: *frame,
            time_us: time.0,
            contacts: contacts(client, client.contacts()),
            released: contacts(client, released),
            dropped: *dropped,
            force_basis: client.force_basis(),
        }),
        Event::Symbols(list) => JsonLine::Symbols(symbols(client, list)),
        Event::Intent(report) => JsonLine::Intent(intent(client, report)),
        Event::Gesture(report) => JsonLine::Gesture(gesture(client, report)),
        Event::Pressing(report) => JsonLine::Pressing(pressing::line(report, client.newtons())),
        Event::Folds(report) => JsonLine::Folds(FoldsLine {
            frame: report.frame,
            time_us: report.time.0,
            posed_us: report.posed.map(|time| time.0),
            followed: report.followed,
            taxels: report.taxels,
            expected: report.total,
            doubt: report.doubt,
            contacts: report.contacts.iter().map(|it| DoubtLine { id: it.id, doubt: it.doubt }).collect(),
        }),
        Event::Regions(report) => JsonLine::Regions(regions(client, report)),
        Event::Shapes { names, prototypes } => {
            JsonLine::Shapes(ShapesLine { classes: names, prototypes: *prototypes })
        }
        Event::Reaction(report) => JsonLine::Reaction(reaction(report)),
        Event::Reflex(report) => JsonLine::Reflex(reflex(report)),
        Event::Raw { frame, time, whole } => {
            JsonLine::Raw(RawLine { frame: *frame, time_us: time.0, decoded: *whole })
        }
        event => return of_board(client, event),
    })
}

/// The message of an event about the board itself.
fn of_board<'a>(client: &'a Client, event: &'a Event) -> Option<JsonLine<'a>> {
    Some(match event {
        Event::Health(health) => JsonLine::Health(health.into()),
        Event::Budget(budget) => JsonLine::Budget(budget.into()),
        Event::Temperature(measured) => JsonLine::Temperature(TemperatureLine {
            time_us: measured.time.0,
            celsius: measured.celsius.to_f64(),
        }),
        Event::HealthMap { time, whole } => {
            let faulty = client.faulty().iter();
            let faulty =
                faulty.map(|(taxel, health)| FaultyTaxel { taxel: *taxel, health: health.to_string() });
            JsonLine::HealthMap(HealthMapLine { time_us: time.0, whole: *whole, faulty: faulty.collect() })
        }
        Event::SelfTest(report) => JsonLine::SelfTest(self_test(report)),
        Event::Log { time, level, text } | Event::Note { time, level, text } => {
            JsonLine::Log(LogLine { time_us: time.0, level: self::level(*level), text })
        }
        Event::Sync(report) => JsonLine::Sync(SyncLine {
            token: report.token,
            received_us: report.received.0,
            sent_us: report.sent.0,
        }),
        Event::StartOfFrame(start) => JsonLine::StartOfFrame(StartOfFrameLine {
            number: start.number,
            noticed_us: start.noticed.0,
            late_us: start.late_us,
        }),
        Event::Answer { request, refusal } => {
            JsonLine::Answer(AnswerLine { request: request_name(*request), refusal: refusal.as_deref() })
        }
        Event::Refused(error) => JsonLine::Refused(RefusedLine { why: error.to_string() }),
        Event::Lost { why, since_us } => JsonLine::Lost(LostLine { since_us: *since_us, why }),
        Event::Back { how, after } => JsonLine::Back(BackLine { after_s: after.as_secs_f64(), how }),
        Event::Other { why } => JsonLine::Other(OtherLine { why }),
        _ => return None,
    })
}

fn hello(client: &Client) -> Option<HelloLine<'_>> {
    let description = client.description()?;
    let regions = description.layout.regions();
    let panels = description.layout.areas().iter().map(|area| HelloPanel {
        name: area.name.as_str(),
        link: area.link.as_str(),
        region: regions.get(usize::from(area.region)).map_or("", Name::as_str),
        rows: area.rows,
        columns: area.columns,
        pitch_um: area.pitch_um,
    });
    Some(HelloLine {
        time_us: description.clock.0,
        firmware: &description.firmware,
        chip: &description.chip,
        simulated: description.is_simulated(),
        garment: description.garment.name.as_str(),
        scene: description.scene.name.as_str(),
        calibration: &description.calibration,
        boot: description.boot.map(|boot| StartLine {
            cause: boot.cause,
            resets: boot.resets,
            aside: boot.aside,
        }),
        taxels: description.layout.taxels(),
        regions: regions.iter().map(Name::as_str).collect(),
        panels: panels.collect(),
    })
}

fn frame(client: &Client, frame: u32, time: Micros, key: bool, decoded: bool) -> FrameLine<'_> {
    let counts = client.counts();
    let image = client.image().filter(|_| decoded).zip(client.layout()).zip(client.newtons());
    let forces = image.map(|(((_, image), layout), newtons)| newtons.panels(layout, image));
    FrameLine {
        frame,
        time_us: time.0,
        contacts: contacts(client, client.contacts()),
        intent: meaning(client),
        released: client.released(),
        key,
        decoded,
        lost: counts.lost,
        thinned: counts.thinned,
        panels: None,
        force_n: forces.flatten(),
        force_basis: client.force_basis(),
    }
}

fn contacts<'a>(client: &'a Client, list: &[Placed]) -> Vec<ContactLine<'a>> {
    let Some(layout) = client.layout() else { return Vec::new() };
    let contact = |placed: &Placed| {
        let id = placed.contact.id;
        let shape = client.shape_name(placed.shape.class).into();
        let contact = ContactLine::of(placed, layout, shape, client.is_unsure(id));
        ContactLine { form_age: client.form_age(id), force_n: client.force(placed), ..contact }
    };
    list.iter().map(contact).collect()
}

fn meaning(client: &Client) -> MeaningOfTouch {
    MeaningOfTouch::of(client.leading(), client.concepts(), &client.activations())
}

fn intent(client: &Client, report: &IntentReport) -> IntentLine {
    IntentLine {
        frame: report.frame,
        time_us: report.time.0,
        meaning: meaning(client),
        outcome: outcome(report.outcome),
        steps: report.steps,
    }
}

fn symbols<'a>(client: &'a Client, list: &SymbolList) -> SymbolsLine<'a> {
    let event = |symbol: &Symbol| SymbolLine {
        contact: symbol.contact,
        phase: symbol.phase,
        region: client.region_name(symbol.region),
        words: WordsLine {
            strength: symbol.words.strength,
            extent: symbol.words.extent,
            span: symbol.words.span,
            moving: symbol.words.moving,
            shape: client.shape_name(symbol.words.class),
        },
        peak_total: symbol.peak_total,
        duration_ms: symbol.duration_ms,
    };
    let region = |state: &taxel_core::symbol::RegionState| RegionLine {
        region: client.region_name(state.region),
        contacts: state.contacts,
        total: state.total,
        peak: state.peak,
        moving: state.moving,
        since_us: state.since.0,
    };
    SymbolsLine {
        frame: list.frame,
        time_us: list.time.0,
        events: list.events.iter().map(event).collect(),
        regions: list.regions.iter().map(region).collect(),
    }
}

fn regions<'a>(client: &'a Client, report: &RegionsReport) -> RegionsLine<'a> {
    let region = |(number, state): (usize, &RegionSymbol)| SurfaceRegionLine {
        region: client.surface_region(number),
        phase: state.phase,
        way: state.way,
        contacts: state.contacts,
        strength: state.strength,
        extent: state.extent,
        shape: client.shape_name(state.class),
        since_us: state.since.0,
    };
    let regions = report.regions.iter().enumerate().map(region).collect();
    RegionsLine { frame: report.frame, time_us: report.time.0, regions }
}

/// Models are fitted to score 2^18 for the right class and -2^18 for the others.
fn gesture<'a>(client: &'a Client, report: &'a GestureReport) -> GestureLine<'a> {
    GestureLine {
        frame: report.frame,
        time_us: report.time.0,
        touch: report.touch,
        panel: client.panel_name(report.panel),
        name: report.name.as_str(),
        score: f64::from(report.score) / f64::from(1 << 18),
        lead: f64::from(report.lead) / f64::from(1 << 18),
        observed_ms: report.observed_ms,
        ended: report.ended,
        confidence: report.confidence.map(Q15::to_f64),
    }
}

fn reaction(report: &ReactionReport) -> ReactionLine<'_> {
    ReactionLine {
        frame: report.frame,
        time_us: report.time.0,
        index: report.reaction.index,
        name: report.reaction.name.as_str(),
        active: report.reaction.active,
        value: report.reaction.value,
    }
}

fn reflex(report: &ReflexReport) -> ReflexLine {
    ReflexLine {
        frame: report.frame,
        other: report.other,
        index: report.index,
        taxel: report.taxel,
        value: report.value,
        time_us: report.time.0,
    }
}

fn self_test(report: &SelfTestReport) -> SelfTestLine<'_> {
    let findings = &report.findings;
    let faults = findings.faults.iter();
    SelfTestLine {
        time_us: report.time.0,
        lines: findings.lines,
        inputs: findings.inputs,
        faults: faults.map(|found| PinFaultLine { pin: found.pin, fault: &found.fault }).collect(),
    }
}

fn outcome(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Fixed => "fixed",
        Outcome::Cycle(_) => "cycle",
        Outcome::Unsettled => "unsettled",
    }
}

fn level(level: Level) -> &'static str {
    match level {
        Level::Info => "info",
        Level::Warn => "warn",
        Level::Error => "error",
    }
}
