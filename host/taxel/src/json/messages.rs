//! JSON output: one message per line, each with its `type`.
//!
//! A line of type `frame` holds what `taxel process` prints for a frame: the present contacts, the released
//! ones (`released`) and the intention; and the counts of lost and thinned messages so far. `time_us` is the
//! board's time. For a real-time board (serial port, TCP) a line also has `host_time_us`, the host's time of
//! the message in microseconds since 1970, and `host_time_uncertainty_us`, the bound of its error, once the
//! board has answered a `Sync`. Nothing else in a line depends on the host's time.

use crate::client::{Client, Event, ImageNews, request_name};
use crate::error::{Error, Result};
use crate::files::calibrate::{Calibration, Forces};
use crate::json;
use crate::session::Show;
use serde_json::{Value, json};
use std::io::Write;
use taxel_core::body::Placed;
use taxel_core::format::Micros;
use taxel_core::health::TaxelHealth;
use taxel_core::shape::Class;
use taxel_core::wire::{GestureReport, SelfTestReport, Temperature};

/// Prints messages as JSON.
pub struct MessagePrinter<W> {
    pixels: bool,
    calibration: Option<Calibration>,
    out: W,
}

impl<W: Write> MessagePrinter<W> {
    /// Output with or without the pressure of every taxel.
    pub fn new(pixels: bool, out: W) -> MessagePrinter<W> {
        MessagePrinter { pixels, calibration: None, out }
    }

    /// Adds the force on each panel (`force_n`, in the order of `panels`) and of each contact while the board
    /// uses this calibration.
    pub fn calibrated(self, calibration: Option<Calibration>) -> MessagePrinter<W> {
        MessagePrinter { calibration, ..self }
    }
}

impl<W: Write, E: From<Error>> Show<E> for MessagePrinter<W> {
    fn event(&mut self, client: &Client, event: &Event) -> Result<(), E> {
        let mut line = message(client, event);
        if let (true, Event::Frame { image: ImageNews::Whole, .. }) = (self.pixels, event) {
            line["panels"] = pixels(client);
        }
        if let (Some(calibration), Event::Frame { image: ImageNews::Whole, .. }) = (&self.calibration, event)
            && let Some([panels, contacts]) = forces(client, calibration)
        {
            line["force_n"] = json!(panels);
            for (index, force) in contacts.iter().enumerate() {
                line["contacts"][index]["force_n"] = json!(force);
            }
        }
        let board = line.get("time_us").and_then(Value::as_u64);
        if let Some(time) = board.and_then(|board| client.host_time(Micros(board))) {
            line["host_time_us"] = json!(time.us);
            line["host_time_uncertainty_us"] = json!(time.uncertainty_us);
        }
        Ok(writeln!(self.out, "{line}").map_err(Error::from)?)
    }

    fn idle(&mut self, _: &mut Client) -> Result<bool, E> {
        self.out.flush().map_err(Error::from)?;
        Ok(true)
    }

    fn end(&mut self, _: &Client) -> Result<(), E> {
        Ok(self.out.flush().map_err(Error::from)?)
    }
}

/// Encodes one event as a JSON object.
pub fn message(client: &Client, event: &Event) -> Value {
    match event {
        Event::Hello => hello(client),
        Event::Unusable(why) => json!({ "type": "unusable", "why": why }),
        Event::Frame { frame, time, alone, image } => {
            let counts = client.counts();
            let whole = *image == ImageNews::Whole;
            let mut line = at("frame", *frame, *time);
            merge(
                &mut line,
                json!({ "contacts": contacts(client, client.contacts()), "intent": intent(client) }),
            );
            if !client.released().is_empty() {
                line["released"] = json!(client.released());
            }
            let line_of =
                json!({ "key": alone, "decoded": whole, "lost": counts.lost, "thinned": counts.thinned });
            merge(&mut line, line_of);
            line
        }
        Event::Contacts { frame, time, dropped, released } => {
            let mut line = at("contacts", *frame, *time);
            let gone = contacts(client, released);
            let here = contacts(client, client.contacts());
            merge(&mut line, json!({ "contacts": here, "released": gone, "dropped": dropped }));
            line
        }
        Event::Intent(report) => {
            let mut line = at("intent", report.frame, report.time);
            merge(
                &mut line,
                json!({ "intent": intent(client), "outcome": word(&report.outcome), "steps": report.steps }),
            );
            line
        }
        Event::Reaction(report) => {
            let mut line = at("reaction", report.frame, report.time);
            merge(&mut line, serde_json::to_value(&report.reaction).unwrap_or_default());
            line
        }
        Event::Reflex(report) => {
            let mut line = json!({ "type": "reflex" });
            merge(&mut line, serde_json::to_value(report).unwrap_or_default());
            rename_time(&mut line);
            line
        }
        Event::Raw { frame, time, whole } => {
            let mut line = at("raw", *frame, *time);
            line["decoded"] = json!(whole);
            line
        }
        event => small(client, event),
    }
}

