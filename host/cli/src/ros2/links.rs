//! Forces and moments on the robot's links.

use super::node::RosNode;
use anyhow::Result;
use std::sync::Arc;
use taxel::body::{ReadBody, Surface};
use taxel::client::Client;
use taxel::files::calibrate::Newtons;
use taxel::ros2::topics::{LINK_COUNTS, LINK_WRENCH, PRESSING, REGIONS, RosTopic};
use taxel::ros2::{pressing, topic_part};
use taxel_core::garment::Garment;
use taxel_core::wire::{PressingReport, RegionsReport};

/// The links that carry the garment.
#[derive(Debug)]
pub struct Links {
    body: Option<ReadBody>,
    /// Newtons of its board's pressure.
    newtons: Option<Newtons>,
    /// The body on this garment.
    placed: Option<(Garment, Arc<Surface>)>,
}

impl Links {
    /// Makes the links of a body, if there is one.
    pub fn new(body: Option<ReadBody>) -> Links {
        Links { body, newtons: None, placed: None }
    }

    /// The places of the taxels; none without a body, or before the board's garment is known.
    pub fn surface(&self) -> Option<&Arc<Surface>> {
        self.placed.as_ref().map(|(_, surface)| surface)
    }

    /// Counts per newton; none if unknown.
    fn per_newton(&self) -> Option<f64> {
        self.newtons.as_ref()?.counts_per_newton()
    }

    /// Forces of links: in newtons if they are known.
    fn topic(&self) -> RosTopic {
        if self.per_newton().is_some() { LINK_WRENCH } else { LINK_COUNTS }
    }

    /// Places the body on the garment of the board, and offers the topics of its links, if it is
    /// another garment than before.
    pub fn offer(&mut self, node: &mut RosNode, client: &Client) -> Result<()> {
        let (Some(body), Some(board)) = (&self.body, client.description()) else { return Ok(()) };
        let before = self.topic();
        self.newtons = client.newtons().cloned();
        let topic = self.topic();
        if topic == before && self.placed.as_ref().is_some_and(|(garment, _)| *garment == board.garment) {
            return Ok(());
        }
        let surface = Arc::new(body.surface(&board.garment, &board.layout)?);
        let gone = self.surface().into_iter().flat_map(|before| before.links());
        let gone: Vec<String> = gone
            .filter(|link| topic != before || !surface.links().contains(link))
            .map(|link| node.name(&before, &topic_part(link)))
            .collect();
        node.withdraw(|name| gone.iter().any(|gone| gone == name));
        node.offer(&PRESSING, "")?;
        node.offer(&REGIONS, "")?;
        for link in surface.links() {
            node.offer(&topic, &topic_part(link))?;
        }
        self.placed = Some((board.garment.clone(), surface));
        Ok(())
    }

    /// Publishes what the regions of the surface feel.
    pub fn regions(
        &self,
        node: &mut RosNode,
        client: &Client,
        report: &RegionsReport,
        us: u64,
    ) -> Result<()> {
        // The board may have a body that nobody has named here.
        if self.placed.is_none() {
            return Ok(());
        }
        node.publish(&REGIONS, "", pressing::regions(us, client, report))
    }

    /// Publishes a report of the board. `base` is the frame of the robot's base, or empty.
    pub fn report(&self, node: &mut RosNode, report: &PressingReport, us: u64, base: &str) -> Result<()> {
        // The board may have a body that nobody has named here.
        let Some(surface) = self.surface() else { return Ok(()) };
        node.publish(&PRESSING, "", pressing::pressing(us, report, base, self.newtons.as_ref()))?;
        let topic = self.topic();
        for link in surface.links() {
            let part = topic_part(link);
            if node.wants(&topic, &part) {
                let presses = report.links.iter().find(|wrench| wrench.name.as_str() == link);
                node.publish(&topic, &part, pressing::wrench(us, link, presses, self.per_newton()))?;
            }
        }
        Ok(())
    }
}
