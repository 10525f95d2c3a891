//! Hands a board's stream to the node.

use super::concepts::Concepts;
use super::links::Links;
use super::node::RosNode;
use super::panels::Panels;
use super::posture::Postures;
use super::services::Services;
use crate::fault::own as own_error;
use anyhow::Result;
use ros2_client::log::LogLevel;
use serde_json::Value;
use std::time::{Duration, Instant};
use taxel::body::ReadBody;
use taxel::client::{Client, Event, ImageNews, Stamp, Stamps};
use taxel::json;
use taxel::ros2::messages::{self, DiagnosticState};
use taxel::ros2::own;
use taxel::ros2::topics::{CLOCK, CONTACTS, DIAGNOSTICS, FRAMES, HEALTH, INTENT, JSON, REACTIONS, SYMBOLS};
use taxel::session::{JointTime, Observer, Posing};
use taxel::source::Source;
use taxel_core::fold::Posture;
use taxel_core::format::Micros;
use taxel_core::wire::Request;

/// Time between two diagnostics of a lost board.
const PERIOD: Duration = Duration::from_secs(1);
/// Number of the request that sends the board poses.
const SET_POSES: u8 = Request::SetPoses(&[]).number();

/// Publishes a board's stream, and passes on what comes for the board.
pub struct RosShow {
    node: RosNode,
    /// Times of messages, whose inverse those of joints need.
    stamps: Stamps,
    /// The board's time is ROS's.
    is_clock: bool,
    panels: Panels,
    links: Links,
    /// Frame of the robot's base; empty without a robot.
    base: String,
    concepts: Concepts,
    /// Messages that it takes from others; none before the board's source is open.
    taken: Option<Taken>,
    /// Reason why the board is lost, and when that was reported last.
    lost: Option<(String, Instant)>,
}

/// Messages that a node takes for its board: positions of joints, and calls of services.
struct Taken {
    postures: Postures,
    services: Services,
}

impl RosShow {
    /// Makes the show of this node's board. With `is_clock`, stamps are the board's time, which is reported on
    /// `/clock`. With a body, what presses on its links is reported.
    pub fn new(node: RosNode, is_clock: bool, body: Option<ReadBody>) -> RosShow {
        RosShow {
            stamps: Stamps::start(),
            is_clock,
            panels: Panels::new(),
            links: Links::new(body),
            base: String::new(),
            concepts: Concepts::default(),
            taken: None,
            lost: None,
            node,
        }
    }

    /// Offers everything: topics and services of a board that is not there yet are not.
    fn offer(&mut self, source: &Source) -> Result<()> {
        for topic in [CONTACTS, SYMBOLS, REACTIONS, INTENT, HEALTH, JSON, FRAMES, DIAGNOSTICS] {
            self.node.offer(&topic, "")?;
        }
        if self.is_clock {
            self.node.offer(&CLOCK, "")?;
        }
        let deaf = (!source.listens).then(|| source.label.clone());
        let postures = Postures::open(&mut self.node)?;
        self.taken = Some(Taken { postures, services: Services::open(&mut self.node, deaf)? });
        Ok(())
    }

    /// Time of a message, us.
    fn us(&self, stamp: Stamp) -> u64 {
        if self.is_clock { stamp.board_us } else { stamp.host_us }
    }