/// Encodes the less frequent events.
fn small(client: &Client, event: &Event) -> Value {
    match event {
        Event::Symbols(list) => {
            let mut line = at("symbols", list.frame, list.time);
            let each = |value: Value, region: u8| named(client, value, region);
            let value = |value: serde_json::Result<Value>| value.unwrap_or_default();
            let events: Vec<_> =
                list.events.iter().map(|e| each(value(serde_json::to_value(e)), e.region)).collect();
            let regions: Vec<_> =
                list.regions.iter().map(|r| each(value(serde_json::to_value(r)), r.region)).collect();
            merge(&mut line, json!({ "events": events, "regions": regions }));
            line
        }
        Event::Gesture(report) => gesture(client, report),
        Event::Confidence(report) => {
            let mut line = at("confidence", report.frame, report.time);
            merge(&mut line, json!({ "touch": report.touch, "confidence": report.confidence.to_f64() }));
            line
        }
        Event::Forms(report) => {
            let mut line = at("forms", report.frame, report.time);
            let of = |(contact, age): &(u32, u8)| json!({ "contact": contact, "age": age });
            line["ages"] = report.ages.iter().map(of).collect();
            line
        }
        Event::Unsure(report) => {
            let mut line = at("unsure", report.frame, report.time);
            line["contacts"] = json!(report.contacts);
            line
        }
        Event::Shapes { names, prototypes } => {
            json!({ "type": "shapes", "classes": names, "prototypes": prototypes })
        }
        Event::Health(health) => {
            let mut line = json!({ "type": "health" });
            merge(&mut line, serde_json::to_value(health).unwrap_or_default());
            rename_time(&mut line);
            line
        }
        Event::Budget(budget) => {
            let mut line = json!({ "type": "budget" });
            merge(&mut line, serde_json::to_value(budget).unwrap_or_default());
            rename_time(&mut line);
            line
        }
        Event::Temperature(Temperature { time, celsius }) => {
            json!({ "type": "temperature", "time_us": time.0, "celsius": celsius.to_f64() })
        }
        Event::HealthMap { time, whole } => {
            let ill = |(taxel, health): (&u16, &TaxelHealth)| json!({ "taxel": taxel, "health": health.to_string() });
            let ill: Vec<_> = client.ill().iter().map(ill).collect();
            json!({ "type": "health_map", "time_us": time.0, "whole": whole, "ill": ill })
        }
        Event::SelfTest(report) => self_test(report),
        Event::Boot(boot) => {
            let mut line = json!({ "type": "boot" });
            merge(&mut line, serde_json::to_value(boot).unwrap_or_default());
            line
        }
        Event::Log { time, level, text } => {
            json!({ "type": "log", "time_us": time.0, "level": word(level), "text": text })
        }
        Event::Sync(report) => {
            json!({ "type": "sync", "token": report.token, "received_us": report.received.0, "sent_us": report.sent.0 })
        }
        Event::Answer { request, refusal } => {
            json!({ "type": "answer", "request": request_name(*request), "refusal": refusal })
        }
        Event::Refused(error) => json!({ "type": "refused", "why": error.to_string() }),
        _ => Value::Null,
    }
}

fn self_test(report: &SelfTestReport) -> Value {
    let mut line = json!({ "type": "self_test", "time_us": report.time.0 });
    merge(&mut line, serde_json::to_value(&report.findings).unwrap_or_default());
    line
}

