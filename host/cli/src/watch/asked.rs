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

#[cfg(test)]
mod tests {
    use super::*;
    use taxel::client::Client;

    /// The sentence about a board that refuses everything that is asked of it.
    fn refused(args: &LiveArgs, requests: &[Request<'_>]) -> Option<String> {
        let mut client = Client::new();
        requests.iter().for_each(|request| client.request(request).unwrap());
        let mut asked = Asked::of(&client.queued(), args);
        for request in requests {
            let refusal = Some("no".into());
            asked.answered(&Event::Answer { request: request.number(), refusal });
        }
        asked.refusal
    }

    #[test]
    fn whoever_can_do_without_a_body_goes_on_if_it_is_refused() {
        let args = LiveArgs::of("sim:idle".parse().unwrap());
        let needless = LiveArgs { body_may_fail: true, ..args.clone() };
        let body = [Request::SetSurface(&[]), Request::SetPressing(50)];
        assert_eq!(refused(&args, &body).unwrap(), "the board refuses set-surface: no");
        assert_eq!(refused(&needless, &body), None);
        let more = [Request::SetPressing(50), Request::Budget { hz: 1 }];
        assert_eq!(refused(&needless, &more).unwrap(), "the board refuses budget: no");
    }
}
