//! ROS 2 messages of a board's stream, in a file beside the recording (`NAME.ros2.mcap`), so that `ros2 bag
//! play` and RViz read them without a node of ours.
//!
//! | topic | message | what |
//! |---|---|---|
//! | `/tactile/PANEL/image` | sensor_msgs/Image, mono16 | pressure, counts |
//! | `/tactile/PANEL/points` | sensor_msgs/PointCloud2 | x, y, z in m on the panel, pressure in counts; if the pitch is known. With a body on the panel's link, with normals |
//! | `/tactile/PANEL/wrench` | geometry_msgs/WrenchStamped | normal force, N, and its moment about the first taxel, N m; if counts per newton are known |
//! | `/tactile/links/LINK/wrench` | geometry_msgs/WrenchStamped | of a board with a body: force, N, and moment on a link; without counts per newton `wrench_counts`, in counts |
//! | `/tf_static` | tf2_msgs/TFMessage | the frame of each panel on its link: by the body, else panels of one link side by side |
//! | `/diagnostics` | diagnostic_msgs/DiagnosticArray | the board's counters, each second; stale once it is lost |
//!
//! A board of a robot has its topics below its name, as its node has: `/BOARD/tactile/PANEL/image`.
//! A lost board ends with a last wrench of 0 on each panel and link.
//!
//! The frame of a panel's messages is `tactile/PANEL`, whose parent is its link. Stamps are the host's time.

use crate::body::{ReadBody, Surface};
use crate::client::{Client, Event, ImageNews, Stamp};
use crate::error::Result;
use crate::recording::{Format, Store, Writer};
use crate::ros2::messages::{self, DiagnosticState};
use crate::ros2::topics::{LINK_COUNTS, LINK_WRENCH};
use crate::ros2::{pressing, schemas, topic_part};
use std::collections::{BTreeMap, BTreeSet};
use taxel_core::garment::Area;
use taxel_core::surface::LinkName;
use taxel_core::wire::PressingReport;

/// A file with ROS 2 messages only: readers of ROS bags refuse files with other messages.
#[derive(Debug)]
pub struct Ros2File<S: Store> {
    /// Writer of the file.
    pub writer: Writer<S>,
    /// Channels, created with their first message.
    ids: BTreeMap<String, u16>,
}

impl<S: Store> Ros2File<S> {
    /// Creates the file.
    pub fn create(store: S) -> Result<Ros2File<S>> {
        Ok(Ros2File { writer: Writer::create(store, "ros2")?, ids: BTreeMap::new() })
    }

    /// Writes the messages of a board that wait.
    pub fn write(&mut self, messages: &mut Ros2Messages) -> Result<()> {
        for (stamp, Sent { topic, schema, text, data }) in messages.waiting.drain(..) {
            let id = match self.ids.get(&topic) {
                Some(id) => *id,
                None => {
                    let format =
                        Format { encoding: "cdr", schema, schema_encoding: "ros2msg", text: text.as_bytes() };
                    let id = self.writer.channel(&topic, &format)?;
                    self.ids.insert(topic, id);
                    id
                }
            };
            self.writer.message(id, stamp.host_ns(), stamp.board_ns(), &data)?;
        }
        Ok(())
    }
}

/// The ROS 2 messages of a board that wait to be written.
#[derive(Debug)]
pub struct Ros2Messages {
    /// Name of the board in the robot; empty if it is alone.
    board: String,
    /// Panels whose frames have been reported.
    areas: Vec<Area>,
    /// Places of the panels on the robot.
    body: Option<ReadBody>,
    /// The body on this garment.
    surface: Option<Surface>,
    /// Links that something has pressed on.
    links: BTreeSet<LinkName>,
    waiting: Vec<(Stamp, Sent)>,
}

/// A message for a topic.
#[derive(Debug)]
struct Sent {
    topic: String,
    schema: &'static str,
    text: &'static str,
    data: Vec<u8>,
}

impl Ros2Messages {
    /// None yet, of a board alone or of this one of a robot, whose garment lies on this body.
    pub fn new(board: Option<&str>, body: Option<ReadBody>) -> Ros2Messages {
        Ros2Messages {
            board: board.unwrap_or_default().into(),
            areas: Vec::new(),
            body,
            surface: None,
            links: BTreeSet::new(),
            waiting: Vec::new(),
        }
    }

    /// Frames of the panels, unless reported already. Error if the body does not fit the garment.
    fn frames(&mut self, client: &Client, stamp: Stamp) -> Result<Option<Sent>> {
        let Some(description) =
            client.description().filter(|description| self.areas != description.layout.areas())
        else {
            return Ok(None);
        };
        let surface = self
            .body
            .as_ref()
            .map(|body| body.surface(&description.garment, &description.layout))
            .transpose()?;
        let data = messages::frames(&self.board, stamp.host_us, &description.layout, surface.as_ref());
        (self.areas, self.surface) = (description.layout.areas().to_vec(), surface);
        let schema = "tf2_msgs/msg/TFMessage";
        Ok(Some(Sent { topic: "/tf_static".into(), schema, text: schemas::FRAMES, data }))
    }

