//! What the command line has asked of a board, and whether the board does it.

use super::BoardArgs;
use crate::client::{Event, request_name};
use taxel_core::wire::{self, Request};

/// Requests that a board has not answered yet.
#[derive(Debug, Default)]
pub struct Asked {
    /// Their numbers, in the order in which they are sent.
    numbers: Vec<u8>,
    /// What the board has refused, in a sentence: the command cannot do what was asked for.
    pub refusal: Option<String>,
}

impl Asked {
    /// Of frames of the wire that are about to be sent because of these options.
    pub fn of(frames: &[u8], args: &BoardArgs) -> Asked {
        let number = |frame: &[u8]| wire::open(&mut frame.to_vec()).ok()?.first().copied();
        let mut numbers: Vec<u8> = frames.split(|byte| *byte == 0).filter_map(number).collect();
        // A tare that only a simulated scene asks for may be refused: somebody touches already.
        let tare = Request::Tare { frames: 0 }.number();
        numbers.retain(|number| *number != tare || args.tare.is_some());
        Asked { numbers, refusal: None }
    }

    /// Takes an answer, if the event is one to a request that was asked for.
    pub fn answered(&mut self, event: &Event) {
        let Event::Answer { request, refusal } = event else { return };
        let Some(at) = self.numbers.iter().position(|number| number == request) else { return };
        self.numbers.remove(at);
        if let (None, Some(why)) = (&self.refusal, refusal) {
            self.refusal = Some(format!("the board refuses {}: {why}", request_name(*request)));
        }
    }
}
