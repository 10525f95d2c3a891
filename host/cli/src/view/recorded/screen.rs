//! Shows moments of a recording to the pages of a hub.

use crate::folding::Folding;
use crate::view::hub::PageHub;
use crate::view::lines::PageFrame;
use crate::view::message;
use crate::view::said::Said;
use crate::view::shot::{Shot, text};
use crate::watch::rate::Rate;
use std::sync::Arc;
use taxel::client::{Client, Event, ImageNews};
use taxel::json;
use taxel_core::format::Micros;

/// Messages to the pages.
pub struct PageScreen {
    hub: Arc<PageHub>,
    label: String,
    /// Folds of the garment; none without a table.
    folding: Option<Folding>,
    rate: Rate,
    /// Number and time of the last image.
    last: (u32, Micros),
}

impl PageScreen {
    /// Shows a recording with this label.
    pub fn new(hub: Arc<PageHub>, label: String, folding: Option<Folding>) -> PageScreen {
        PageScreen { hub, label, folding, rate: Rate::default(), last: (0, Micros(0)) }
    }

    /// Shows another moment and its afterglow; earlier messages are no longer valid.
    pub fn moment(&mut self, client: &Client, glow: &[u16], at: u64, event: &Event, seeks: u32) {
        self.hub.forget_images();
        self.rate = Rate::default();
        self.hello(client);
        let states = [
            ("health", client.health().map(|health| Event::Health(*health))),
            ("budget", client.budget().map(|budget| Event::Budget(*budget))),
            ("pins", client.self_test().map(|report| Event::SelfTest(report.clone()))),
            ("health_map", Some(Event::HealthMap { time: Micros(0), whole: true })),
        ];
        for (kind, sent) in states {
            match sent {
                Some(event) => self.state(client, &event),
                None => self.hub.forget(kind),
            }
        }
        self.hub.forget("taxel");
        if let Event::Frame { time, .. } = event {
            self.hub.state("glow", &message::glow(glow, *time, seeks));
        }
        self.image(client, at, event, seeks);
        self.link(client);
    }

    /// Shows the next event.
    pub fn event(&mut self, client: &Client, at: u64, event: &Event, seeks: u32) {
        match event {
            Event::Hello => self.hello(client),
            Event::Frame { .. } => self.image(client, at, event, seeks),
            Event::Lost { .. } => self.nothing(client, at, seeks),
            Event::Raw { frame, whole: true, .. } => self.hub.codes(*frame, client.raw()),
            Event::Pressing(report) => self.hub.heard(report),
            event => self.state(client, event),
        }
    }

    fn image(&mut self, client: &Client, at: u64, event: &Event, seeks: u32) {
        let Event::Frame { frame, time, image: ImageNews::Whole, .. } = event else { return };
        self.last = (*frame, *time);
        let Some((_, image)) = client.image() else { return };
        self.rate.add(*time);
        if let Some(line) = self.folding.as_mut().and_then(|folding| folding.news(time.0)) {
            self.hub.state("folding", line);
        }
        let total = client.contacts().iter().fold(0u32, |sum, p| sum.saturating_add(p.contact.total));
        let Some(line) = message::frame(client, event) else { return };
        let shown_robot = self.hub.shown_robot();
        let pressing = shown_robot.as_ref().and_then(|shown_robot| shown_robot.pressing(client, *time));
        let line = text(&PageFrame { at_us: Some(at), seeks: Some(seeks), pressing, ..line });
        self.hub.show(Shot { line, image: image.into(), time_us: time.0, total });
    }

    /// Shows an image of nothing after the last one: the board is lost.
    fn nothing(&self, client: &Client, at: u64, seeks: u32) {
        let (frame, time) = (self.last.0, Micros(self.last.1.0 + 1));
        let nothing = Event::Frame { frame, time, alone: true, image: ImageNews::NoBase };
        let line = message::frame(client, &nothing);
        let Some((line, layout)) = line.zip(client.layout()) else { return };
        let line = text(&PageFrame { at_us: Some(at), seeks: Some(seeks), ..line });
        self.hub.show(Shot { line, image: vec![0; layout.taxels()].into(), time_us: time.0, total: 0 });
    }

    fn hello(&mut self, client: &Client) {
        self.hub.greet(client, &self.label);
        let folds = match (&mut self.folding, client.description()) {
            (Some(folding), Some(description)) => folding.use_garment(description),
            _ => Ok(()),
        };
        for error in [folds.err(), self.hub.dress(client).err()].into_iter().flatten() {
            self.hub.say(&Said::note(format!("{error:#}")));
        }
    }

    fn state(&self, client: &Client, event: &Event) {
        match event {
            Event::Health(_) => self.hub.state("health", &json::message(client, event)),
            Event::HealthMap { .. } => self.hub.state("health_map", &json::message(client, event)),
            Event::SelfTest(report) => self.hub.state("pins", &message::pins(client, &report.findings)),
            Event::Budget(_) => self.hub.state("budget", &json::message(client, event)),
            _ => {}
        }
    }

    /// Reports the rate of images, in board time.
    pub fn link(&self, client: &Client) {
        self.hub.state("link", &message::link(client, self.rate.hz(), None, self.hub.pages()));
    }
}
