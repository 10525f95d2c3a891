//! Requests of others to an offered board: they come as queries, are checked, and go to the board in the order in
//! which they came.

use crate::client::Client;
use crate::network::{AskedFrame, LONGEST_ASK, too_long};
use crate::source::shared::Shared;
use std::collections::VecDeque;
use zenoh::Wait;
use zenoh::query::Query;

/// Most requests that wait for the board's loop; more are refused.
const WAITING: usize = 256;

/// Queries that have come, and are not answered.
#[derive(Debug, Default)]
pub struct Asks(Shared<VecDeque<Query>>);

impl Asks {
    /// Takes a query; what is longer than any request is refused at once, and takes no room.
    pub fn push(&self, query: Query) {
        let bytes = query.payload().map_or(0, |payload| payload.len());
        if bytes > LONGEST_ASK {
            return refuse(&query, &too_long(bytes));
        }
        let mut waiting = self.0.lock();
        if waiting.len() < WAITING {
            return waiting.push_back(query);
        }
        drop(waiting);
        refuse(&query, "too many requests are waiting");
    }

    /// Queues what has come as requests to the board, and answers that they were handed over; refuses them all
    /// while the board is lost.
    pub fn hand_over(&self, client: &mut Client, is_live: bool) {
        loop {
            let Some(query) = self.0.lock().pop_front() else { return };
            let handed = match is_live {
                true => {
                    hand_over(client, &query.payload().map_or(Default::default(), |bytes| bytes.to_bytes()))
                }
                false => Err("the board is lost, and is waited for".into()),
            };
            match handed {
                // A reader that is gone needs no answer.
                Ok(()) => drop(query.reply(query.key_expr().clone(), "").wait()),
                Err(why) => refuse(&query, &why),
            }
        }
    }
}

/// Queues the request in a frame of the wire. Error if it is none.
fn hand_over(client: &mut Client, frame: &[u8]) -> Result<(), String> {
    let mut asked = AskedFrame::default();
    client.request(&asked.read(frame)?).map_err(|why| why.to_string())
}

fn refuse(query: &Query, why: &str) {
    drop(query.reply_err(why).wait());
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::wire::{Request, encode};

    #[test]
    fn a_request_is_handed_over_and_anything_else_refused() {
        let mut client = Client::new();
        client.take_requests();
        let mut room = [0; 64];
        let tare = encode(&Request::Tare { frames: 7 }, &mut room).unwrap().to_vec();
        assert_eq!(hand_over(&mut client, &tare), Ok(()));
        assert_eq!(client.take_requests(), tare);
        for (frame, why) in [
            (vec![], "it has no bytes"),
            (vec![1], "it has no end"),
            (vec![0], "it has no end"),
            ([tare.clone(), tare.clone()].concat(), "it is more than one frame"),
        ] {
            assert_eq!(hand_over(&mut client, &frame).unwrap_err(), why);
        }
        let mut broken = tare;
        broken[2] ^= 1;
        assert!(hand_over(&mut client, &broken).is_err());
        assert!(client.take_requests().is_empty());
    }
}
