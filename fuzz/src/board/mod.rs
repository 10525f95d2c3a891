//! A board, step by step: whatever is asked of it behind a valid CRC, whatever its scans and its platform say,
//! and whenever.

mod bench;
mod garments;

use crate::bytes::Bytes;
use crate::plain::framed;
use bench::Bench;
use taxel_core::acquire::ScanError;
use taxel_core::board::{Input, Part, Saved};
use taxel_core::capacity::{PARTS, RUNS, TAXELS};
use taxel_core::format::{Code, Micros};
use taxel_core::reflex::Early;
use taxel_core::selftest::Findings;
use taxel_core::wire::Request;

/// Actions of an input at most: a fuzzer has more of many short ones than of a long one.
const ACTIONS: usize = 400;

/// Runs a board through the actions that the bytes are. The first chooses its garment.
pub fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let garment = bytes.byte();
    if garment & 1 == 0 {
        through(&mut Bench::<64, 32, 32>::new(garments::small(garment >> 1)), bytes);
    } else {
        through(&mut Bench::<TAXELS, RUNS, PARTS>::new(garments::large(garment >> 1)), bytes);
    }
}

fn through<const T: usize, const R: usize, const P: usize>(bench: &mut Bench<T, R, P>, mut bytes: Bytes<'_>) {
    for _ in 0..ACTIONS {
        if bytes.is_empty() {
            break;
        }
        act(bench, &mut bytes);
    }
    bench.drain(usize::MAX);
    bench.restart();
    bench.drain(usize::MAX);
}

/// One action.
fn act<const T: usize, const R: usize, const P: usize>(bench: &mut Bench<T, R, P>, bytes: &mut Bytes<'_>) {
    match bytes.byte() % 20 {
        0 => bench.turn(),
        1 => bench.press(bytes.short(), bytes.byte(), Code(bytes.short())),
        2 => bench.pass(u64::from(bytes.short())),
        3 => bench.pass(1 << (bytes.byte() % 64)),
        4 => bench.receive(&framed(bytes.piece())),
        5 => bench.receive(bytes.piece()),
        6 => {
            let garment = postcard::to_allocvec(bench.garment()).unwrap_or_default();
            ask(bench, &Request::SetGarment(&bytes.change(garment)));
        }
        7 => {
            let scene = postcard::to_allocvec(bench.scene()).unwrap_or_default();
            ask(bench, &Request::SetScene(&bytes.change(scene)));
        }
        8 => bench.overruns = bytes.word(),
        9 => bench.temperature = bytes.value(),
        10 => bench.step(Input::Scanned(Err(failure(bytes)))),
        11 => {
            let found = bytes.value::<Findings>().ok_or_else(|| failure(bytes));
            bench.step(Input::Examined(found));
        }
        12 => bench.step(Input::Misled),
        13 => {
            let early = early(bytes);
            bench.step(Input::Reflex(early));
        }
        14 => bench.step(Input::Saved(result(bytes))),
        15 => bench.step(Input::SettingsReset(result(bytes))),
        16 => bench.drain(bytes.byte().into()),
        17 => bench.restart(),
        18 => {
            let part = Part::ALL[usize::from(bytes.byte()) % Part::ALL.len()];
            bench.restore(part, bytes.piece());
        }
        _ => (0..bytes.byte()).for_each(|_| bench.turn()),
    }
}

fn ask<const T: usize, const R: usize, const P: usize>(bench: &mut Bench<T, R, P>, request: &Request<'_>) {
    bench.receive(&framed(&postcard::to_allocvec(request).unwrap_or_default()));
}

fn failure(bytes: &mut Bytes<'_>) -> ScanError {
    let (pin, taxel) = (bytes.byte(), bytes.short());
    match bytes.byte() % 6 {
        0 => ScanError::Output(pin),
        1 => ScanError::Line { pin, taxel },
        2 => ScanError::Converter { input: pin, taxel },
        3 => ScanError::Conversion,
        4 => ScanError::OutOfStep,
        _ => ScanError::NoPin(pin),
    }
}

fn early(bytes: &mut Bytes<'_>) -> Early {
    Early {
        index: bytes.byte() % 16,
        time: Micros(bytes.word().into()),
        taxel: bytes.short(),
        code: Code(bytes.short()),
        other: (bytes.byte() % 2 == 1).then(|| bytes.short()),
    }
}

fn result(bytes: &mut Bytes<'_>) -> Result<Saved, &'static str> {
    match bytes.byte() % 3 {
        0 => Ok(Saved::Written),
        1 => Ok(Saved::Unchanged),
        _ => Err("the flash cannot be read or written"),
    }
}
