//! bring-up
#![no_std]
#![no_main]
#![deny(unsafe_code)]

mod adc;
mod board;
mod link;
mod mark;
mod panic;
mod pins;
mod platform;

use defmt_rtt as _;
use embassy_executor::Spawner;
use static_cell::StaticCell;
use taxel_core::acquire::{Acquire, Clock, Lines, MuxScan, Plan};
use taxel_core::garment::{Circuit, Garment, Layout, Pins};

#[embassy_executor::main]
async fn main(_s: Spawner) {
    let parts = board::take();
    defmt::info!("hello");
    let board::Parts { lines, converter, mut wire, led, watchdog } = parts;
    let mut pulse = platform::Pulse::start(watchdog, led);
    static LINES: StaticCell<Lines<pins::Line, { board::LINES }>> = StaticCell::new();
    let lines = LINES.init(Lines::new(lines));
    let p = Pins { outputs: lines.mask(), inputs: 0xf << 26 };
    static SCAN: StaticCell<
        MuxScan<
            'static,
            pins::Line,
            platform::Settle,
            adc::Converter<4>,
            platform::Timer,
            { board::LINES },
            2048,
        >,
    > = StaticCell::new();
    let scan = SCAN.init(MuxScan::new(lines, platform::Settle::new(), converter, platform::Timer));
    let mut g = Garment::reference();
    let mut circuits = [0u32, 3000].map(|ns| {
        g.wiring.settle_ns = ns;
        let layout = Layout::build(&g, 2048, 4095).ok().unwrap();
        Circuit::build(&g, &layout, p).ok().unwrap()
    });
    wire.try_write(b"hello\n");
    let mut n = 0;
    loop {
        pulse.alive(platform::Timer.now());
        let c = &mut circuits[(n / 4) % 2];
        mark::mark(1 + (n as u32 / 4) % 2);
        let r = scan.scan(c, &Plan::default()).await.ok().unwrap();
        mark::mark(10);
        defmt::info!("scan {} us, first {} last {}", r.report.duration_us, r.codes[0].0, r.codes[2047].0);
        n += 1;
        let mut b = [0u8; 256];
        mark::mark(11);
        let k = wire.try_read(&mut b);
        wire.try_write(&b[..k]);
        mark::mark(12);
    }
}
