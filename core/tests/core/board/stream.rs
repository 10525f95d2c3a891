//! Images, contacts and reactions in the stream: what goes first, what is thinned, and what never is.

use super::{BoardAndHost, FINGER, TAXELS};
use std::collections::BTreeMap;
use taxel_core::board::Job;
use taxel_core::contact::Phase;
use taxel_core::format::name;
use taxel_core::garment::Line;
use taxel_core::react::{Cause, ReactionConfig};
use taxel_core::scene::Scene;
use taxel_core::wire::{Report, Request, decode_image, image_sum};

#[test]
fn frames_decode_to_the_image_of_the_board_alone_or_from_their_base() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    bench.ask(&Request::Start);
    bench.drain(usize::MAX, |_| ());
    let (mut image, mut last, mut alone, mut differing) = ([0u16; TAXELS], None, 0, 0);
    for step in 0..500u16 {
        bench.press(&FINGER, if step % 100 < 50 { 600 + step } else { 0 });
        bench.scan();
        let mut copy = (image, last);
        bench.drain(usize::MAX, |report| {
            let Report::Frame(frame) = report else { return };
            let base = copy.0;
            match frame.base {
                Some(number) => {
                    assert_eq!(Some(number), copy.1);
                    differing += 1;
                }
                None => alone += 1,
            }
            decode_image(frame.data, frame.base.map(|_| &base[..]), &mut copy.0).unwrap();
            assert_eq!(image_sum(&copy.0), frame.sum);
            copy.1 = Some(frame.frame);
        });
        (image, last) = copy;
        assert_eq!(last, Some(u32::from(step) + 1));
        assert_eq!(image[17], if step % 100 < 50 { 600 + step } else { 0 });
    }
    assert!((3..=4).contains(&alone) && differing > 490, "{alone} key frames in 2.5 s, {differing} others");
}

/// A key frame takes longer to encode, so it avoids the frames that measure the form of a large contact.
#[test]
fn a_key_frame_is_one_that_measures_little() {
    let mut scene = Scene::shipped();
    scene.stream.form_ages = true;
    let mut bench = BoardAndHost::new(scene);
    bench.ask(&Request::Start);
    bench.drain(usize::MAX, |_| ());
    let large: Vec<usize> = (0..64).filter(|taxel| taxel % 16 < 5).collect();
    let (mut keys, mut measured) = (Vec::new(), Vec::new());
    for step in 0..4_000u16 {
        bench.press(&large, 900 + step % 7);
        [8, 11, 14].iter().for_each(|column| bench.press(&[16 + column, 32 + column], 600 + step % 100));
        bench.scan();
        let now = bench.now;
        let mut old = false;
        bench.drain(usize::MAX, |report| match report {
            // The large contact lies first, so its id is 1.
            Report::Contacts(list) => old = list.form_ages.iter().any(|(contact, _)| *contact == 1),
            Report::Frame(frame) if frame.base.is_none() => keys.push((step, now)),
            _ => {}
        });
        measured.push(!old);
    }
    assert!(keys.len() > 10, "{} key frames", keys.len());
    for pair in keys.windows(2) {
        let gap = pair[1].1 - pair[0].1;
        assert!((937_500..=1_000_000).contains(&gap), "{gap} us between key frames");
    }
    let turns = measured.iter().filter(|large| **large).count();
    assert!((990..=1010).contains(&turns), "one form of four a frame: {turns}");
    for (step, _) in &keys[1..] {
        let step = usize::from(*step);
        assert!(!measured[step] && !measured[step + 1], "key frame {step} measures the large contact");
    }
}

#[test]
fn a_slow_link_thins_updates_and_images_but_no_onset_and_no_release() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    bench.ask(&Request::Start);
    bench.drain(usize::MAX, |_| ());
    let mut seen: BTreeMap<u32, Vec<Phase>> = BTreeMap::new();
    for step in 0..2_000 {
        bench.press(&FINGER, if step % 20 < 9 { 800 } else { 0 });
        bench.scan();
        bench.tick();
        // 20 bytes in 5 ms: 4 kB/s.
        bench.drain(20, |report| {
            if let Report::Contacts(list) = report {
                for placed in &list.contacts {
                    let phases = seen.entry(placed.contact.id).or_default();
                    if phases.last() != Some(&placed.contact.phase) {
                        phases.push(placed.contact.phase);
                    }
                }
            }
        });
    }
    let health = *bench.board.health();
    assert!(health.thinned_frames > 500 && health.thinned_contacts > 100, "{health:?}");
    assert_eq!(health.lost, 0);
    seen.pop_last();
    assert!(seen.len() > 90, "{}", seen.len());
    for (id, phases) in &seen {
        assert_eq!(phases.first(), Some(&Phase::Onset), "contact {id}");
        assert_eq!(phases.last(), Some(&Phase::Released), "contact {id}");
    }
}

#[test]
fn over_pressure_reacts_in_its_frame_and_drives_the_pin() {
    let mut scene = Scene::shipped();
    scene.react = [ReactionConfig {
        name: name("ouch"),
        cause: Cause::Pressure,
        region: name("mat"),
        level: 3000,
        hysteresis: 500,
        hold_ms: 20,
        output: Some(Line { pin: 24, inverted: true }),
    }]
    .into_iter()
    .collect();
    let mut bench = BoardAndHost::new(scene);
    bench.ask(&Request::Start);
    assert_eq!(bench.tick(), Some(Job::Drive(24, true)), "at rest, inverted");
    let mut course = Vec::new();
    for code in [0, 2999, 3000, 2600, 2400, 0, 0, 0, 0, 0, 0] {
        bench.press(&FINGER, code);
        bench.scan();
        bench.drain(usize::MAX, |report| {
            if let Report::Reaction(reported) = report {
                course.push((code, reported.reaction.active, reported.reaction.value));
            }
        });
        while let Some(Job::Drive(pin, level)) = bench.tick() {
            course.push((pin.into(), level, -1));
        }
    }
    // Active from the frame of 3000 on; 2600 keeps it; 20 ms (four frames) after that it ends.
    assert_eq!(course, [(3000, true, 3000), (24, false, -1), (0, false, 0), (24, true, -1)]);
}

#[test]
fn what_waits_to_be_done_keeps_no_pin_from_being_driven() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    let scene = postcard::to_allocvec(&Scene::shipped()).expect("it fits");
    for _ in 0..20 {
        bench.ask(&Request::SelfTest);
        bench.ask(&Request::SetScene(&scene));
    }
    let mut jobs = Vec::new();
    while let Some(job) = bench.tick() {
        jobs.push(job);
        if let Job::Scan(_) = job {
            bench.scan();
        }
        if jobs.len() == 12 {
            break;
        }
    }
    assert_eq!(jobs[..2], [Job::Drive(18, false), Job::Drive(19, false)]);
    // Four of them wait; whoever asks without end keeps nothing from being scanned.
    let (works, scans): (Vec<Job>, Vec<Job>) = jobs[2..10].iter().partition(|job| **job == Job::Examine);
    assert_eq!((works.len(), scans.len()), (4, 4));
    assert!(jobs[2..].chunks(2).all(|two| matches!(two[1], Job::Scan(_))), "{jobs:?}");
}
