//! The node, its publishers and subscriptions.

use super::names::RosPlace;
use super::parameters::RosParameters;
use super::raw::Encoded;
use anyhow::{Context as _, Result, anyhow};
use ros2_client::builtin_interfaces::Time;
use ros2_client::log::LogLevel;
use ros2_client::qos::{Durability, History, Reliability, WhenFull};
use ros2_client::{
    Context, ContextOptions, Message, MessageTypeName, Name, Node, NodeName, NodeOptions, ParameterValue,
    Publisher, QosProfile, RosoutRaw, Server, ServiceMapping, ServiceTypeName, Subscription, WriteError,
};
use std::collections::BTreeMap;
use std::future::Future;
use std::pin::pin;
use std::sync::Arc;
use std::task::{Poll, Wake, Waker};
use std::thread::{self, Thread};
use taxel::ros2::topics::{JOINT_STATES, RosQos, RosService, RosTopic};

/// Domains that there are.
pub const DOMAINS: std::ops::RangeInclusive<u16> = 0..=232;

/// A node. Dropping it takes it from the network.
pub struct RosNode {
    place: RosPlace,
    node: Node,
    /// By whole name of the topic.
    publishers: BTreeMap<String, Publisher<Encoded>>,
}

impl RosNode {
    /// Joins the network.
    pub fn open(place: RosPlace, parameters: &RosParameters) -> Result<RosNode> {
        place.check()?;
        let fail = |why: String| anyhow!("the ROS 2 node cannot be started: {why}");
        let context = Context::with_options(ContextOptions::new().domain_id(place.domain));
        let context = context.map_err(|error| fail(error.to_string()))?;
        let name = NodeName::new(&place.namespace(), &place.name).map_err(|error| fail(error.to_string()))?;
        let options = parameters.declare(NodeOptions::new());
        let mut node = context.new_node(name, options).map_err(|error| fail(error.to_string()))?;
        let spinner = node.spinner().map_err(|error| fail(error.to_string()))?;
        // It ends with the node.
        let spin = move || drop(block_on(spinner.spin()));
        thread::Builder::new().name("ros2".into()).spawn(spin).context("a thread for ROS 2")?;
        Ok(RosNode { place, node, publishers: BTreeMap::new() })
    }

    /// Name of its board among those of a robot; empty if it is alone.
    pub fn board(&self) -> &str {
        self.place.board.as_deref().unwrap_or_default()
    }

    /// Whole name of a topic, one of a panel, link, concept or host input if `part` names it.
    pub fn name(&self, topic: &RosTopic, part: &str) -> String {
        let parts = ["PANEL", "LINK", "CONCEPT", "NAME"];
        let name = parts.iter().fold(topic.name.to_string(), |name, of| name.replace(of, part));
        if *topic == JOINT_STATES { self.place.shared(&name) } else { self.place.absolute(&name) }
    }

    /// Offers a topic, so that subscribers find it before its first message.
    pub fn offer(&mut self, topic: &RosTopic, part: &str) -> Result<()> {
        let name = self.name(topic, part);
        if self.publishers.contains_key(&name) {
            return Ok(());
        }
        let dds = self.topic(&name, topic)?;
        let publisher =
            self.node.create_publisher(&dds, None).map_err(|error| anyhow!("topic {name}: {error}"))?;
        self.publishers.insert(name, publisher);
        Ok(())
    }

    /// Withdraws what `is_it` names.
    pub fn withdraw(&mut self, is_it: impl Fn(&str) -> bool) {
        self.publishers.retain(|name, _| !is_it(name));
    }

    /// True if somebody subscribes to a topic.
    pub fn wants(&self, topic: &RosTopic, part: &str) -> bool {
        let publisher = self.publishers.get(&self.name(topic, part));
        publisher.is_some_and(|publisher| publisher.get_subscription_count(&self.node) > 0)
    }

