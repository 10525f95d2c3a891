//! Another program's node, in the process of the tests, beside a `taxel ros2` that they start.

use ros2_client::dds::rustdds::no_key::{DataReaderCdr, DataWriterCdr};
use ros2_client::dds::rustdds::{QosPolicies, TopicKind};
use ros2_client::qos::{History, Reliability, WhenFull};
use ros2_client::{
    Client, Context, ContextOptions, Message, MessageTypeName, Name, Node, NodeName, NodeOptions, Publisher,
    QosProfile, ServiceMapping, ServiceTypeName, Subscription,
};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Longest wait for anything: the machine may be busy.
const PATIENCE: Duration = Duration::from_secs(45);

/// Domain of the nodes of this process: other programs of this machine are not heard.
pub fn domain() -> u16 {
    1 + (std::process::id() % 200) as u16
}

/// Waits for something; fails if it does not come.
pub fn until<T>(what: &str, mut come: impl FnMut() -> Option<T>) -> T {
    let began = Instant::now();
    loop {
        if let Some(it) = come() {
            return it;
        }
        assert!(began.elapsed() < PATIENCE, "not within {} s: {what}", PATIENCE.as_secs());
        sleep(Duration::from_millis(2));
    }
}

/// A `taxel ros2`, which ends with this.
pub struct Taxel {
    child: Child,
    /// Its namespace, of its own.
    pub namespace: String,
}

impl Taxel {
    /// Starts one with these arguments, in a namespace that begins with this name.
    pub fn start(name: &str, words: &[&str]) -> Taxel {
        let namespace = format!("/{name}_{}", std::process::id());
        let mut command = Command::new(env!("CARGO_BIN_EXE_taxel"));
        command.args(["ros2", "--namespace", &namespace, "--domain", &domain().to_string()]).args(words);
        let child = command.stdin(Stdio::null()).stdout(Stdio::null()).spawn().unwrap();
        Taxel { child, namespace }
    }

    /// Sends it a signal.
    pub fn signal(&self, signal: &str) {
        let done = Command::new("kill").args([signal, &self.child.id().to_string()]).status().unwrap();
        assert!(done.success(), "kill {signal}");
    }

    /// Whole name of one of its topics or services.
    pub fn name(&self, name: &str) -> String {
        format!("{}/{name}", self.namespace)
    }
}

impl Drop for Taxel {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// First fields of a message with a header and a frame's number.
#[derive(Debug, Deserialize)]
pub struct Framed {
    _stamp: (i32, u32),
    _frame_id: String,
    pub frame: u32,
}

/// `geometry_msgs/WrenchStamped`.
#[derive(Debug, Deserialize)]
pub struct Wrench {
    _stamp: (i32, u32),
    _frame_id: String,
    pub force: [f64; 3],
    torque: [f64; 3],
}

impl Wrench {
    pub fn is_zero(&self) -> bool {
        self.force.iter().chain(&self.torque).all(|value| *value == 0.0)
    }
}

/// Request of `std_srvs/Trigger`.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Trigger(pub u8);

/// Request of `taxel_msgs/SetScene`.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct SetScene(pub String);

/// Answer of both.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Done {
    pub success: bool,
    pub message: String,
}

impl Message for Trigger {}
impl Message for SetScene {}
impl Message for Done {}

/// Types of the services.
pub const TRIGGER: (&str, &str) = ("std_srvs", "Trigger");
pub const SET_SCENE: (&str, &str) = ("taxel_msgs", "SetScene");

/// The other program's node.
pub struct Peer {
    context: Context,
    node: Node,
}

impl Peer {
    pub fn open(name: &str) -> Peer {
        let context = Context::with_options(ContextOptions::new().domain_id(domain())).unwrap();
        let name = NodeName::new("/peers", name).unwrap();
        let node = context.new_node(name, NodeOptions::new()).unwrap();
        Peer { context, node }
    }

    /// Subscribes as programs do by default: reliably.
    pub fn hear<T: 'static>(&mut self, name: &str, (package, kind): (&str, &str)) -> Subscription<T> {
        let kind = MessageTypeName::new(package, kind);
        let topic = self.node.create_topic(&Name::parse(name).unwrap(), kind, &reliable(1000)).unwrap();
        self.node.create_subscription(&topic, None).unwrap()
    }

    /// Publishes reliably.
    pub fn publish_to<T: Serialize>(&mut self, name: &str, (package, kind): (&str, &str)) -> Publisher<T> {
        let kind = MessageTypeName::new(package, kind);
        let topic = self.node.create_topic(&Name::parse(name).unwrap(), kind, &reliable(10)).unwrap();
        self.node.create_publisher(&topic, None).unwrap()
    }

    /// A client of a service, once it has answered a first call: a service may be found before it has found
    /// the client, whose calls it then does not hear.
    pub fn client<A: Message + Clone + 'static>(
        &mut self,
        name: &str,
        (package, kind): (&str, &str),
        first: A,
    ) -> Client<A, Done> {
        let (called, kind) = (Name::parse(name).unwrap(), ServiceTypeName::new(package, kind));
        let client =
            self.node.create_client(ServiceMapping::Enhanced, &called, &kind, reliable(64), reliable(64));
        self.find(name);
        let client = client.unwrap();
        let (mut last, mut polls) = (None, 0);
        until("an answer to a first call", || {
            if polls % 500 == 0 {
                last = Some(client.send_request(first.clone()).unwrap());
            }
            polls += 1;
            let mut answers = std::iter::from_fn(|| client.receive_response().unwrap());
            answers.any(|(id, _)| Some(id) == last).then_some(())
        });
        client
    }

    /// Waits until both ends of a service are found.
    pub fn find(&self, service: &str) {
        let of = self.context.domain_participant();
        let [calls, answers] = ends(service);
        until(&calls, || {
            let readers = of.discovered_readers();
            readers.iter().any(|one| *one.subscription_topic_data.topic_name() == calls).then_some(())
        });
        until(&answers, || {
            let writers = of.discovered_writers();
            writers.iter().any(|one| one.publication_topic_data.topic_name == answers).then_some(())
        });
    }

    /// The end of a client that calls a service of this kind, without the one that takes answers.
    pub fn caller<A: Serialize>(&self, service: &str, kind: &str) -> DataWriterCdr<A> {
        let (of, qos) = (self.context.domain_participant(), QosPolicies::from(reliable(10)));
        let [calls, _] = ends(service);
        let topic = of.create_topic(calls, format!("{kind}_Request_"), &qos, TopicKind::NoKey).unwrap();
        of.create_publisher(&qos).unwrap().create_datawriter_no_key_cdr(&topic, None).unwrap()
    }

    /// The end of a client that takes answers.
    pub fn answered<B: DeserializeOwned + 'static>(&self, service: &str, kind: &str) -> DataReaderCdr<B> {
        let (of, qos) = (self.context.domain_participant(), QosPolicies::from(reliable(10)));
        let [_, answers] = ends(service);
        let topic = of.create_topic(answers, format!("{kind}_Response_"), &qos, TopicKind::NoKey).unwrap();
        of.create_subscriber(&qos).unwrap().create_datareader_no_key_cdr(&topic, None).unwrap()
    }
}

/// Topics of the middleware for the calls of a service, and for its answers.
fn ends(service: &str) -> [String; 2] {
    [format!("rq{service}Request"), format!("rr{service}Reply")]
}

fn reliable(depth: usize) -> QosProfile {
    let reliability = Reliability::Reliable { when_full: WhenFull::Block };
    QosProfile { reliability, ..QosProfile::publisher_default() }.history(History::KeepLast { depth })
}
