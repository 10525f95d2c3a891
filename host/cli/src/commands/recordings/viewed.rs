//! Records a board, and shows it to pages: one client, and both get the same events.

use crate::view::{PageHub, Said, Viewer};
use anyhow::Result;
use std::sync::Arc;
use taxel::client::{Client, Event};
use taxel::record::Recorder;
use taxel::session::{JointPositions, Posing, Show};

/// What is recorded is what would be without pages: these never wait, and what they cannot show is told on them
/// alone.
pub struct ViewedRecorder<'a> {
    pub recorder: &'a mut Recorder,
    pub viewer: Viewer,
    pub hub: Arc<PageHub>,
}

impl ViewedRecorder<'_> {
    fn show(&mut self, show: impl FnOnce(&mut Viewer) -> Result<()>) {
        if let Err(error) = show(&mut self.viewer) {
            self.hub.say(&Said::note(format!("{error:#}")));
        }
    }
}

impl Show<anyhow::Error> for ViewedRecorder<'_> {
    fn event(&mut self, client: &Client, event: &Event) -> Result<()> {
        self.show(|viewer| viewer.event(client, event));
        self.recorder.event(client, event)
    }

    fn tells_remarks(&self) -> bool {
        true
    }

    fn follows_another(&self) -> bool {
        Show::<anyhow::Error>::follows_another(&*self.recorder)
    }

    fn asked(&mut self, client: &Client, bytes: &[u8]) -> Result<()> {
        self.show(|viewer| viewer.asked(client, bytes));
        self.recorder.asked(client, bytes)
    }

    fn pose(&mut self, client: &Client, posing: &mut Posing) -> Result<()> {
        self.recorder.pose(client, posing)
    }

    fn joints(&mut self, client: &Client, joints: &JointPositions) -> Result<()> {
        self.show(|viewer| viewer.joints(client, joints));
        self.recorder.joints(client, joints)
    }

    fn idle(&mut self, client: &mut Client) -> Result<bool> {
        self.show(|viewer| viewer.idle(client).map(drop));
        self.recorder.idle(client)
    }

    fn end(&mut self, client: &Client) -> Result<()> {
        self.show(|viewer| viewer.end(client));
        self.recorder.end(client)
    }
}