    /// Publishes an event's own messages.
    fn publish(&mut self, client: &Client, event: &Event, us: u64, board_us: u64) -> Result<()> {
        let node = &mut self.node;
        match event {
            Event::Hello => {
                self.links.offer(node, client)?;
                self.panels.offer(node, client, us, self.links.surface())?;
                self.concepts.offer(node, client)
            }
            Event::Frame { image: ImageNews::Whole, .. } => self.panels.image(node, client, us, board_us),
            Event::Contacts { frame, dropped, released, .. } => {
                let list_of = (*frame, *dropped);
                let on = self.links.surface().map(AsRef::as_ref);
                let message = own::contacts(node.board(), us, client, list_of, released, on);
                node.publish(&CONTACTS, "", message)
            }
            Event::Pressing(report) => self.links.report(node, report, us, &self.base),
            Event::Regions(report) => self.links.regions(node, client, report, us),
            Event::Symbols(list) => node.publish(&SYMBOLS, "", own::symbols(us, client, list)),
            Event::Reaction(report) => node.publish(&REACTIONS, "", own::reaction(us, report)),
            Event::Intent(report) => node.publish(&INTENT, "", own::intent(us, client, report)),
            Event::Health(health) => {
                node.publish(&HEALTH, "", own::health(us, client, health))?;
                let firmware = client.description().map_or("", |description| description.firmware.as_str());
                let state = DiagnosticState::Reports(health, client.faulty().len());
                let reported = messages::diagnostics(node.board(), us, firmware, state);
                node.publish(&DIAGNOSTICS, "", reported)
            }
            Event::Lost { why, .. } => {
                self.panels.still(node, us)?;
                self.lost = Some((why.clone(), Instant::now()));
                self.stale(client)
            }
            Event::Back { .. } => {
                self.lost = None;
                Ok(())
            }
            Event::Answer { request, refusal } => {
                if let Some(taken) = &mut self.taken {
                    taken.services.answered(*request, refusal.as_deref());
                    if *request == Request::Posture(Posture::default()).number() {
                        taken.postures.answered(node, client, refusal.is_none())?;
                    }
                }
                if let (SET_POSES, Some(why)) = (*request, refusal) {
                    node.log(LogLevel::Warn, &format!("the board refuses poses: {why}"));
                }
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// Says that the board is lost.
    fn stale(&mut self, client: &Client) -> Result<()> {
        let stamp = self.stamps.now(client);
        let us = self.us(stamp);
        let Some((why, reported)) = &mut self.lost else { return Ok(()) };
        *reported = Instant::now();
        let firmware = client.description().map_or("", |description| description.firmware.as_str());
        let message = messages::diagnostics(self.node.board(), us, firmware, DiagnosticState::Lost(why));
        self.node.publish(&DIAGNOSTICS, "", message)
    }

    /// Publishes an event.
    fn take(&mut self, client: &Client, event: &Event) -> Result<()> {
        if let Some(remark) = event.remark() {
            self.node.log(LogLevel::Warn, remark);
        }
        let stamp = self.stamps.of(client, event);
        if self.is_clock {
            self.node.publish(&CLOCK, "", messages::clock(stamp.board_us))?;
        }
        self.publish(client, event, self.us(stamp), stamp.board_us)?;
        let is_line = !matches!(event, Event::Frame { .. } | Event::Raw { .. } | Event::Refused(_));
        if is_line && self.node.wants(&JSON, "") {
            let mut line = json::message(client, event);
            if line != Value::Null {
                stamp.mark(&mut line);
                self.node.publish(&JSON, "", messages::text(&line.to_string()))?;
            }
        }
        Ok(())
    }

    /// Passes on what has come for the board.
    fn turn(&mut self, client: &mut Client) -> Result<()> {
        if self.lost.as_ref().is_some_and(|(_, reported)| reported.elapsed() >= PERIOD) {
            self.stale(client)?;
        }
        if let Some(taken) = &mut self.taken {
            taken.services.turn(&self.node, client)?;
            taken.postures.turn(client)?;
        }
        self.concepts.turn(&self.node, client)?;
        Ok(())
    }
}

impl Observer for RosShow {
    fn opened(&mut self, source: &Source) -> taxel::Result<()> {
        self.offer(source).map_err(own_error)
    }

    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        self.take(client, event).map_err(own_error)
    }

    fn pose(&mut self, client: &Client, posing: &mut Posing) -> taxel::Result<()> {
        if self.base.is_empty() {
            self.base = posing.base().into();
        }
        // The inverse of the stamps of what is published.
        let time = |us| match self.is_clock {
            true => JointTime::Board(Micros(us)),
            false => self.stamps.board_time(client, us).map_or(JointTime::Host(us), JointTime::Board),
        };
        if let Some(taken) = &mut self.taken {
            taken.postures.pose(&self.node, client, posing, time);
        }
        Ok(())
    }

    fn idle(&mut self, client: &mut Client) -> taxel::Result<()> {
        self.turn(client).map_err(own_error)
    }
}
