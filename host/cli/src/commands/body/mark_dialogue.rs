//! Marks on the robot, shown one after the other, and the touches of each.

use anyhow::{Result, ensure};
use std::collections::HashMap;
use taxel::body::fit::{FeltTouch, KnownTouch, Mark, TouchGatherer};
use taxel::client::{Client, Event, Stamp};
use taxel::session::Observer;

/// Asks for the marks and takes what the board feels. A touch of a panel on another link does not count.
pub struct MarkDialogue {
    marks: Vec<Mark>,
    /// Link of each panel that has a place, by the panel's name.
    links: HashMap<String, String>,
    gatherer: TouchGatherer,
    touches: Vec<KnownTouch>,
}

impl MarkDialogue {
    /// Asks for the first of these marks.
    pub fn new(marks: Vec<Mark>, links: HashMap<String, String>) -> MarkDialogue {
        let dialogue = MarkDialogue { marks, links, gatherer: TouchGatherer::default(), touches: Vec::new() };
        dialogue.ask();
        dialogue
    }

    /// The touches of the marks, in their order; of the first marks, if it was stopped. Error if none was
    /// touched.
    pub fn touches(self) -> Result<Vec<KnownTouch>> {
        let (touched, all) = (self.touches.len(), self.marks.len());
        ensure!(touched > 0, "none of the {all} marks has been touched");
        if touched < all {
            eprintln!("{touched} of {all} marks have been touched.");
        }
        Ok(self.touches)
    }

    fn ask(&self) {
        if let Some(Mark { link, at }) = self.marks.get(self.touches.len()) {
            let (number, all) = (self.touches.len() + 1, self.marks.len());
            eprintln!("Touch mark {number} of {all}: {link}, {:.3} {:.3} {:.3} m", at.x, at.y, at.z);
        }
    }

    fn take(&mut self, client: &Client, touch: FeltTouch) {
        let Some(Mark { link, at }) = self.marks.get(self.touches.len()) else { return };
        let panel = client.panel_name(touch.panel);
        match self.links.get(panel) {
            Some(on) if on == link => {
                let [x, y, z] = at.to_array();
                let (panel, link) = (panel.to_string(), link.clone());
                self.touches.push(KnownTouch { panel, column: touch.x, row: touch.y, link, x, y, z });
            }
            Some(on) => eprintln!("That was {panel}, on {on}; the mark is on {link}. Once more:"),
            None => eprintln!("That was {panel}, which lies on no link. Once more:"),
        }
        self.ask();
    }
}

impl Observer for MarkDialogue {
    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        if let Event::Frame { time, .. } | Event::Contacts { time, .. } = event
            && let Some(touch) = self.gatherer.frame(*time, client.contacts())
        {
            self.take(client, touch);
        }
        Ok(())
    }

    fn is_done(&self) -> bool {
        self.touches.len() >= self.marks.len()
    }

    fn ended(&mut self, client: &Client, _: Stamp) -> taxel::Result<()> {
        if let Some(touch) = self.gatherer.ended() {
            self.take(client, touch);
        }
        Ok(())
    }
}