/// Encodes a gesture. Models are fitted to score 2^18 for the right class and -2^18 for the others.
fn gesture(client: &Client, report: &GestureReport) -> Value {
    let mut line = at("gesture", report.frame, report.time);
    let more = json!({
        "touch": report.touch,
        "panel": client.panel_name(report.panel),
        "class": report.name,
        "score": f64::from(report.score) / f64::from(1 << 18),
        "lead": f64::from(report.lead) / f64::from(1 << 18),
        "observed_ms": report.observed_ms,
        "ended": report.ended,
    });
    merge(&mut line, more);
    if let Some(confidence) = client.confidence(report) {
        line["confidence"] = json!(confidence.to_f64());
    }
    line
}

fn at(kind: &str, frame: u32, time: Micros) -> Value {
    json!({ "type": kind, "frame": frame, "time_us": time.0 })
}

fn merge(line: &mut Value, more: Value) {
    if let (Value::Object(line), Value::Object(more)) = (line, more) {
        line.extend(more);
    }
}

/// Renames `time` to `time_us`, its unit.
fn rename_time(line: &mut Value) {
    if let Some(time) = line.as_object_mut().and_then(|line| line.remove("time")) {
        line["time_us"] = time;
    }
}

/// Replaces the numbers of region and shape by their names.
fn named(client: &Client, mut value: Value, region: u8) -> Value {
    value["region"] = json!(client.region_name(region));
    if let Some(class) = value.pointer_mut("/words/class") {
        let known = class.as_u64().and_then(|c| u8::try_from(c).ok()).unwrap_or(0);
        *class = json!(client.shape_name(Class(known)));
    }
    value
}

fn word(value: &impl std::fmt::Debug) -> String {
    format!("{value:?}").split([' ', '(', '{']).next().unwrap_or_default().to_lowercase()
}

fn contacts(client: &Client, list: &[Placed]) -> Value {
    let Some(layout) = client.layout() else { return json!([]) };
    let contact = |placed: &Placed| {
        let mut contact = json::contact(placed, layout, client.is_unsure(placed.contact.id));
        contact["shape"] = json!(client.shape_name(placed.shape.class));
        if let Some(age) = client.form_age(placed.contact.id) {
            contact["form_age"] = json!(age);
        }
        contact
    };
    list.iter().map(contact).collect()
}

fn intent(client: &Client) -> Value {
    json::intent(client.leading(), client.concepts(), &client.activations())
}

fn hello(client: &Client) -> Value {
    let Some(worn) = client.worn() else { return Value::Null };
    let regions = worn.layout.regions();
    let region =
        |a: &taxel_core::garment::Area| regions.get(usize::from(a.region)).map_or("", |name| name.as_str());
    let panel = |a: &taxel_core::garment::Area| {
        json!({
            "name": a.name, "link": a.link, "region": region(a), "rows": a.rows, "columns": a.columns,
            "pitch_um": a.pitch_um,
        })
    };
    json!({
        "type": "hello",
        "time_us": worn.clock.0,
        "firmware": worn.firmware,
        "garment": worn.garment.name,
        "scene": worn.scene.name,
        "calibration": worn.calibration,
        "taxels": worn.layout.taxels(),
        "regions": regions,
        "panels": worn.layout.areas().iter().map(panel).collect::<Vec<_>>(),
    })
}

/// Forces on each panel and of each contact, N; none if the board uses another calibration.
fn forces(client: &Client, calibration: &Calibration) -> Option<[Vec<Option<f64>>; 2]> {
    let (worn, (_, image)) = (client.worn()?, client.image()?);
    let meter =
        Forces::new(calibration, &worn.layout).ok().filter(|_| calibration.is_in_force(&worn.calibration))?;
    let contact = |placed: &Placed| meter.contact(&worn.layout, image, &placed.contact.bounds);
    Some([meter.panels(&worn.layout, image), client.contacts().iter().map(contact).collect()])
}

/// Pressures of the image by panel and row.
fn pixels(client: &Client) -> Value {
    let (Some(layout), Some((_, image))) = (client.layout(), client.image()) else { return json!([]) };
    let panel = |area: &taxel_core::garment::Area| {
        let start = usize::from(area.base);
        let length = usize::from(area.rows) * usize::from(area.columns);
        let values = image.get(start..start + length).unwrap_or(&[]);
        json!({ "name": area.name, "rows": values.chunks(usize::from(area.columns)).collect::<Vec<_>>() })
    };
    layout.areas().iter().map(panel).collect()
}
