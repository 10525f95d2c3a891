//! Starts of the frames of the USB, one each millisecond, which all boards on one host controller share.
//!
//! An interrupt comes late by whatever keeps interrupts off, and nobody could say by how much. It therefore
//! only says when the next start is due. That one is watched for: the controller is asked for the number of
//! its frame again and again, and the frame has begun between the last question that was answered with the old
//! number and the first answer with the new one. Whatever comes between makes this time longer; the time
//! itself is what is stated.

use cortex_m::interrupt;
use embassy_sync::{blocking_mutex::raw::CriticalSectionRawMutex, signal::Signal};
use embassy_time::{Instant, Timer};
use rp_pac::USB;
use taxel_core::format::Micros;
use taxel_core::wire::StartOfFrame;

/// Time between two starts, us.
const FRAME_US: u64 = 1_000;
/// Numbers wrap after 11 bits.
const NUMBERS: u16 = 0x7ff;
/// Time before it is due at which the watch for the next start begins, us. The interrupt may have come late,
/// and the task that watches may.
const AHEAD_US: u64 = 60;
/// Most by which a start may have been before it was seen, us. If it is more, another one is watched for.
const MOST_US: u64 = 10;

/// A start that the interrupt has reported: number of the frame, and when.
static NOTICED: Signal<CriticalSectionRawMutex, (u16, Micros)> = Signal::new();
/// A start that was seen.
static SEEN: Signal<CriticalSectionRawMutex, StartOfFrame> = Signal::new();

/// Asks for a start if `asked`; returns the one that was seen since.
pub(super) fn take(asked: bool) -> Option<StartOfFrame> {
    if asked {
        SEEN.reset();
        await_next();
    }
    SEEN.try_take()
}

/// Lets the controller's interrupt come at the next start.
fn await_next() {
    interrupt::free(|_| {
        // Ends the cause that earlier starts have left.
        number();
        USB.inte().modify(|interrupts| interrupts.set_dev_sof(true));
    });
}

/// Reports a start, if it has woken the controller's interrupt.
pub(super) fn notice() {
    if USB.ints().read().dev_sof() {
        USB.inte().modify(|interrupts| interrupts.set_dev_sof(false));
        NOTICED.signal((number(), now()));
    }
}

/// Watches for the start after each one that is reported.
#[embassy_executor::task]
pub(super) async fn watch() {
    loop {
        let (last, noticed) = NOTICED.wait().await;
        Timer::at(Instant::from_micros(noticed.0 + FRAME_US - AHEAD_US)).await;
        match start_after(last) {
            Some(start) => SEEN.signal(start),
            None => await_next(),
        }
    }
}

/// Waits until the frame after `last` begins. None if it had begun before, or that was not seen soon enough.
fn start_after(last: u16) -> Option<StartOfFrame> {
    let next = last.wrapping_add(1) & NUMBERS;
    let mut asked = now();
    let end = Micros(asked.0 + 2 * AHEAD_US);
    let mut before = None;
    while asked < end {
        let number = number();
        let answered = now();
        if number == next {
            // Times are whole microseconds: 0 between them may be nearly 1.
            let late_us = answered.since(before?).max(1);
            let start = StartOfFrame { number, noticed: answered, late_us: late_us as u16 };
            return (late_us <= MOST_US).then_some(start);
        }
        if number != last {
            return None;
        }
        (before, asked) = (Some(asked), answered);
    }
    None
}

/// Number of the frame that runs. This also ends the cause of the interrupt.
fn number() -> u16 {
    USB.sof_rd().read().count()
}

fn now() -> Micros {
    Micros(Instant::now().as_micros())
}