    /// Publishes a message of [`Cdr`](taxel::ros2::Cdr). Never waits: a publisher without room, because a subscriber
    /// confirms nothing, is replaced by a new one, which all subscribers find.
    pub fn publish(&mut self, topic: &RosTopic, part: &str, cdr: Vec<u8>) -> Result<()> {
        let name = self.name(topic, part);
        let mut message = Encoded::new(cdr);
        for _ in 0..2 {
            self.offer(topic, part)?;
            let Some(publisher) = self.publishers.get(&name) else { break };
            message = match publisher.publish(message) {
                Err(WriteError::WouldBlock { data }) => data,
                done => return done.map_err(|error| anyhow!("topic {name}: {error}")),
            };
            self.publishers.remove(&name);
            self.log(LogLevel::Warn, &format!("a subscriber of {name} confirms nothing: it is offered anew"));
        }
        Ok(())
    }

    /// Subscribes to a topic.
    pub fn subscribe<T: 'static>(&mut self, topic: &RosTopic, part: &str) -> Result<Subscription<T>> {
        let name = self.name(topic, part);
        let dds = self.topic(&name, topic)?;
        self.node.create_subscription(&dds, None).map_err(|error| anyhow!("topic {name}: {error}"))
    }

    /// Offers a service.
    pub fn serve<A, B>(&mut self, (name, (package, kind)): &RosService) -> Result<Server<A, B>>
    where
        A: Message + Clone + 'static,
        B: Message + 'static,
    {
        let name = self.place.absolute(name);
        let fail = |why: String| anyhow!("service {name}: {why}");
        let whole = Name::parse(&name).map_err(|error| fail(error.to_string()))?;
        let kind = ServiceTypeName::new(package, kind);
        // A client's call may be known before its end that takes answers, which then gets the last ones.
        let [calls, answers] =
            [false, true].map(|latched| profile(RosQos { reliable: true, latched, depth: 10 }));
        self.node
            .create_server(ServiceMapping::Enhanced, &whole, &kind, calls, answers)
            .map_err(|error| fail(error.to_string()))
    }

    /// A parameter; 0 if it is not a number.
    pub fn number(&self, name: &str) -> f64 {
        match self.node.get_parameter(name) {
            Some(ParameterValue::Double(value)) => value,
            Some(ParameterValue::Integer(value)) => value as f64,
            _ => 0.0,
        }
    }

    /// Writes to `/rosout`.
    pub fn log(&self, level: LogLevel, text: &str) {
        let (node, file) = (&self.node, "taxel");
        node.rosout_raw(Time::now(), level, node.base_name(), text, file, "", 0);
    }

    fn topic(&self, name: &str, topic: &RosTopic) -> Result<ros2_client::dds::rustdds::Topic> {
        let whole = Name::parse(name).map_err(|error| anyhow!("topic {name}: {error}"))?;
        let (package, message) = topic.message;
        let kind = MessageTypeName::new(package, message);
        let made = self.node.create_topic(&whole, kind, &profile(topic.qos));
        made.map_err(|error| anyhow!("topic {name}: {error}"))
    }
}

/// Quality of service as the middleware knows it. A reliable topic refuses a message at once if it has no
/// room: a subscriber that has stopped does not stop the board's stream.
fn profile(qos: RosQos) -> QosProfile {
    let reliability = if qos.reliable {
        Reliability::Reliable { when_full: WhenFull::Fail }
    } else {
        Reliability::BestEffort
    };
    let durability = if qos.latched { Durability::TransientLocal } else { Durability::Volatile };
    QosProfile { reliability, durability, ..QosProfile::publisher_default() }
        .history(History::KeepLast { depth: qos.depth })
}

/// Wakes a thread.
struct Unpark(Thread);

impl Wake for Unpark {
    fn wake(self: Arc<Self>) {
        self.0.unpark();
    }
}

/// Runs a future to its end in this thread, which sleeps meanwhile.
fn block_on<F: Future>(future: F) -> F::Output {
    let mut future = pin!(future);
    let waker = Waker::from(Arc::new(Unpark(thread::current())));
    let mut context = std::task::Context::from_waker(&waker);
    loop {
        match future.as_mut().poll(&mut context) {
            Poll::Ready(output) => return output,
            Poll::Pending => thread::park(),
        }
    }
}
