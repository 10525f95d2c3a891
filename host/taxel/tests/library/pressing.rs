//! What presses on the robot, computed from frames, against what the board says of them.

use std::collections::BTreeMap;
use taxel::body::{self, DVec3};
use taxel::client::{Client, Event, ImageNews};
use taxel::error::Error;
use taxel::json::computed_pressing;
use taxel::session::{Returns, Session};
use taxel::source::{self, SourceOptions};
use taxel_core::wire::PressingReport;

/// A contact: its link, its place (m) and its force (counts).
type Push = (String, DVec3, DVec3);

/// What was computed for each frame, and what the board said.
#[derive(Default)]
struct Both {
    computed: BTreeMap<u32, BTreeMap<u32, Push>>,
    /// Sum of the magnitudes on all links, counts.
    pressed: BTreeMap<u32, u32>,
    reported: Vec<PressingReport>,
}

impl Both {
    fn event(&mut self, client: &Client, event: &Event) -> Result<(), Error> {
        match event {
            Event::Frame { frame, time, image: ImageNews::Whole, .. } => {
                let description = client.description().unwrap();
                let surface = body::read("reference")?.surface(&description.garment, &description.layout)?;
                let line = computed_pressing(client, *time, &description.layout, &surface).unwrap();
                assert_eq!((line.frame, line.time_us), (*frame, time.0));
                let push = |landed: &taxel::json::lines::LandedLine<'_>| {
                    let force = DVec3::from(landed.own.force_counts.map(f64::from));
                    (landed.id, (landed.link.to_string(), DVec3::from(landed.own.at_m), force))
                };
                self.computed.insert(*frame, line.contacts.iter().map(push).collect());
                self.pressed.insert(*frame, line.links.iter().map(|wrench| wrench.pressed_counts).sum());
            }
            Event::Pressing(report) => self.reported.push((**report).clone()),
            _ => {}
        }
        Ok(())
    }
}

/// Five touches that slide over curved links: places within 0.1 mm, forces of more than 1,000 counts within 5 %.
#[test]
fn the_host_computes_what_a_board_says() {
    let options =
        SourceOptions { body: Some("reference".into()), frames: Some(260), ..SourceOptions::default() };
    let source = source::open(&"sim:five".parse().unwrap(), &options).unwrap();
    let mut session = Session::new(source, Returns::Never);
    let tare = session.source().tare;
    session.parts().0.start(tare).unwrap();
    session.parts().0.change_scene(taxel::client::SceneChange::pressing(u16::MAX));
    let mut both = Both::default();
    while let Some(event) = session.wait().unwrap() {
        both.event(session.client(), &event).unwrap();
    }
    let (mut compared, mut farthest, mut worst) = (0, 0.0f64, 0.0f64);
    for report in &both.reported {
        let Some(computed) = both.computed.get(&report.frame) else { continue };
        for landed in &report.contacts {
            // A contact's list may be left out where the link has no room.
            let Some((link, at, force)) = computed.get(&landed.id) else { continue };
            let name = report.links.iter().find(|wrench| wrench.link == landed.spot.link).unwrap();
            assert_eq!(link, name.name.as_str());
            let reported = DVec3::from(landed.spot.at.map(|um| f64::from(um) * 1e-6));
            farthest = farthest.max(at.distance(reported));
            let board = DVec3::from(landed.force.map(f64::from));
            // The board also counts what its filter cuts from a crest: of a light touch that is much.
            if landed.force.iter().any(|part| part.abs() > 1_000) {
                worst = worst.max(force.distance(board) / board.length());
            }
            compared += 1;
        }
    }
    println!("{compared} contacts: {:.2} mm, {:.2} % of the force", farthest * 1e3, worst * 1e2);
    assert!(compared > 500 && farthest < 1e-4 && worst < 0.05, "{compared}, {farthest} m, {worst}");
    // Held by all five, the links feel as much.
    let pressed = |report: &PressingReport| report.links.iter().map(|wrench| wrench.pressed).sum::<u32>();
    let held = both.reported.iter().filter(|report| both.pressed.contains_key(&report.frame));
    let held = held.max_by_key(|report| pressed(report)).unwrap();
    let (board, host) = (pressed(held), both.pressed[&held.frame]);
    assert!(held.contacts.len() == 5 && board.abs_diff(host) < board / 20, "{board}, {host}");
}
