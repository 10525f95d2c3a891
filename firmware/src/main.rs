//! The taxel sensor controller: connects this board's pins, converter, link and clock to the core's loop.
#![no_std]
#![no_main]
#![deny(unsafe_code)]

mod adc;
mod board;
mod copy;
mod divide;
mod guard;
mod led;
mod levels;
mod limits;
mod link;
mod mark;
mod panic;
mod pins;
mod platform;
mod remains;
mod scan;
mod serial_number;
mod sniffer;
mod store;
mod supply;
mod watchdog;

use defmt_rtt as _;
use embassy_executor::Spawner;
use static_cell::StaticCell;
use taxel_core::acquire::{Lines, Mux};
use taxel_core::board::{BoardInfo, SetupError, Shipped};
use taxel_core::garment::Garment;
use taxel_core::scene::Scene;

/// Number of bits per byte on the line: one start bit, eight data bits, one stop bit.
const BITS_PER_BYTE: u32 = 10;

type Pool = Lines<pins::LinePin, { limits::LINES }>;

// Large objects are static, not on the stack: these, and the board, which is a part of the main task.
static LINES: StaticCell<Pool> = StaticCell::new();
static SCANNER: StaticCell<scan::Scanner> = StaticCell::new();

#[inline(never)]
fn set_garment(board: &mut Shipped) -> Result<(), SetupError> {
    board.set_garment(Garment::reference())
}

#[inline(never)]
fn set_scene(board: &mut Shipped) -> Result<(), SetupError> {
    board.set_scene(Scene::shipped())
}

/// Sets the shipped garment and scene. Functions of their own: otherwise the main task would keep their stack
/// for ever.
#[inline(never)]
fn ship(board: &mut Shipped) {
    if let Err(error) = set_garment(board).and_then(|()| set_scene(board)) {
        defmt::error!("what ships does not fit this board: {}", defmt::Display2Format(&error));
        // From here on nothing feeds the watchdog, so the board restarts and reports it again.
        loop {
            cortex_m::asm::wfe();
        }
    }
}

/// Builds the scanner from this board's parts. A function of its own, because a static is built on the stack
/// first.
#[inline(never)]
fn scanner(
    lines: [(u8, pins::LinePin); limits::LINES],
    converter: adc::Converter<{ limits::INPUTS }>,
    chain: scan::DmaChain,
) -> &'static mut scan::Scanner {
    let lines = LINES.init_with(|| Lines::new(lines));
    SCANNER.init_with(|| {
        let processor = Mux::new(lines, platform::Settle::new(), converter, platform::Timer);
        scan::Scanner::new(processor, chain)
    })
}

#[embassy_executor::main]
async fn main(_spawner: Spawner) {
    guard::put_up();
    supply::watch();
    let board::BoardParts { chip, lines, converter, chain, sniffer, mut wire, led, watchdog, flash } =
        board::take();
    let mut platform = platform::BoardPlatform::start(watchdog, led, flash, sniffer);
    const { assert!(limits::INFO.link_bytes_per_s == link::uart::BAUD / BITS_PER_BYTE) };
    let scanner = scanner(lines, converter, chain);
    let mut board = Shipped::bare(BoardInfo { chip, ..limits::INFO });
    ship(&mut board);
    platform.recall(&mut board);
    taxel_core::run::run(scanner, &mut wire, &mut platform, &mut board).await;
}
