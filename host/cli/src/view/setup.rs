//! Settings of a board by pages: limits and filter of its scene, undone step by step, and saved.

use super::limits::SceneLimits;
use super::lines::SetupLine;
use taxel::client::{BoardDescription, Client, Event, scene_bytes};
use taxel_core::wire::Request;

/// Most steps that can be undone.
const STEPS: usize = 64;

/// Order of a page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SetupOrder {
    /// Limits to set.
    Set(SceneLimits),
    /// Takes back the last ones.
    Undo,
    /// Saves the settings on the board.
    Save,
}

/// Steps by which pages have set a board.
#[derive(Debug, Default)]
pub struct PageSetup {
    /// Limits before each step, the newest last.
    before: Vec<SceneLimits>,
    unsaved: bool,
}

impl PageSetup {
    /// How it stands; none before the board has sent its scene.
    pub fn line(&self, client: &Client, read_only: bool) -> Option<SetupLine> {
        let description = client.description()?;
        Some(SetupLine {
            limits: SceneLimits::of(&description.scene),
            undo: self.before.len(),
            unsaved: self.unsaved,
            simulated: description.is_simulated(),
            read_only,
        })
    }

    /// Asks the board for what a page orders.
    pub fn obey(&mut self, order: SetupOrder, client: &mut Client) -> taxel::Result<()> {
        let Some(now) = client.description().map(|description| SceneLimits::of(&description.scene)) else {
            return Ok(());
        };
        let wanted = match order {
            SetupOrder::Save => return Ok(client.request(&Request::Save)?),
            SetupOrder::Undo => self.before.pop(),
            SetupOrder::Set(limits) if limits == now => None,
            SetupOrder::Set(limits) => {
                if self.before.len() >= STEPS {
                    self.before.remove(0);
                }
                self.before.push(now);
                Some(limits)
            }
        };
        let description = client.description().zip(wanted);
        let scene = description.map(|(BoardDescription { scene, .. }, limits)| limits.applied(scene));
        let Some(scene) = scene else { return Ok(()) };
        self.unsaved = true;
        Ok(client.request(&Request::SetScene(&scene_bytes(&scene)?))?)
    }

    /// Handles an event. Returns true if it changes how it stands.
    pub fn heard(&mut self, event: &Event) -> bool {
        match event {
            Event::Other { .. } => *self = PageSetup::default(),
            Event::Answer { request, refusal } if *request == Request::SetScene(&[]).number() => {
                if refusal.is_some() {
                    self.before.pop();
                }
            }
            Event::Answer { request, refusal: None } if *request == Request::Save.number() => {
                self.unsaved = false;
            }
            Event::Hello => {}
            _ => return false,
        }
        true
    }
}
