//! Healthy taxels are never reported.

use super::is_campaign;
use super::scripts::varied;
use super::watched::{FRAME_S, WatchedBoard};
use taxel::files::scripts;
use taxel::sim;
use taxel_core::garment::Garment;

/// 1,000 frames, or 10,000 in a campaign.
#[test]
fn a_varied_stream_of_touches_accuses_no_healthy_taxel() {
    let frames = if is_campaign() { 10_000 } else { 1_000 };
    let found = WatchedBoard::new().play(&varied(f64::from(frames) * FRAME_S, 11), frames);
    println!("{frames} frames of varied touches: {} healthy taxels accused", found.len());
    assert!(found.is_empty(), "{found:?}");
}

/// Touches vary in every frame and for each taxel, by 2 % of the signal.
#[test]
fn noise_of_what_is_pressed_is_no_fault_of_the_taxels() {
    const FRAMES: u32 = 1_000;
    let script = varied(f64::from(FRAMES) * FRAME_S, 12);
    let found = WatchedBoard::new().play_shaken(&script, FRAMES, 0.02);
    assert!(found.is_empty(), "{found:?}");
}

/// At rest, slightly pressed, and in between: in a code of the converter that is nine codes wide, noise may
/// not show.
/// not show.
#[test]
fn wide_codes_are_not_stuck() {
    for base_code in [512.0, 1530.0] {
        let mut script = varied(400.0 * FRAME_S, 13);
        (script.idle.base_code, script.converter.dnl) = (base_code, true);
        let found = WatchedBoard::new().play(&script, 400);
        assert!(found.is_empty(), "{found:?}");
    }
}

#[test]
fn no_healthy_taxel_is_accused() {
    for scene in sim::list() {
        let script = scripts::load(&scene.name).unwrap();
        let faulty = script.faults != Default::default();
        if faulty || scripts::garment(&script).unwrap() != Garment::reference() {
            continue;
        }
        let frames = (script.duration_s * 195.0) as u32;
        let found = WatchedBoard::new().play(&script, frames);
        assert!(found.is_empty(), "{}: {found:?}", scene.name);
        println!("{}: {frames} frames", scene.name);
    }
}
