//! How the emulated board comes to start: after resets by the watchdog, with a grounded pin, because a host
//! asks for it.
//! `cargo xtask test --only emulator-boots`.

use crate::board::Emulated;
use std::path::{Path, PathBuf};
use taxel_core::boot::{Aside, Boot, BootCause};
use taxel_core::capacity::TAXELS;
use taxel_core::format::{Name, name};
use taxel_core::garment::Garment;
use taxel_core::scene::Scene;
use taxel_core::wire::{Hello, Report, Request};

/// The pin of the LED, which somebody may ground.
const LED: &str = "13";

/// The file of a flash that holds nothing yet.
fn blank(of: &str) -> PathBuf {
    let flash = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("boots-{of}.bin"));
    let _ = std::fs::remove_file(&flash);
    flash
}

/// A board with that flash, which the watchdog may reset.
fn start(flash: &Path, options: &[&str]) -> Emulated {
    let kept = ["--restarts", "--flash", flash.to_str().unwrap()];
    let options = [&kept[..], options].concat();
    let mut board = Emulated::start(&Garment::reference(), &[100; TAXELS], 100, &options);
    // A reset cuts off what is being sent.
    board.forgiving = true;
    board
}

/// Name of the scene with which the board started, and how it came to start; what it said in lives before is
/// passed over.
fn started(board: &mut Emulated, is_it: impl Fn(Boot) -> bool) -> (Name, Boot) {
    loop {
        match board.receive().report() {
            Report::Hello(Hello { scene, boot: Some(boot), .. }) if is_it(boot) => {
                return (postcard::from_bytes::<Scene>(scene).unwrap().name, boot);
            }
            _ => {}
        }
    }
}

/// Waits for the answer to a request.
fn done(board: &mut Emulated, request: &Request<'_>) {
    board.ask(request);
    loop {
        match board.receive().report() {
            Report::Answer(answer) if answer.request == request.number() => {
                return assert_eq!(answer.refusal, None);
            }
            _ => {}
        }
    }
}

/// Saves a scene of that name.
fn save(board: &mut Emulated, text: &str) {
    let scene = postcard::to_allocvec(&Scene { name: name(text), ..Scene::shipped() }).unwrap();
    done(board, &Request::SetScene(&scene));
    done(board, &Request::Save);
}

#[test]
fn three_resets_by_the_watchdog_lead_to_what_ships_and_what_is_saved_is_kept() {
    let flash = blank("resets");
    let mut board = start(&flash, &[]);
    assert_eq!(started(&mut board, |_| true), (name("shipped"), Boot::default()));
    save(&mut board, "saved");
    for resets in 1..=4 {
        let hung = board.look("hang").as_f64().unwrap();
        let reset = board.wait_for("reset");
        assert_eq!(reset["reset"], "watchdog");
        let after_ms = (reset["us"].as_f64().unwrap() - hung) / 1e3;
        assert!((500.0..=1000.0).contains(&after_ms), "{after_ms} ms after the loop stopped");
        let (scene, boot) = started(&mut board, |boot| boot.resets == resets);
        let (used, aside) = if resets < 3 { ("saved", Aside::No) } else { ("shipped", Aside::Resets) };
        println!("reset {resets}: {} after {after_ms:.0} ms, {boot:?}", scene);
        assert_eq!((scene.as_str(), boot), (used, Boot { cause: BootCause::Watchdog, resets, aside }));
    }
    board.end();
    let mut board = start(&flash, &[]);
    assert_eq!(started(&mut board, |_| true), (name("saved"), Boot::default()), "the power came again");
    board.end();
}

#[test]
fn a_supply_that_sags_resets_the_chip_and_costs_nothing_that_is_saved() {
    let flash = blank("sags");
    let mut board = start(&flash, &[]);
    started(&mut board, |_| true);
    save(&mut board, "saved");
    // A reset by the watchdog is counted, until the power goes.
    board.look("hang");
    board.wait_for("reset");
    started(&mut board, |boot| boot.resets == 1);
    // The chip's own threshold would let it write the flash with 900 mV.
    for (millivolts, browns) in [(950, false), (900, true)] {
        assert_eq!(board.sag(millivolts), browns, "{millivolts} mV");
    }
    let reported = started(&mut board, |boot| boot.cause == BootCause::Power);
    assert_eq!(reported, (name("saved"), Boot::default()));
    board.end();
}

#[test]
fn a_request_or_a_grounded_pin_leads_to_what_ships_and_back() {
    let flash = blank("asked");
    let mut board = start(&flash, &[]);
    // Before its first word a board does not listen.
    started(&mut board, |_| true);
    save(&mut board, "saved");
    for (undo, used, aside) in [(false, "shipped", Aside::Request), (true, "saved", Aside::No)] {
        done(&mut board, &Request::ResetSettings { undo });
        assert_eq!(board.wait_for("reset")["reset"], "program");
        let reported = started(&mut board, |boot| boot.cause == BootCause::Request && boot.aside == aside);
        assert_eq!(reported, (name(used), Boot { cause: BootCause::Request, resets: 0, aside }));
    }
    board.end();
    let mut board = start(&flash, &["--ground", LED]);
    let boot = Boot { aside: Aside::Pin, ..Boot::default() };
    assert_eq!(started(&mut board, |_| true), (name("shipped"), boot));
    board.end();
    let mut board = start(&flash, &["--reset-by", "pin"]);
    let boot = Boot { cause: BootCause::Pin, ..Boot::default() };
    assert_eq!(started(&mut board, |_| true), (name("saved"), boot));
    board.end();
}

#[test]
fn the_serial_number_on_usb_is_the_unique_id_of_the_flash() {
    let number = |options: &[&str]| {
        let options = [&["--link", "usb"], options].concat();
        let mut board = Emulated::start(&Garment::reference(), &[100; TAXELS], 100, &options);
        let known = board.wait_for("usb");
        board.end();
        known["usb"]["number"].clone()
    };
    assert_eq!(number(&[]), "E6605838832F5C29");
    assert_eq!(number(&["--unique-id", "00d1a30907f0be00"]), "00D1A30907F0BE00");
    // A chip that knows no such command answers nothing.
    assert_eq!(number(&["--unique-id", "ffffffffffffffff"]), serde_json::Value::Null);
    assert_eq!(number(&["--unique-id", "0000000000000000"]), serde_json::Value::Null);
}
