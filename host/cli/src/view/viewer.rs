//! Passes a board's stream to the pages.

use super::hand::PageHand;
use super::hub::PageHub;
use super::lines::{EndLine, PageFrame};
use super::message;
use super::raw::RawCodes;
use super::said::{EventLines, Said};
use super::setup::PageSetup;
use super::shot::{Shot, text};
use super::tape::Tape;
use crate::fault::own;
use crate::folding::Folding;
use crate::watch::rate::Rate;
use anyhow::Result;
use std::sync::Arc;
use std::time::Duration;
use taxel::client::{Client, Event, ImageNews, Stamp};
use taxel::files::calibrate::Calibration;
use taxel::json;
use taxel::record::Origin;
use taxel::session::{JointPositions, Observer};
use taxel::source::Source;
use taxel::time::Instant;
use taxel_core::format::Micros;
use taxel_core::wire::Request;

/// Time between two messages about the link.
const LINK: Duration = Duration::from_millis(250);
/// Time between two latency measurements.
const ROUND: Duration = Duration::from_secs(1);

/// Shows a stream to the pages of a hub.
pub struct Viewer {
    hub: Arc<PageHub>,
    label: String,
    calibration: Option<Calibration>,
    /// Folds of the garment; none without a table.
    folding: Option<Folding>,
    lines: EventLines,
    setup: PageSetup,
    rate: Rate,
    raw: RawCodes,
    sent: Instant,
    /// True if it asks the board what only pages want to know: round trips, raw codes.
    is_curious: bool,
    asked: Instant,
    token: u32,
    /// Half of the last round trip to the board.
    latency: Option<Duration>,
    /// Number and time of the last image.
    last: (u32, Micros),
}

impl Viewer {
    /// A viewer for the pages of a hub, which can save the stream with this calibration.
    pub fn new(hub: Arc<PageHub>, calibration: Option<Calibration>) -> Viewer {
        let now = Instant::now();
        Viewer {
            hub,
            label: String::new(),
            calibration,
            folding: None,
            lines: EventLines::default(),
            setup: PageSetup::default(),
            rate: Rate::default(),
            raw: RawCodes::default(),
            sent: now,
            is_curious: true,
            asked: now,
            token: 0,
            latency: None,
            last: (0, Micros(0)),
        }
    }

    /// Shows what somebody else records, who must get the stream as if nobody watched: the board is asked
    /// nothing but a tare that somebody at a page wants.
    pub fn beside_recording(self) -> Viewer {
        Viewer { is_curious: false, ..self }
    }

    /// Shows where the garment folds, too.
    pub fn folding(self, folding: Option<Folding>) -> Viewer {
        Viewer { folding, ..self }
    }

    fn show(&mut self, client: &Client, event: &Event) -> Result<()> {
        match event {
            Event::Hello => self.hello(client)?,
            Event::Frame { frame, time, image: ImageNews::Whole, .. } => {
                self.last = (*frame, *time);
                self.frame(client, event, *time);
            }
            Event::Lost { .. } => self.lost(client, event),
            Event::Back { .. } | Event::Other { .. } => self.hub.forget("lost"),
            Event::Raw { frame, whole: true, .. } => self.hub.codes(*frame, client.raw()),
            Event::Health(_) => self.hub.state("health", &json::message(client, event)),
            Event::HealthMap { .. } => self.hub.state("health_map", &json::message(client, event)),
            Event::SelfTest(report) => self.hub.state("pins", &message::pins(client, &report.findings)),
            Event::Budget(_) => self.hub.state("budget", &json::message(client, event)),
            Event::Pressing(report) => self.hub.heard(report),
            Event::Sync(report) if report.token == self.token => {
                self.latency = Some(self.asked.elapsed() / 2)
            }
            _ => {}
        }
        // What is recorded is set by nobody at a page.
        if self.is_curious && self.setup.heard(event) {
            self.show_setup(client);
        }
        for said in self.lines.narrate(client, event) {
            self.hub.say(&said);
        }
        Ok(())
    }

    fn frame(&mut self, client: &Client, event: &Event, time: Micros) {
        self.rate.add(time);
        if let Some(line) = self.folding.as_mut().and_then(|folding| folding.news(time.0)) {
            self.hub.state("folding", line);
        }
        let Some((_, image)) = client.image().filter(|_| self.hub.pages() > 0) else { return };
        let Some(line) = message::frame(client, event) else { return };
        let shown_robot = self.hub.shown_robot();
        let pressing = shown_robot.as_ref().and_then(|shown_robot| shown_robot.pressing(client, time));
        let line = text(&PageFrame { pressing, ..line });
        let total = client.contacts().iter().fold(0u32, |sum, p| sum.saturating_add(p.contact.total));
        self.hub.shot(&Shot { line, image: image.into(), time_us: time.0, total });
    }

    /// Shows that the board is lost, and nothing of what touched it: an image of nothing follows the last one.
    fn lost(&mut self, client: &Client, event: &Event) {
        self.hub.state("lost", &json::message(client, event));
        self.hub.forget_images();
        let (frame, time) = (self.last.0, Micros(self.last.1.0 + 1));
        let nothing = Event::Frame { frame, time, alone: true, image: ImageNews::NoBase };
        let line = message::frame(client, &nothing);
        let Some((line, layout)) = line.zip(client.layout()) else { return };
        let image = vec![0; layout.taxels()].into();
        self.hub.shot(&Shot { line: text(&line), image, time_us: time.0, total: 0 });
    }

