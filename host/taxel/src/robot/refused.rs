//! Refusals of what a board is asked first.

use crate::client::{Client, Event, request_name};
use crate::error::SourceError;
use taxel_core::wire::Request;

/// Requests that the board must accept and has not answered yet.
#[derive(Debug, Default)]
pub struct Required(Vec<u8>);

impl Required {
    /// The requests that are queued, except a tare: a garment that is touched refuses it, and goes on with
    /// the baseline that it has.
    pub fn of(client: &Client) -> Required {
        Required(client.queued_numbers()).without(&Request::Tare { frames: 0 })
    }

    /// The requests that are queued, with the tare.
    pub fn with_tare(client: &Client) -> Required {
        Required(client.queued_numbers())
    }

    /// All but requests of this kind, which the board may refuse.
    pub fn without(mut self, request: &Request<'_>) -> Required {
        self.0.retain(|number| *number != request.number());
        self
    }

    /// Error if the event is the refusal of one of them.
    pub fn answered(&mut self, label: &str, event: &Event) -> Result<(), SourceError> {
        let Event::Answer { request, refusal } = event else { return Ok(()) };
        let Some(at) = self.0.iter().position(|number| number == request) else { return Ok(()) };
        self.0.remove(at);
        match refusal {
            None => Ok(()),
            Some(reason) => {
                let request = request_name(*request);
                let what = format!("{label}: the board refuses {request}");
                Err(SourceError::Refused { request, what, reason: reason.clone() })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_may_be_refused_is_no_error() {
        let mut client = Client::new();
        let requests = [Request::SetTable(&[]), Request::Stream { raw_hz: 0, budget_hz: 1 }];
        requests.iter().for_each(|request| client.request(request).unwrap());
        let refused = |mut required: Required| {
            let refusal = |request: &Request<'_>| Event::Answer {
                request: request.number(),
                refusal: Some("no".into()),
            };
            let answers = requests.iter().map(|request| required.answered("usb", &refusal(request)));
            answers.filter_map(Result::err).map(|error| error.to_string()).collect::<Vec<_>>()
        };
        let stream = "usb: the board refuses stream: no";
        assert_eq!(refused(Required::of(&client)), ["usb: the board refuses set-table: no", stream]);
        assert_eq!(refused(Required::of(&client).without(&Request::SetTable(&[]))), [stream]);
    }
}
