//! Images, points and forces of the panels, as often as asked for.

use super::node::RosNode;
use anyhow::Result;
use std::sync::Arc;
use taxel::body::Surface;
use taxel::client::Client;
use taxel::ros2::parameters::IMAGE_HZ;
use taxel::ros2::topics::{FRAMES, IMAGE, POINTS, RosTopic, WRENCH};
use taxel::ros2::{messages, pressing, topic_part};
use taxel_core::garment::Area;

/// The topics of each panel.
const OF_PANEL: [RosTopic; 3] = [IMAGE, POINTS, WRENCH];

/// Messages that are published of the panels.
#[derive(Debug)]
pub struct Panels {
    /// Counts per newton, if known.
    per_newton: Option<f64>,
    /// Panels that were offered.
    areas: Vec<Area>,
    /// Places of the taxels, with a body.
    surface: Option<Arc<Surface>>,
    /// The board's time from which the next image is due, us.
    due_us: u64,
}

impl Panels {
    /// None yet.
    pub fn new() -> Panels {
        Panels { per_newton: None, areas: Vec::new(), surface: None, due_us: 0 }
    }

    /// Offers the topics of a board's panels, and reports the frames of the panels, if they have changed. With
    /// a surface, points lie on links.
    pub fn offer(
        &mut self,
        node: &mut RosNode,
        client: &Client,
        us: u64,
        surface: Option<&Arc<Surface>>,
    ) -> Result<()> {
        let before = self.names();
        self.surface = surface.cloned();
        let Some(layout) = client.layout() else { return Ok(()) };
        if (self.areas.as_slice(), self.per_newton) == (layout.areas(), client.counts_per_newton()) {
            return Ok(());
        }
        (self.areas, self.per_newton) = (layout.areas().to_vec(), client.counts_per_newton());
        let now = self.names();
        let names = |topics: &[(RosTopic, String)]| -> Vec<String> {
            topics.iter().map(|(topic, part)| node.name(topic, part)).collect()
        };
        let (kept, gone) = (names(&now), names(&before));
        node.withdraw(|name| gone.iter().any(|gone| gone == name) && !kept.iter().any(|kept| kept == name));
        for (topic, part) in &now {
            node.offer(topic, part)?;
        }
        self.due_us = 0;
        let frames = messages::frames(node.board(), us, layout, surface.map(AsRef::as_ref));
        node.publish(&FRAMES, "", frames)
    }

    /// Topics of all panels, each with its panel's part of the name.
    fn names(&self) -> Vec<(RosTopic, String)> {
        let of =
            |area: &Area| self.topics(area).map(|topic| (topic, topic_part(&area.name))).collect::<Vec<_>>();
        self.areas.iter().flat_map(of).collect()
    }

    /// Topics of a panel: points need a pitch or a place, forces a calibration.
    fn topics(&self, area: &Area) -> impl Iterator<Item = RosTopic> + use<> {
        let (is_flat, is_calibrated) =
            (!area.pitch_um.contains(&0) || self.surface.is_some(), self.per_newton.is_some());
        OF_PANEL
            .into_iter()
            .filter(move |topic| (is_flat || *topic != POINTS) && (is_calibrated || *topic != WRENCH))
    }

    /// Publishes that nothing presses on any panel, at the time `us`: the last wrenches of a board that is lost.
    pub fn still(&self, node: &mut RosNode, us: u64) -> Result<()> {
        let Some(per_newton) = self.per_newton else { return Ok(()) };
        self.areas.iter().try_for_each(|area| {
            let nothing = vec![0; usize::from(area.rows) * usize::from(area.columns)];
            let message = messages::wrench(node.board(), us, area, &nothing, per_newton);
            node.publish(&WRENCH, &topic_part(&area.name), message)
        })
    }

    /// Publishes the last image of a client, if it is due and somebody wants it. Messages have the time `us`.
    pub fn image(&mut self, node: &mut RosNode, client: &Client, us: u64, board_us: u64) -> Result<()> {
        let hz = node.number(IMAGE_HZ);
        // A board that has restarted begins anew.
        self.due_us = if hz > 0.0 { self.due_us.min(board_us + period_us(hz)) } else { u64::MAX };
        if hz <= 0.0 || board_us < self.due_us {
            return Ok(());
        }
        // Later than due by less than a frame: the next one is not late, too.
        self.due_us = (self.due_us + period_us(hz)).max(board_us);
        let Some((_, image)) = client.image() else { return Ok(()) };
        for area in &self.areas {
            let part = topic_part(&area.name);
            let start = usize::from(area.base);
            let values = image.get(start..start + usize::from(area.rows) * usize::from(area.columns));
            let values = values.unwrap_or_default();
            for topic in self.topics(area) {
                if !node.wants(&topic, &part) {
                    continue;
                }
                let message = match topic {
                    IMAGE => messages::image(node.board(), us, area, values),
                    POINTS => pressing::points(node.board(), us, area, self.surface.as_deref(), values),
                    _ => messages::wrench(node.board(), us, area, values, self.per_newton.unwrap_or(1.0)),
                };
                node.publish(&topic, &part, message)?;
            }
        }
        Ok(())
    }
}

/// Time between two images, us.
fn period_us(hz: f64) -> u64 {
    (1e6 / hz) as u64
}