    fn hello(&mut self, client: &Client) -> Result<()> {
        self.hub.greet(client, &self.label);
        if let (Some(folding), Some(description)) = (&mut self.folding, client.description()) {
            folding.use_garment(description)?;
        }
        self.hub.dress(client)
    }

    fn show_setup(&self, client: &Client) {
        let line = self.setup.line(client, self.hub.is_read_only());
        line.iter().for_each(|line| self.hub.state("setup", line));
    }

    fn link(&mut self, client: &Client) {
        let latency = self.latency.or_else(|| client.round_trip().map(|trip| trip / 2));
        let line = message::link(client, self.rate.hz(), latency, self.hub.pages());
        self.hub.state("link", &line);
    }
}

impl Observer for Viewer {
    fn opened(&mut self, source: &Source) -> taxel::Result<()> {
        source.hand.iter().for_each(|hand| self.hub.hand(PageHand::new(hand.clone())));
        self.label.clone_from(&source.label);
        self.lines = EventLines::default();
        let scale = source.scale.with(self.calibration.as_ref());
        let origin = Origin { label: source.label.clone(), scale };
        self.hub.tape(Tape::Live(Arc::new(origin)));
        Ok(())
    }

    fn sent(&mut self, client: &Client, requests: &[u8], _: Stamp) -> taxel::Result<()> {
        self.folding.iter_mut().for_each(|folding| folding.asked(client, requests));
        Ok(())
    }

    fn joints(&mut self, _: &Client, taken: &JointPositions, _: Stamp) -> taxel::Result<()> {
        // Cloth that slides off its panel is no reason to show nothing any more.
        if let Err(error) = self.hub.joints(&taken.positions) {
            self.hub.say(&Said::note(format!("{error:#}")));
        }
        Ok(())
    }

    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        self.hub.keep(client, event);
        match self.show(client, event) {
            // What is recorded is what would be without pages.
            Err(error) if !self.is_curious => {
                self.hub.say(&Said::note(format!("{error:#}")));
                Ok(())
            }
            shown => shown.map_err(own),
        }
    }

    fn follows_another(&self) -> bool {
        true
    }

    fn idle(&mut self, client: &mut Client) -> taxel::Result<()> {
        let now = Instant::now();
        if self.is_curious
            && client.description().is_some()
            && now.saturating_duration_since(self.asked) > ROUND
        {
            self.token = self.token.wrapping_add(1);
            client.request(&Request::Sync { token: self.token })?;
            self.asked = now;
        }
        if let Some(frames) = self.hub.tare() {
            client.request(&Request::Tare { frames })?;
            self.hub.say(&Said::note(format!("tare over {frames} frames")));
        }
        for order in self.hub.settings().into_iter().filter(|_| self.is_curious) {
            self.setup.obey(order, client)?;
            self.show_setup(client);
        }
        if self.is_curious {
            self.raw.tend(client, self.hub.is_looked_at(), now)?;
        }
        if now.saturating_duration_since(self.sent) >= LINK {
            self.sent = now;
            self.hub.announce_hand();
            self.link(client);
        }
        Ok(())
    }

    fn ended(&mut self, client: &Client, _: Stamp) -> taxel::Result<()> {
        self.link(client);
        self.hub.state("end", &EndLine { text: format!("{} has ended", self.label) });
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::mailbox::Parcel;
    use super::*;
    use serde_json::Value;
    use taxel::source::{self, SourceOptions};

    #[test]
    fn a_lost_page_shows_no_touch() {
        let source = source::open(&"sim:press".parse().unwrap(), &SourceOptions::default()).unwrap();
        let hub = Arc::new(PageHub::default());
        let (mut viewer, page) = (Viewer::new(hub.clone(), None), hub.join().unwrap());
        viewer.opened(&source).unwrap();
        let mut session = taxel::session::Session::over(source).unwrap();
        let shown = |page: &super::super::mailbox::Mailbox| {
            let Some(Parcel::Image(bytes)) = page.take() else { panic!("no image") };
            let (head, rest) =
                bytes[4..].split_at(u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize);
            let head: Value = serde_json::from_slice(head).unwrap();
            (head["frame"].clone(), rest[..rest.len() / 2].iter().any(|byte| *byte > 0))
        };
        let stamp = Stamp { board_us: 0, host_us: 0, uncertainty_us: None };
        while session.client().contacts().is_empty() {
            let event = session.wait().unwrap().expect("it presses");
            viewer.event(session.client(), &event, stamp).unwrap();
        }
        while let Some(event) = session.wait().unwrap() {
            viewer.event(session.client(), &event, stamp).unwrap();
            if matches!(event, Event::Frame { .. }) {
                break;
            }
        }
        let (before, presses) = shown(&page);
        assert!(presses && !before["contacts"].as_array().unwrap().is_empty(), "{before}");
        session.parts().0.lost("it is gone".into(), 5);
        while let Some(event) = session.note() {
            viewer.event(session.client(), &event, stamp).unwrap();
        }
        let (frame, presses) = shown(&page);
        assert!(!presses && frame["contacts"].as_array().unwrap().is_empty(), "{frame}");
        assert_eq!(
            (&frame["intent"]["leading"], frame["time_us"].as_u64()),
            (&"none".into(), before["time_us"].as_u64().map(|us| us + 1))
        );
        let lines: Vec<_> = std::iter::from_fn(|| page.line_now()).collect();
        let says =
            |parcel: &Parcel| matches!(parcel, Parcel::Line(line) if line.contains("\"type\":\"lost\""));
        assert!(lines.iter().any(says), "{lines:?}");
    }
}
