//! The requests of the command line to a board, and the answers to them.

use super::LiveArgs;
use taxel::client::{Client, Event, request_name};
use taxel_core::wire::Request;

/// Requests that a board has not answered yet.
#[derive(Debug, Default)]
pub struct Asked {
    /// Numbers of the requests, in the order in which they are sent.
    numbers: Vec<u8>,
    /// Sentence about the first refusal: the command cannot do what was asked for.
    pub refusal: Option<String>,
}

impl Asked {
    /// Collects the requests that were queued because of these options, except those that may be refused.
    pub fn of(client: &Client, args: &LiveArgs) -> Asked {
        let mut numbers = client.queued_numbers();
        let table = Request::SetTable(&[]).number();
        numbers.retain(|number| !args.body_may_fail || *number != table);
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

    #[test]
    fn whoever_can_do_without_a_body_goes_on_if_it_is_refused() {
        let args = LiveArgs::of("sim:idle".parse().unwrap());
        let needless = LiveArgs { body_may_fail: true, ..args.clone() };
        let mut client = Client::new();
        let requests = [Request::SetTable(&[]), Request::Stream { raw_hz: 0, budget_hz: 1 }];
        requests.iter().for_each(|request| client.request(request).unwrap());
        let refused = |args: &LiveArgs| {
            let mut asked = Asked::of(&client, args);
            for request in &requests {
                let refusal = Some("no".into());
                asked.answered(&Event::Answer { request: request.number(), refusal });
            }
            asked.refusal
        };
        assert_eq!(refused(&args).unwrap(), "the board refuses set-table: no");
        assert_eq!(refused(&needless).unwrap(), "the board refuses stream: no");
    }
}
