//! Slip: reported within three frames of the start of a motion, and of no contact that is held.

use crate::random::Noise;
use crate::tracking::rig::{FRAME_US, Texture, TrackingRig, felt};
use taxel_core::contact::{ContactConfig, NO_SLIP};
use taxel_core::garment::Garment;

/// A pressure at (x, y) from the middle of the panel.
type Pressure<'a> = &'a dyn Fn(f64, f64) -> f64;

fn dome(radius: f64) -> impl Fn(f64, f64) -> f64 {
    move |x, y| {
        let pressure = |x: f64, y: f64| 0.8 * (1.0 - (x * x + y * y) / (radius * radius)).max(0.0).sqrt();
        if x.hypot(y) > radius + 1.0 { 0.0 } else { felt(x, y, pressure) }
    }
}

fn flat(radius: f64) -> impl Fn(f64, f64) -> f64 {
    move |x, y| {
        let pressure = |x: f64, y: f64| if x.hypot(y) < radius { 0.5 } else { 0.0 };
        if x.hypot(y) > radius + 1.0 { 0.0 } else { felt(x, y, pressure) }
    }
}

/// Four standard deviations of a noise of 2 %.
fn above_noise() -> ContactConfig {
    ContactConfig { low: 330, high: 660, ..ContactConfig::default() }
}

/// Held for 60 frames, then moving: frames from the first that differs until the slip is reported; none of the
/// held ones is one.
fn onset(config: ContactConfig, noise: f64, speed: f64, degrees: f64, pressure: Pressure) -> Option<usize> {
    let mut rig = TrackingRig::new(&Garment::mat(), config);
    let mut random = Noise(11);
    let (sin, cos) = degrees.to_radians().sin_cos();
    for frame in 0..90usize {
        let way = speed * frame.saturating_sub(60) as f64;
        let at = |x: f64, y: f64| pressure(x - 15.4 - way * cos, y - 31.3 - way * sin);
        rig.draw_noisy(&mut random, noise, at);
        if rig.only().slip {
            assert!(frame > 60, "held, and it slips in frame {frame}");
            return Some(frame - 60);
        }
    }
    None
}

/// A mat of 64 x 32 taxels that lie so many mm apart.
fn mat_of(mm: u32) -> Garment {
    let mut garment = Garment::mat();
    garment.panels[0].pitch_um = [1_000 * mm; 2];
    garment
}

/// The same motion is a slip or none however close the taxels lie.
#[test]
fn a_slip_is_one_of_cm_per_second() {
    let config = ContactConfig::default();
    for mm in [4, 5, 8, 10, 15] {
        // A dome of 4 cm, whose speed is reported in cm/s.
        let (taxels, pressure) = (10.0 / f64::from(mm), dome(20.0 / f64::from(mm)));
        let onset = |speed: f64| {
            let mut rig = TrackingRig::new(&mat_of(mm), config);
            (0..120usize).find(|frame| {
                let way = speed * taxels * FRAME_US as f64 / 1e6 * frame.saturating_sub(60) as f64;
                rig.draw(|x, y| pressure(x - 15.4, y - 25.3 - way));
                rig.only().slip
            })
        };
        assert_eq!((onset(0.0), onset(2.5)), (None, None), "{mm} mm");
        assert!(onset(6.0).is_some_and(|frame| (61..=63).contains(&frame)), "{mm} mm: {:?}", onset(6.0));
    }
}

/// The slip speed in taxels per frame.
fn slip_step(config: ContactConfig) -> f64 {
    f64::from(config.slip_speed) / 16.0 * FRAME_US as f64 / 1e6
}

#[test]
fn a_slip_is_reported_within_three_frames() {
    let config = ContactConfig::default();
    let things: [(&str, Pressure); 3] =
        [("a finger", &dome(2.6)), ("a palm", &dome(6.0)), ("a disc", &flat(4.2))];
    for (what, pressure) in things {
        for factor in [1.5, 3.0, 10.0, 25.0] {
            for degrees in [0.0, 31.0, 180.0] {
                let reported = onset(config, 0.0, factor * slip_step(config), degrees, pressure);
                assert!(
                    reported.is_some_and(|frame| frame <= 3),
                    "{what}, {factor} times the slip speed: {reported:?}"
                );
            }
        }
        // At half the slip speed it moves, but does not slip.
        assert_eq!(onset(config, 0.0, 0.5 * slip_step(config), 0.0, pressure), None, "{what}");
    }
}

#[test]
fn with_noise_a_slip_that_is_clear_of_it_is_reported_within_three_frames() {
    let things: [(&str, Pressure, f64); 2] = [("a finger", &dome(2.6), 0.2), ("a palm", &dome(6.0), 0.2)];
    for (what, pressure, least) in things {
        for speed in [least, 2.0 * least] {
            for degrees in [0.0, 31.0, 180.0] {
                let reported = onset(above_noise(), 0.02, speed, degrees, pressure);
                assert!(
                    reported.is_some_and(|frame| frame <= 3),
                    "{what}, {speed} taxels a frame: {reported:?}"
                );
            }
        }
    }
}

