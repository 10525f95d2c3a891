//! The requests of the command line to a board, and the answers to them.

use super::LiveArgs;
use taxel::client::{Event, request_name};
use taxel_core::wire::{self, Request};

/// Requests that a board has not answered yet.
#[derive(Debug, Default)]
pub struct Asked {
    /// Numbers of the requests, in the order in which they are sent.
    numbers: Vec<u8>,
    /// Sentence about the first refusal: the command cannot do what was asked for.
    pub refusal: Option<String>,
}

impl Asked {
    /// Collects the requests in frames of the wire that were queued because of these options, except those that
    /// may be refused.
    pub fn of(frames: &[u8], args: &LiveArgs) -> Asked {
        let number = |frame: &[u8]| wire::open(&mut frame.to_vec()).ok()?.first().copied();
        let mut numbers: Vec<u8> = frames.split(|byte| *byte == 0).filter_map(number).collect();
        let body = [Request::SetSurface(&[]), Request::SetPressing(0)].map(|request| request.number());
        numbers.retain(|number| !args.body_may_fail || !body.contains(number));
        // A tare that only a simulated scene asks for may be refused: somebody touches already.
        let tare = Request::Tare { frames: 0 }.number();
        numbers.retain(|number| *number != tare || args.board.tare.is_some());
        Asked { numbers, refusal: None }
    }

    /// Handles an event that answers one of these requests.
    pub fn answered(&mut self, event: &Event) {
        let Event::Answer { request, refusal } = event else { return };
        let Some(at) = self.numbers.iter().position(|number| number == request) else { return };
        self.numbers.remove(at);
        if let (None, Some(why)) = (&self.refusal, refusal) {
            self.refusal = Some(format!("the board refuses {}: {why}", request_name(*request)));
        }
    }
}
