//! Links only if no panic is reachable from the board that ships: the panic handler calls an undefined
//! function. Never run.
//!
//! All arguments of the calls come from outside, so the compiler knows nothing about them: any state, any
//! bytes, any codes. In `control.rs` one panic is reachable, and it must not link.
//! `cargo xtask test --only no-panic` builds both, as the firmware is built. To find a panic, define the
//! function by
//! `-Clink-arg=--defsym=a_panic_is_reachable=0` and look in the disassembly for calls of `core::panicking`.
//!
//! The loop around the board, an `async fn`, is not covered: polled again after its end it panics.
#![no_std]
#![no_main]

mod handler;

use core::hint::black_box;
use taxel_core::acquire::{Fields, Reflex, Scan, ScanError, ScanReport};
use taxel_core::board::{BoardInfo, Input, Part, Saved, Setup, Shipped};
use taxel_core::boot::{Boots, Remains, Reset, panicked};
use taxel_core::capacity::TAXELS;
use taxel_core::format::{Code, Micros};
use taxel_core::garment::Garment;
use taxel_core::gesture::{Model, TouchClassifier, TouchState};
use taxel_core::reflex::Early;
use taxel_core::scene::Scene;
use taxel_core::selftest::Findings;

/// State that a reset leaves.
#[derive(Clone, Copy)]
pub struct Left(Reset, u32);

impl Remains for Left {
    fn reset(&self) -> Reset {
        self.0
    }

    fn word(&self) -> u32 {
        self.1
    }

    fn keep(&mut self, word: u32) {
        self.1 = word;
    }
}

/// Arguments of the calls.
pub struct Given {
    call: u8,
    board: Shipped,
    now: Micros,
    bytes: &'static [u8],
    codes: &'static [Code],
    report: ScanReport,
    error: ScanError,
    saved: Result<Saved, &'static str>,
    examined: Result<Findings, ScanError>,
    part: Part,
    buffer: &'static mut [u8],
    count: usize,
    info: BoardInfo,
    garment: Garment,
    scene: Scene,
    touch: TouchState,
    image: &'static [u16],
    early: Early,
    reflex: Reflex<TAXELS>,
    frame: &'static mut [Code],
    left: Left,
}

/// Makes one call. The linker starts from here, and keeps only what it reaches.
#[unsafe(no_mangle)]
pub extern "C" fn _start(given: &mut Given) {
    let Given { board, now, bytes, codes, report, info, garment, scene, touch, image, .. } = given;
    let mut step = |input| keep(board.step(*now, input, &mut ()));
    match given.call {
        0 => step(Input::Received(bytes)),
        1 => step(Input::Scanned(Ok(Scan { codes, report: *report }))),
        2 => step(Input::Scanned(Err(given.error))),
        3 => step(Input::Saved(given.saved)),
        4 => step(Input::Tick),
        5 => keep(board.pending(*now, &mut ())),
        6 => board.sent(given.count),
        7 => keep((board.wake(), board.circuit(), board.setup(), board.state(), board.health())),
        8 => keep((Garment::reference(), Scene::shipped())),
        9 => keep(Setup::build(info, garment.clone(), scene.clone(), given.count)),
        10 => {
            keep((Shipped::bare(*info), board.set_garment(garment.clone()), board.set_scene(scene.clone())))
        }
        11 => keep(Shipped::new(*info, garment.clone(), scene.clone())),
        12 => step(Input::Examined(given.examined.clone())),
        13 => board.restore(given.part, bytes),
        14 => keep(board.settings().write(given.part, given.buffer)),
        15 => board.forgot("any"),
        16 => keep(Model::read(bytes).map(|model| {
            let touches = TouchClassifier::new(model, given.count as u16, given.call.into());
            touches.process(touch, image);
            touches.decide(touch)
        })),
        17 => step(Input::Misled),
        18 => step(Input::Reflex(given.early)),
        19 => given.reflex.watch(board.reflexes(), board.reacting(), |taxel| board.inactive_code(taxel)),
        20 => keep(given.reflex.check(given.count, codes, given.frame, *now)),
        21 => keep(Fields::of(board.circuit(), &scene.plan).map(|fields| {
            fields.each(board.circuit(), &scene.plan, |field, _, taxels| {
                given.reflex.order(field, given.count, taxels);
            });
            given.reflex.begin(fields, board.circuit().falling());
        })),
        22 => keep((given.reflex.take_early(), given.reflex.pins(given.call).count())),
        23 => given.reflex.driven(given.call, given.count > 0),
        24 => {
            let mut boots = Boots::begin(given.left, given.count > 0);
            boots.put_aside();
            boots.alive(*now);
            boots.charge(given.call);
            boots.saved();
            boots.asked();
            board.resume_saving(boots.saves().unwrap_or(given.call));
            board.booted(boots.boot());
            keep((boots, panicked(given.left.1)));
        }
        25 => keep(board.takes_message(*now)),
        26 => step(Input::SettingsReset(given.saved)),
        _ => {}
    }
}

/// Hides from the compiler that the value is not used.
fn keep<T>(value: T) {
    black_box(value);
}
