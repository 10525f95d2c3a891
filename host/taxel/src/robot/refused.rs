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
        let numbers = client.queued_numbers().into_iter();
        Required(numbers.filter(|number| *number != Request::Tare { frames: 0 }.number()).collect())
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
