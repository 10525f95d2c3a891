//! Settings in the flash of the emulated board: one save, one restart, one save in whose midst the power fails.
//! `cargo xtask test --only emulator-store`.

use crate::board::Emulated;
use std::path::Path;
use taxel_core::capacity::TAXELS;
use taxel_core::format::name;
use taxel_core::garment::Garment;
use taxel_core::scene::Scene;
use taxel_core::wire::{Hello, Report, Request};

/// Garment and scene of a board that has just started.
fn setup(board: &mut Emulated) -> (Garment, Scene) {
    loop {
        let message = board.receive();
        if let Report::Hello(Hello { garment, scene, .. }) = message.report() {
            return (postcard::from_bytes(garment).unwrap(), postcard::from_bytes(scene).unwrap());
        }
    }
}

fn set(board: &mut Emulated, scene: &Scene) {
    let scene = postcard::to_allocvec(scene).unwrap();
    board.obey(&Request::SetScene(&scene));
}

#[test]
fn a_save_survives_a_restart_and_a_power_cut() {
    let flash = Path::new(env!("CARGO_TARGET_TMPDIR")).join("settings.bin");
    let _ = std::fs::remove_file(&flash);
    let kept = ["--loop", "--flash", flash.to_str().unwrap()];
    let mut garment = Garment::reference();
    let codes: Vec<u16> = (0..TAXELS).map(|taxel| 100 + (taxel * 1367 % TAXELS) as u16).collect();

    let mut board = Emulated::start(&garment, &codes, 0, &kept);
    assert_eq!(setup(&mut board), (Garment::reference(), Scene::shipped()));
    garment.name = name("stored");
    let bytes = postcard::to_allocvec(&garment).unwrap();
    board.obey(&Request::SetGarment(&bytes));
    let old = Scene { name: name("old"), ..Scene::shipped() };
    set(&mut board, &old);
    board.play();
    board.obey(&Request::Tare { frames: 4 });
    board.obey(&Request::Start);
    board.ask(&Request::Save);
    let mut announced = false;
    loop {
        match board.receive().report() {
            Report::Log(log) => announced |= log.text.starts_with("scanning stops"),
            Report::Answer(answer) if answer.request == Request::Save.number() => {
                assert_eq!(answer.refusal, None);
                break;
            }
            _ => {}
        }
    }
    assert!(announced);
    let lost = loop {
        if let Report::Health(health) = board.receive().report() {
            break health.overruns;
        }
    };
    println!("a save of 2,048 taxels: {lost} frames lost");
    assert!((1..=200).contains(&lost), "erasing takes its time, and is counted");
    board.end();

    // It rests from the first scan on: a baseline would follow lower codes downwards.
    let mut board = Emulated::run(&garment, &codes, &[&kept[..], &["--cut", "3"]].concat());
    assert_eq!(setup(&mut board), (garment.clone(), old.clone()));
    board.obey(&Request::Start);
    // The baseline came back, too: what the garment shows at rest is no touch.
    loop {
        match board.receive().report() {
            Report::Contacts(list) => panic!("{} contacts at rest", list.contacts.len()),
            Report::Frame(frame) if frame.frame > 20 => break,
            _ => {}
        }
    }
    let new = Scene { name: name("new"), ..Scene::shipped() };
    set(&mut board, &new);
    board.ask(&Request::Save);
    board.end_of_power();

    let mut board = Emulated::start(&garment, &codes, 0, &kept);
    let (after, scene) = setup(&mut board);
    assert!(after == garment && (scene == old || scene == new), "{}", scene.name);
    board.end();
}