    /// Force and moment on each link that something has pressed on.
    fn pressing(&mut self, report: &PressingReport, stamp: Stamp, scale: Option<f64>) -> Vec<Sent> {
        self.links.extend(report.links.iter().map(|wrench| wrench.name.clone()));
        let of = if scale.is_some() { LINK_WRENCH } else { LINK_COUNTS };
        let sent = |link: &LinkName| {
            let presses = report.links.iter().find(|wrench| wrench.name == *link);
            Sent {
                topic: self.topic(&of.name.replace("LINK", &topic_part(link))),
                schema: "geometry_msgs/msg/WrenchStamped",
                text: schemas::WRENCH,
                data: pressing::wrench(stamp.host_us, link, presses, scale),
            }
        };
        self.links.iter().map(sent).collect()
    }

    /// A topic of the board, in its namespace.
    fn topic(&self, name: &str) -> String {
        match self.board.as_str() {
            "" => format!("/{name}"),
            board => format!("/{}/{name}", topic_part(board)),
        }
    }

    /// Adds the messages for an event.
    pub fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<()> {
        let scale = client.counts_per_newton();
        let all = match event {
            Event::Frame { image: ImageNews::Whole, .. } => {
                let mut all = Vec::from_iter(self.frames(client, stamp)?);
                all.extend(self.images(client, stamp, scale));
                all
            }
            Event::Pressing(report) => self.pressing(report, stamp, scale),
            Event::Health(health) => {
                vec![self.diagnostics(client, stamp, DiagnosticState::Reports(health, client.faulty().len()))]
            }
            Event::Lost { why, .. } => {
                let still = self.areas.iter().filter_map(|area| {
                    let taxels = usize::from(area.rows) * usize::from(area.columns);
                    Some(self.wrench(area, &vec![0; taxels], stamp, scale?))
                });
                let mut all: Vec<Sent> = still.collect();
                all.push(self.diagnostics(client, stamp, DiagnosticState::Lost(why)));
                all
            }
            _ => return Ok(()),
        };
        self.waiting.extend(all.into_iter().map(|sent| (stamp, sent)));
        Ok(())
    }

    /// True if any wait.
    pub fn is_ready(&self) -> bool {
        !self.waiting.is_empty()
    }

    /// Makes the diagnostics of the board.
    fn diagnostics(&self, client: &Client, stamp: Stamp, state: DiagnosticState<'_>) -> Sent {
        let firmware = client.description().map_or("", |description| description.firmware.as_str());
        let data = messages::diagnostics(&self.board, stamp.host_us, firmware, state);
        let schema = "diagnostic_msgs/msg/DiagnosticArray";
        Sent { topic: "/diagnostics".into(), schema, text: schemas::DIAGNOSTICS, data }
    }

    /// Force on a panel.
    fn wrench(&self, area: &Area, values: &[u16], stamp: Stamp, scale: f64) -> Sent {
        let data = messages::wrench(&self.board, stamp.host_us, area, values, scale);
        let topic = self.topic(&format!("tactile/{}/wrench", topic_part(&area.name)));
        Sent { topic, schema: "geometry_msgs/msg/WrenchStamped", text: schemas::WRENCH, data }
    }

    /// Image, points and force of each panel.
    fn images(&self, client: &Client, stamp: Stamp, scale: Option<f64>) -> Vec<Sent> {
        let (Some(layout), Some((_, image))) = (client.layout(), client.image()) else { return Vec::new() };
        let (board, surface) = (self.board.as_str(), self.surface.as_ref());
        let mut all = Vec::new();
        for area in layout.areas() {
            let start = usize::from(area.base);
            let taxels = usize::from(area.rows) * usize::from(area.columns);
            let values = image.get(start..start + taxels).unwrap_or(&[]);
            let mut send = |what: &str, schema, text, data| {
                let topic = self.topic(&format!("tactile/{}/{what}", topic_part(&area.name)));
                all.push(Sent { topic, schema, text, data });
            };
            let time = stamp.host_us;
            let pixels = messages::image(board, time, area, values);
            send("image", "sensor_msgs/msg/Image", schemas::IMAGE, pixels);
            if !area.pitch_um.contains(&0) || surface.is_some() {
                let data = pressing::points(board, time, area, surface, values);
                send("points", "sensor_msgs/msg/PointCloud2", schemas::POINT_CLOUD, data);
            }
            all.extend(scale.map(|scale| self.wrench(area, values, stamp, scale)));
        }
        all
    }
}
