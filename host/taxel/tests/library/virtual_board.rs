//! A board stepped by hand perceives what the simulated board perceives, bit for bit.

use serde_json::Value;
use taxel::client::Event;
use taxel::files::calibrate::ForceScale;
use taxel::files::scripts;
use taxel::json::message;
use taxel::session::Session;
use taxel::sim::COUNTS_PER_NEWTON;
use taxel::source::{self, SourceOptions, SourceSpec, scene_of};
use taxel::virtual_board::VirtualBoard;
use taxel_core::format::Micros;
use taxel_core::garment::{Circuit, Garment, Layout, Pins};
use taxel_core::scene::Scene;
use taxel_core::wire::Request;

/// Events that depend on codes and time alone.
const PERCEIVED: [&str; 5] = ["frame", "contacts", "symbols", "intent", "reaction"];

/// Lines of a simulated scene, and the codes of its scans.
fn simulated(scene: &str) -> (Vec<Value>, Vec<(Micros, Vec<u16>)>) {
    let spec: SourceSpec = format!("sim:{scene}").parse().unwrap();
    let mut session = Session::over(source::open(&spec, &SourceOptions::default()).unwrap()).unwrap();
    session.parts().0.stream_raw(u16::MAX).unwrap();
    let (mut lines, mut scans) = (Vec::new(), Vec::new());
    while let Some(event) = session.wait().unwrap() {
        lines.push(message(session.client(), &event));
        if let Event::Raw { time, whole: true, .. } = event {
            scans.push((time, session.client().raw().to_vec()));
        }
    }
    (lines, scans)
}

/// Lines of the board stepped through these scans.
fn stepped(scene: &str, scans: &[(Micros, Vec<u16>)]) -> Vec<Value> {
    let script = scripts::load(scene).unwrap();
    let mut board =
        VirtualBoard::new(scripts::garment(&script).unwrap(), scene_of(&script).unwrap()).unwrap();
    board.client().weigh_by(ForceScale::new(None, Some(COUNTS_PER_NEWTON)));
    let tare = Request::Tare { frames: script.tare_frames as u16 };
    if script.tare_frames > 0 {
        board.client().request(&tare).unwrap();
    }
    let mut lines = Vec::new();
    for (time, codes) in scans {
        let mut reported = |client: &_, event: &_| {
            lines.push(message(client, event));
            Ok(())
        };
        board.step(codes, *time, &mut reported).unwrap();
    }
    lines
}

fn of_kind<'a>(lines: &'a [Value], kind: &str) -> Vec<&'a Value> {
    lines.iter().filter(|line| line["type"] == kind).collect()
}

#[test]
fn by_hand_it_perceives_what_a_simulation_perceives() {
    for scene in ["pat", "lash", "two-hands", "five"] {
        let (simulated, scans) = simulated(scene);
        let stepped = stepped(scene, &scans);
        for kind in PERCEIVED {
            let (have, want) = (of_kind(&stepped, kind), of_kind(&simulated, kind));
            let differs = have.iter().zip(&want).position(|(have, want)| have != want);
            assert_eq!(differs, None, "{scene}: {kind}");
            assert!(have.len().abs_diff(want.len()) <= 1, "{scene}: {kind}: {} {}", have.len(), want.len());
        }
        assert!(of_kind(&stepped, "frame").len() > 100 && !of_kind(&stepped, "intent").is_empty(), "{scene}");
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let script = scripts::load("pat").unwrap();
    let mut board =
        VirtualBoard::new(scripts::garment(&script).unwrap(), scene_of(&script).unwrap()).unwrap();
    let codes = vec![0; board.taxels()];
    let mut quiet = |_: &_, _: &_| Ok(());
    let why = board.step(&codes[1..], Micros(0), &mut quiet).unwrap_err().to_string();
    assert_eq!(why, format!("{} codes for a garment of {} taxels", codes.len() - 1, codes.len()));
    // The board still waits for the scan that was refused.
    let mut frames = 0;
    let mut count = |_: &_, event: &taxel::client::Event| {
        frames += usize::from(matches!(event, taxel::client::Event::Frame { .. }));
        Ok(())
    };
    board.step(&codes, Micros(9), &mut count).unwrap();
    assert_eq!(frames, 1);
    let why = board.step(&codes, Micros(8), &mut quiet).unwrap_err().to_string();
    assert_eq!(why, "a step at 8 us is before the last one");
}

#[test]
fn an_array_without_wiring_is_perceived_and_never_scanned() {
    let garment = Garment::grid("mat", 12, 21, [10_000, 12_500]);
    let layout = Layout::build(&garment, 252, u16::MAX).unwrap();
    for pins in [Pins::ANY, Pins::FEATHER] {
        assert!(Circuit::build(&garment, &layout, pins).is_err(), "a board with a converter needs blocks");
    }
    let mut board = VirtualBoard::new(garment, Scene::shipped()).unwrap();
    assert_eq!((board.taxels(), board.areas().len()), (252, 1));
    board.client().request(&Request::Tare { frames: 8 }).unwrap();
    let mut touched = Vec::new();
    for frame in 0..30 {
        let mut codes = vec![130; 252];
        if frame > 19 {
            [93, 94, 114, 115].into_iter().for_each(|taxel: usize| codes[taxel] += 900);
        }
        board
            .step(&codes, Micros(frame * 16_667), &mut |client, event| {
                if let Event::Contacts { .. } = event {
                    touched = client.contacts().iter().map(|placed| placed.contact.total).collect();
                }
                Ok(())
            })
            .unwrap();
    }
    assert_eq!(touched, [3600]);
}