/// 24,000 frames of things that are held, with noise of 2 %; frames with a slip.
fn slips(held: Pressure) -> usize {
    let mut rig = TrackingRig::new(&Garment::mat(), above_noise());
    let mut random = Noise(5);
    let still: Vec<f64> = (0..2048).map(|i| held(f64::from(i % 32), f64::from(i / 32))).collect();
    let mut slips = 0;
    for _ in 0..24_000 {
        rig.draw_noisy(&mut random, 0.02, |x, y| still[y as usize * 32 + x as usize]);
        slips += rig.frame().present.iter().filter(|contact| contact.slip).count();
    }
    slips
}

#[test]
fn held_contacts_with_noise_never_slip() {
    let texture = Texture::new(9);
    let pad = |x: f64, y: f64| if x.abs().max(y.abs()) < 6.0 { texture.at(x, y) } else { 0.0 };
    // A finger, a single taxel, a disc with a flat top, a palm, a textured pad.
    let all = |x: f64, y: f64| {
        dome(1.8)(x - 4.3, y - 5.6)
            + flat(0.4)(x - 15.0, y - 4.0)
            + flat(4.5)(x - 24.5, y - 8.2)
            + dome(5.5)(x - 9.1, y - 24.7)
            + pad(x - 15.5, y - 46.5)
    };
    assert_eq!(slips(&all), 0);
}

#[test]
fn a_texture_that_is_held_with_noise_never_slips() {
    let texture = Texture::new(9);
    assert_eq!(slips(&|x, y| texture.at(x, y)), 0);
}

#[test]
fn a_slip_ends_with_the_motion() {
    let pressure = dome(3.0);
    let mut rig = TrackingRig::mat();
    let mut ended = None;
    for frame in 0..140usize {
        // Ten taxels per second for 60 frames.
        let way = 0.05128 * frame.clamp(30, 90) as f64;
        rig.draw(|x, y| pressure(x - 12.0 - way, y - 31.0));
        let contact = rig.only();
        assert_eq!(
            contact.slip,
            (33..=90).contains(&frame) || (frame > 90 && ended.is_none() && contact.slip)
        );
        if frame > 90 && !contact.slip {
            ended.get_or_insert(frame - 90);
        }
    }
    // The velocity falls below the slip speed: 40 ms ln(10 / 4) are 37 ms.
    assert!(ended.is_some_and(|frames| frames <= 10), "{ended:?}");
}

#[test]
fn pressing_and_lifting_is_no_slip() {
    let texture = Texture::new(2);
    for what in [&dome(2.6) as Pressure, &dome(6.0), &|x, y| texture.at(x, y) * dome(7.0)(x, y)] {
        let mut rig = TrackingRig::mat();
        for frame in 0..80 {
            let force = f64::from(frame.min(79 - frame)) / 20.0;
            rig.draw(|x, y| force.min(1.0) * what(x - 15.4, y - 31.3));
            for contact in rig.frame().present {
                assert!(!contact.slip, "frame {frame}");
                assert!(contact.dx.to_f64().hypot(contact.dy.to_f64()) < 0.5, "frame {frame}");
            }
        }
    }
}

/// Slip and displacement along y, frame by frame, of a textured square whose first column is `left` and that
/// slides along y by `speed` taxels a frame.
fn slide(left: f64, speed: f64) -> Vec<(bool, f64)> {
    let texture = Texture::new(4);
    let mut rig = TrackingRig::mat();
    let frames = (30.0 / speed.abs()).min(120.0) as usize;
    let course = (0..frames).map(|frame| {
        let way = speed * (frame as f64 - frames as f64 / 2.0);
        rig.draw(|x, y| {
            let (x, y) = (x - left, y - 31.5 - way);
            // How much of a taxel's cell lies within the square.
            let covered = (6.0 - y.abs()).clamp(0.0, 1.0);
            if (0.0..11.5).contains(&x) { covered * texture.at(x, y) } else { 0.0 }
        });
        let contact = rig.only();
        (contact.slip, contact.dy.to_f64())
    });
    course.collect()
}

/// Whether a patch slips that moves by a taxel a frame, while its pressure alternates between two values.
fn slips_between(pressures: [u16; 2]) -> bool {
    let mut rig = TrackingRig::mat();
    let mut frames = (0..24u16).map(|frame| {
        rig.values.fill(0);
        for row in 20..24 {
            let first = row * 32 + usize::from(frame);
            rig.values[first..first + 4].fill(pressures[usize::from(frame % 2)]);
        }
        rig.only().slip
    });
    frames.any(|slip| slip)
}

/// With the pressure the outline changes, and with that the centroid.
#[test]
fn a_change_of_more_than_a_sixteenth_is_no_slip() {
    assert!(slips_between([1600, 1600]));
    assert!(slips_between([1600, 1700]), "a sixteenth of 1600");
    assert!(!slips_between([1600, 1710]));
}

#[test]
fn a_touch_at_the_first_column_is_followed_as_any_other() {
    for speed in [0.05, 0.3, 0.5, 0.8, 1.3] {
        for speed in [speed, -speed] {
            assert_eq!(slide(0.0, speed), slide(3.0, speed), "{speed} taxels a frame");
        }
    }
}

#[test]
fn a_scene_that_does_not_ask_for_slip_is_not_reported() {
    let config = ContactConfig { slip_speed: NO_SLIP, ..ContactConfig::default() };
    assert_eq!(onset(config, 0.0, 0.5, 0.0, &dome(3.0)), None);
}
