//! How sure a gesture is: reported with it, and asked of what is announced.

use crate::board::{BoardAndHost, FINGER};
use taxel_core::format::Q15;
use taxel_core::gesture::GestureConfig;
use taxel_core::scene::Scene;
use taxel_core::wire::{Report, Request};

/// Of one touch of a finger, held for 3 s: of each gesture that is reported, whether the touch is over, and the
/// confidence.
fn touch(bench: &mut BoardAndHost) -> Vec<(bool, Q15)> {
    let mut reported = Vec::new();
    for scan in 0..900 {
        bench.press(&FINGER, if scan < 600 { 900 } else { 0 });
        bench.scan();
        bench.drain(usize::MAX, |report| {
            if let Report::Gesture(report) = report {
                reported.push((report.ended, report.confidence.expect("this model knows it")));
            }
        });
    }
    assert_eq!(reported.iter().filter(|(ended, _)| *ended).count(), 1, "a touch ends once: {reported:?}");
    reported
}

fn demand(bench: &mut BoardAndHost, certainty: u16) -> Option<String> {
    let gestures = Some(GestureConfig { certainty, ..GestureConfig::default() });
    let scene = Scene { gestures, ..bench.board.setup().scene.clone() };
    bench.answer(&Request::SetScene(&postcard::to_allocvec(&scene).unwrap()))
}

#[test]
fn a_certainty_is_asked_of_what_is_announced() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    bench.ask(&Request::Start);
    bench.ask(&Request::Tare { frames: 1 });
    bench.scan();
    bench.drain(usize::MAX, |_| ());
    assert_eq!(demand(&mut bench, 0), None);
    let reported = touch(&mut bench);
    let surest = reported.iter().filter(|(ended, _)| !ended).map(|(_, sure)| *sure).max();
    let surest = surest.expect("at first all is announced");
    assert!(surest > Q15(0) && surest < Q15::ratio(999, 1000), "{reported:?}");

    assert_eq!(demand(&mut bench, 999), None);
    let why = demand(&mut bench, 1000).unwrap();
    assert_eq!(why, "scene: gestures.certainty must be at most 999 (0.999)");
    assert_eq!(touch(&mut bench).len(), 1, "nothing is that sure before the end");
    assert_eq!(demand(&mut bench, 0), None);
    assert!(touch(&mut bench).len() > 1, "all is announced again");
}
