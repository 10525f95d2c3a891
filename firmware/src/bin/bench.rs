//! The measuring image (`cargo xtask cycles`): the board's perception without pins and link, driven through a
//! mailbox in memory. The harness waits until `command` is [`READY`], writes bytes or codes and then a
//! command, and reads the board's output.
#![no_std]
#![no_main]
#![deny(unsafe_code)]

#[path = "../copy.rs"]
mod copy;
#[path = "../divide.rs"]
mod divide;
#[path = "../mark.rs"]
mod mark;
#[path = "../sniffer.rs"]
mod sniffer;

use core::panic::PanicInfo;
use core::sync::atomic::{AtomicU16, AtomicU32, Ordering::Relaxed};
use cortex_m_rt::entry;
use defmt_rtt as _;
use embassy_rp::peripherals::DMA_CH11;
use sniffer::Sniffer;
use static_cell::ConstStaticCell;
use taxel_core::format::Code;
use taxel_core::pipeline::{Probe, Stage};
use taxel_core::wire::Checksum;
use taxel_suite::chain::{Chain, Said, TAXELS};
use taxel_suite::kernel::{Bench, Kernel};

/// Interface to the harness; tests/emulator/bench.mjs depends on the order of the fields.
#[repr(C)]
struct Mailbox {
    command: AtomicU32,
    /// Number of valid bytes of `content`.
    length: AtomicU32,
    bytes: AtomicU32,
    digest: AtomicU32,
    content: [AtomicU16; TAXELS],
}

/// The image has started, or has finished the command.
const READY: u32 = 0;
/// The image has not started yet.
const STARTING: u32 = u32::MAX;
/// `content` holds bytes from a host, two in each half.
const RECEIVE: u32 = 1;
/// `content` holds the codes of a scan.
const SCAN: u32 = 2;
/// Puts the table of folds in force, or none if the length is 0.
const FOLD: u32 = 3;
/// First of the numbers of kernels; `content` holds their input.
const KERNELS: u32 = 16;

// The harness finds the mailbox by its name.
#[allow(unsafe_code)] // SAFETY: no other symbol has this name
#[unsafe(no_mangle)]
static TAXEL_MAILBOX: Mailbox = Mailbox {
    command: AtomicU32::new(STARTING),
    length: AtomicU32::new(0),
    bytes: AtomicU32::new(0),
    digest: AtomicU32::new(0),
    content: [const { AtomicU16::new(0) }; TAXELS],
};

static CODES: ConstStaticCell<[Code; TAXELS]> = ConstStaticCell::new([Code(0); TAXELS]);

/// Platform of the board's perception: shows the harness when a stage begins, and computes checksums as the
/// firmware does.
struct Measured {
    sniffer: Sniffer,
}

impl Probe for Measured {
    fn begin(&mut self, stage: Stage) {
        mark::mark(stage as u32);
    }
}

impl Checksum for Measured {
    fn crc32(&mut self, bytes: &[u8]) -> u32 {
        self.sniffer.crc32(bytes)
    }
}

#[entry]
fn main() -> ! {
    // Built in place: the stack has no room for a second one. The harness counts the stack below this frame.
    let chain = &mut Chain::bare();
    ship(chain);
    let bench = &mut Bench::default();
    #[allow(unsafe_code)] // SAFETY: nothing else of this image uses the channel
    let mut measured = Measured { sniffer: Sniffer::new(unsafe { DMA_CH11::steal() }) };
    let codes = CODES.take();
    let mailbox = &TAXEL_MAILBOX;
    mailbox.command.store(READY, Relaxed);
    loop {
        let said = match mailbox.command.load(Relaxed) {
            RECEIVE => receive(chain, mailbox),
            FOLD => {
                chain.fold(mailbox.length.load(Relaxed) > 0);
                Said::default()
            }
            SCAN => chain.scanned(scanned(codes, mailbox), &mut measured, |_| ()),
            command => match command.checked_sub(KERNELS).and_then(|n| Kernel::all().nth(n as usize)) {
                Some(kernel) => {
                    let digest = kernel.run(bench, taken(codes, mailbox), &mut measured);
                    Said { digest, bytes: 0 }
                }
                None => continue,
            },
        };
        mailbox.bytes.store(said.bytes, Relaxed);
        mailbox.digest.store(said.digest, Relaxed);
        mailbox.command.store(READY, Relaxed);
    }
}

/// Sets the shipped garment and scene. Out of line, so that its stack is freed afterwards.
#[inline(never)]
fn ship(chain: &mut Chain) {
    if chain.ship().is_err() {
        panic!("what ships does not fit this board");
    }
}

/// Copies the codes of a kernel out of the mailbox.
fn taken<'a>(codes: &'a mut [Code; TAXELS], mailbox: &Mailbox) -> &'a [Code; TAXELS] {
    for (code, sent) in codes.iter_mut().zip(&mailbox.content) {
        code.0 = sent.load(Relaxed);
    }
    codes
}

/// Copies the codes of a scan out of the mailbox: as many as the garment has taxels.
fn scanned<'a>(codes: &'a mut [Code; TAXELS], mailbox: &Mailbox) -> &'a [Code] {
    let count = mailbox.length.load(Relaxed) as usize / 2;
    let codes = taken(codes, mailbox);
    codes.get(..count).unwrap_or(codes)
}

/// Passes the bytes from a host on, one at a time.
fn receive(chain: &mut Chain, mailbox: &Mailbox) -> Said {
    let mut said = Said::default();
    for index in 0..mailbox.length.load(Relaxed) as usize {
        let half = mailbox.content.get(index / 2).map_or(0, |half| half.load(Relaxed));
        said = chain.receive(&[half.to_le_bytes()[index % 2]]);
    }
    said
}

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    // The harness ends the run at this breakpoint and reports the place.
    cortex_m::asm::bkpt();
    loop {
        cortex_m::asm::nop();
    }
}
