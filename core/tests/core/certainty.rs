//! How sure a gesture is: told before it, and asked of what is announced, whichever model is asked for later.

use crate::board::{BoardAndHost, FINGER};
use taxel_core::format::Q15;
use taxel_core::gesture::GestureConfig;
use taxel_core::scene::Scene;
use taxel_core::wire::{Report, Request};

/// Of one touch of a finger, held for 3 s: of each gesture that is told, whether the touch is over, and the
/// confidence.
fn touch(bench: &mut BoardAndHost) -> Vec<(bool, Q15)> {
    let (mut before, mut told) = (None, Vec::new());
    for scan in 0..900 {
        bench.press(&FINGER, if scan < 600 { 900 } else { 0 });
        bench.scan();
        bench.drain(usize::MAX, |report| match report {
            Report::Confidence(report) => assert_eq!(before.replace(*report), None, "of no gesture"),
            Report::Gesture(report) => {
                let sure = before.take().expect("its confidence was told before it");
                assert_eq!((sure.frame, sure.time, sure.touch), (report.frame, report.time, report.touch));
                told.push((report.ended, sure.confidence));
            }
            _ => {}
        });
    }
    assert_eq!(before, None, "of no gesture");
    assert_eq!(told.iter().filter(|(ended, _)| *ended).count(), 1, "a touch ends once: {told:?}");
    told
}

#[test]
fn a_certainty_is_asked_of_all_models_until_another_comes() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    bench.ask(&Request::Start);
    bench.ask(&Request::Tare { frames: 1 });
    bench.scan();
    bench.drain(usize::MAX, |_| ());
    let gestures = Request::SetGestures(Some(GestureConfig::default()));
    assert_eq!(bench.answer(&gestures), None);
    let told = touch(&mut bench);
    let surest = told.iter().filter(|(ended, _)| !ended).map(|(_, sure)| *sure).max();
    let surest = surest.expect("at first all is announced");
    assert!(surest > Q15(0) && surest < Q15::ratio(999, 1000), "{told:?}");

    assert_eq!(bench.answer(&Request::SetCertainty(999)), None);
    let why = bench.answer(&Request::SetCertainty(1000)).unwrap();
    assert_eq!(why, "gestures.certainty must be at most 999 (0.999)");
    assert_eq!(touch(&mut bench).len(), 1, "nothing is that sure before the end");
    assert_eq!(bench.answer(&gestures), None);
    assert_eq!(touch(&mut bench).len(), 1, "it stays");
    assert_eq!(bench.answer(&Request::SetCertainty(0)), None);
    assert!(touch(&mut bench).len() > 1, "all is announced again");
}
