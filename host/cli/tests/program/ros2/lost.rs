//! What the node says of a board that is lost.

use super::peer::{Framed, Peer, Wrench, domain, until};
use ros2_client::Subscription;
use serde::Deserialize;
use std::thread::sleep;
use std::time::{Duration, Instant};
use taxel::body;
use taxel::client::Stamps;
use taxel::session::{Observer, Poll, Session};
use taxel::source::{self, SourceOptions};
use taxel_cli::ros2::{RosNode, RosParameters, RosPlace, RosShow};

/// Level of a status that is stale.
const STALE: u8 = 3;

#[derive(Debug, Deserialize)]
struct Diagnostics {
    _stamp: (i32, u32),
    _frame_id: String,
    status: Vec<Status>,
}

#[derive(Debug, Deserialize)]
struct Status {
    level: u8,
    _name: String,
    message: String,
    _hardware_id: String,
    _values: Vec<(String, String)>,
}

/// Messages that have come, and when the last one did.
struct Heard<T: 'static> {
    subscription: Subscription<T>,
    messages: Vec<T>,
    last: Instant,
}

impl<T: serde::de::DeserializeOwned> Heard<T> {
    fn of(peer: &mut Peer, name: &str, kind: (&str, &str)) -> Heard<T> {
        Heard { subscription: peer.hear(name, kind), messages: Vec::new(), last: Instant::now() }
    }

    fn listen(&mut self) {
        while let Some((message, _)) = self.subscription.take().unwrap() {
            self.messages.push(message);
            self.last = Instant::now();
        }
    }
}

impl Heard<Wrench> {
    fn presses(&self) -> bool {
        self.messages.last().is_some_and(|wrench| !wrench.is_zero())
    }

    /// Number of wrenches of 0 since something pressed.
    fn zeros(&self) -> usize {
        self.messages.iter().rev().take_while(|wrench| wrench.is_zero()).count()
    }
}

#[test]
fn a_lost_board_has_a_last_wrench_of_zero_and_is_stale_again_and_again() {
    let namespace = format!("/lost_{}", std::process::id());
    let place =
        RosPlace { domain: domain(), namespace: namespace.clone(), name: "taxel".into(), board: None };
    let node = RosNode::open(place, &RosParameters { source: "none".into(), image_hz: 50.0 }).unwrap();
    let options = SourceOptions {
        realtime: true,
        repeat: true,
        body: Some("reference".into()),
        ..SourceOptions::default()
    };
    let source = source::open(&"sim:press".parse().unwrap(), &options).unwrap();
    let mut show = RosShow::new(node, false, Some(body::read("reference").unwrap()));
    show.opened(&source).unwrap();
    let mut stamps = Stamps::start();
    let mut session = Session::over(source).unwrap();
    session.parts().0.change_scene(taxel::client::SceneChange::pressing(u16::MAX));
    let mut peer = Peer::open("lost_listener");
    let wrench = ("geometry_msgs", "WrenchStamped");
    let mut panel = Heard::<Wrench>::of(&mut peer, &format!("{namespace}/tactile/chest/wrench"), wrench);
    let mut link = Heard::<Wrench>::of(&mut peer, &format!("{namespace}/tactile/links/torso/wrench"), wrench);
    let lists = ("taxel_msgs", "Contacts");
    let mut contacts = Heard::<Framed>::of(&mut peer, &format!("{namespace}/taxel/contacts"), lists);
    let states = ("diagnostic_msgs", "DiagnosticArray");
    let mut heard = Heard::<Diagnostics>::of(&mut peer, "/diagnostics", states);
    until("forces", || {
        while let Poll::Event(event) = session.poll().unwrap() {
            let stamp = stamps.of(session.client(), &event);
            show.event(session.client(), &event, stamp).unwrap();
        }
        show.idle(session.parts().0).unwrap();
        contacts.listen();
        [&mut panel, &mut link].into_iter().for_each(Heard::listen);
        (panel.presses() && link.presses() && !contacts.messages.is_empty()).then_some(())
    });
    session.parts().0.lost("it is gone".into(), 5);
    let lost = Instant::now();
    while let Some(event) = session.note() {
        let stamp = stamps.of(session.client(), &event);
        show.event(session.client(), &event, stamp).unwrap();
    }
    while lost.elapsed() < Duration::from_secs(4) {
        show.idle(session.parts().0).unwrap();
        contacts.listen();
        heard.listen();
        [&mut panel, &mut link].into_iter().for_each(Heard::listen);
        sleep(Duration::from_millis(5));
    }
    assert_eq!([panel.zeros(), link.zeros()], [1, 1]);
    let silent = [panel.last, link.last, contacts.last].map(|last| last.elapsed() > Duration::from_secs(2));
    assert_eq!(silent, [true; 3], "after the last messages about what touched it");
    let states = heard.messages.iter().flat_map(|message| &message.status);
    let stale = states.filter(|state| state.level == STALE && state.message == "simulated: it is gone");
    assert!((3..=5).contains(&stale.count()), "once a second: {:?}", heard.messages);
}
