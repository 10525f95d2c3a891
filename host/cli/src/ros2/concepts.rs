//! Concepts on their way to the board.

use super::inbox::received;
use super::node::RosNode;
use anyhow::Result;
use ros2_client::Subscription;
use ros2_client::log::LogLevel;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::time::{Duration, Instant};
use taxel::client::Client;
use taxel::ros2::parameters::CONCEPT_TIMEOUT_MS;
use taxel::ros2::topic_part;
use taxel::ros2::topics::CONCEPT;
use taxel_core::format::{Name, Q15};
use taxel_core::intent::{Feed, Source};
use taxel_core::wire::Request;

/// Shortest time between two values of a concept: the newest counts.
const PAUSE: Duration = Duration::from_millis(50);

/// A concept that the scene's map lets the host feed.
struct Fed {
    values: Subscription<f64>,
    newest: Option<f64>,
    sent: Instant,
}

/// The concepts of the board's scene.
#[derive(Default)]
pub struct Concepts(BTreeMap<Name, Fed>);

impl Concepts {
    /// Subscribes to the concepts of the board's scene, and to no others.
    pub fn offer(&mut self, node: &mut RosNode, client: &Client) -> Result<()> {
        let names = fed(client);
        self.0.retain(|name, _| names.contains(name));
        for name in names {
            if let Entry::Vacant(place) = self.0.entry(name) {
                let values = node.subscribe(&CONCEPT, &topic_part(place.key()))?;
                place.insert(Fed { values, newest: None, sent: Instant::now() });
            }
        }
        Ok(())
    }

    /// Takes what has come, and sends the newest.
    pub fn turn(&mut self, node: &RosNode, client: &mut Client) -> Result<()> {
        for (name, fed) in &mut self.0 {
            fed.newest = received(&fed.values).last().or(fed.newest);
            if fed.sent.elapsed() < PAUSE {
                continue;
            }
            let Some(value) = fed.newest.take() else { continue };
            fed.sent = Instant::now();
            if !(-1.0..=1.0).contains(&value) {
                node.log(LogLevel::Warn, &format!("concept {name}: {value} is not a number from -1 to 1"));
                continue;
            }
            let value = Q15((value * f64::from(Q15::ONE.0)).round() as i32);
            let timeout_ms = node.number(CONCEPT_TIMEOUT_MS) as u32;
            let feed = Feed { concept: name.clone(), value, age_ms: 0, timeout_ms, default: Q15(0) };
            client.request(&Request::Feed(feed))?;
        }
        Ok(())
    }
}

/// Names of the concepts that the host may feed.
fn fed(client: &Client) -> Vec<Name> {
    let map = client
        .description()
        .and_then(|description| description.scene.intent.as_ref())
        .map(|intent| &intent.map);
    let inputs = map.iter().flat_map(|map| map.inputs.iter());
    let by_host = inputs.filter(|input| matches!(input.source, Source::Host(_)));
    by_host.filter_map(|input| client.concepts().get(usize::from(input.concept)).cloned()).collect()
}
