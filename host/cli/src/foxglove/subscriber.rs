//! Outgoing messages of one client: a bounded amount, however slow it is.

use super::protocol::{self, Channel};
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use std::time::Duration;
use taxel::source::shared::Shared;
use tungstenite::{Bytes, Message};

/// Most bytes queued; the oldest messages are dropped.
const WAITING: usize = 8 << 20;

/// Most subscriptions of a client: several for each channel.
const MOST: usize = 64;

/// A message of a channel.
#[derive(Debug, PartialEq, Eq)]
pub struct ChannelMessage {
    /// Channel of the message.
    pub channel: Channel,
    /// Host time, ns since 1970.
    pub ns: u64,
    /// JSON; of images, protobuf.
    pub data: Vec<u8>,
}

/// A client.
#[derive(Debug, Default)]
pub struct Subscriber(Shared<SubscriberQueue>);

#[derive(Debug, Default)]
struct SubscriberQueue {
    /// Channels by the client's subscription number.
    subscriptions: BTreeMap<u32, Channel>,
    messages: VecDeque<(u32, Arc<ChannelMessage>)>,
    bytes: usize,
    left_out: u64,
    /// A subscription was refused.
    full: bool,
    pong: Option<Bytes>,
    closed: bool,
}

impl Subscriber {
    /// Subscribes to a channel, and sends its last message; refuses too many subscriptions with a status.
    pub fn subscribe(&self, id: u32, channel: Channel, known: Option<&Arc<ChannelMessage>>) {
        self.0.change(|waiting| {
            if waiting.subscriptions.len() >= MOST && !waiting.subscriptions.contains_key(&id) {
                waiting.full = true;
                return;
            }
            waiting.subscriptions.insert(id, channel);
            known.into_iter().for_each(|sent| waiting.put(id, sent));
        });
    }

    /// Ends a subscription.
    pub fn unsubscribe(&self, id: u32) {
        self.0.change(|waiting| _ = waiting.subscriptions.remove(&id));
    }

    /// True if the client subscribes to the channel.
    pub fn wants(&self, channel: Channel) -> bool {
        self.0.lock().subscriptions.values().any(|wanted| *wanted == channel)
    }

    /// Queues a message if the client subscribes to its channel.
    pub fn send(&self, sent: &Arc<ChannelMessage>) {
        self.0.change(|waiting| {
            let of = |(id, channel): (&u32, &Channel)| (*channel == sent.channel).then_some(*id);
            let ids: Vec<u32> = waiting.subscriptions.iter().filter_map(of).collect();
            ids.into_iter().for_each(|id| waiting.put(id, sent));
        });
    }

    /// Answers the last of several pings.
    pub fn pong(&self, bytes: Bytes) {
        self.0.change(|waiting| waiting.pong = Some(bytes));
    }

    /// Closes the queue.
    pub fn close(&self) {
        self.0.change(|waiting| waiting.closed = true);
    }

    /// Waits for the next message; none once closed.
    pub fn next(&self) -> Option<Message> {
        let mut waiting = self.0.lock();
        loop {
            if waiting.closed {
                return None;
            }
            if let Some(message) = waiting.due() {
                return Some(message);
            }
            waiting = self.0.wait(waiting, Duration::from_secs(1));
        }
    }
}

impl SubscriberQueue {
    fn put(&mut self, id: u32, sent: &Arc<ChannelMessage>) {
        self.messages.push_back((id, sent.clone()));
        self.bytes += sent.data.len();
        while self.bytes > WAITING {
            let Some((_, oldest)) = self.messages.pop_front() else { return };
            self.bytes -= oldest.data.len();
            self.left_out += 1;
        }
    }

    fn due(&mut self) -> Option<Message> {
        if let Some(pong) = self.pong.take() {
            return Some(Message::Pong(pong));
        }
        if std::mem::take(&mut self.full) {
            return Some(Message::text(protocol::too_many(MOST)));
        }
        if self.left_out > 0 {
            return Some(Message::text(protocol::left_out(std::mem::take(&mut self.left_out))));
        }
        let (id, sent) = self.messages.pop_front()?;
        self.bytes -= sent.data.len();
        Some(Message::binary(protocol::data(id, sent.ns, &sent.data)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_grows_while_nobody_reads() {
        let slow = Subscriber::default();
        slow.subscribe(9, 2, None);
        let sent = |ns| Arc::new(ChannelMessage { channel: 2, ns, data: vec![b' '; 1 << 20] });
        (0..20).for_each(|ns| slow.send(&sent(ns)));
        slow.send(&Arc::new(ChannelMessage { channel: 3, ns: 0, data: Vec::new() }));
        assert!(slow.wants(2) && !slow.wants(3));
        let text = slow.next().unwrap().into_text().unwrap();
        assert!(text.contains("12 messages were left out"), "{text}");
        let first = slow.next().unwrap().into_data();
        assert_eq!(first[..13], protocol::data(9, 12, b"")[..]);
        slow.unsubscribe(9);
        slow.close();
        assert!(slow.next().is_none());
    }
}
