//! Starts of the frames of the USB, one each millisecond, which all boards on one host controller share.

use core::cell::Cell;
use embassy_sync::blocking_mutex::{Mutex, raw::CriticalSectionRawMutex};
use embassy_time::Instant;
use rp_pac::USB;
use taxel_core::format::Micros;
use taxel_core::wire::StartOfFrame;

/// Time between two starts, us.
const FRAME_US: u64 = 1_000;
/// Numbers wrap after 11 bits.
const NUMBERS: u16 = 0x7ff;
/// Most by which the time between two starts that were noticed may differ from a frame, us. What else keeps
/// interrupts off delays one of the two, and the next two are taken.
const AGREE_US: u64 = 12;
/// Most by which a start may have been before it was noticed, us, also if both were delayed alike: checking a
/// sub-field keeps interrupts off for 24, and other interrupts may come first, too. 27 at most were seen.
const LATE_US: u16 = 40;

/// What is known of the next start.
#[derive(Clone, Copy)]
enum NextStart {
    /// Nobody wants to know it.
    Idle,
    /// It is awaited, after this one.
    Awaited(Option<(u16, u64)>),
    /// It has come.
    Noticed(StartOfFrame),
}

static NEXT: Mutex<CriticalSectionRawMutex, Cell<NextStart>> = Mutex::new(Cell::new(NextStart::Idle));

/// Notices a start, if one has woken the controller's interrupt.
pub(super) fn notice() {
    if !USB.ints().read().dev_sof() {
        return;
    }
    let now = Instant::now().as_micros();
    // This also ends the interrupt's cause.
    let number = USB.sof_rd().read().count();
    NEXT.lock(|next| {
        let NextStart::Awaited(before) = next.get() else { return };
        let agrees = before.is_some_and(|(last, then)| {
            last.wrapping_add(1) & NUMBERS == number && (now - then).abs_diff(FRAME_US) <= AGREE_US
        });
        if agrees {
            await_next(false);
            next.set(NextStart::Noticed(StartOfFrame { number, noticed: Micros(now), late_us: LATE_US }));
        } else {
            next.set(NextStart::Awaited(Some((number, now))));
        }
    });
}

/// Asks for the next start if `asked`; returns the one that was noticed since the last one was asked for.
pub(super) fn take(asked: bool) -> Option<StartOfFrame> {
    NEXT.lock(|next| {
        let noticed = match next.get() {
            NextStart::Noticed(start) => Some(start),
            _ => None,
        };
        if asked {
            next.set(NextStart::Awaited(None));
            await_next(true);
        } else if noticed.is_some() {
            next.set(NextStart::Idle);
        }
        noticed
    })
}

/// Whether the controller's interrupt comes at each start. Interrupts are off.
fn await_next(comes: bool) {
    USB.inte().modify(|interrupts| interrupts.set_dev_sof(comes));
}
