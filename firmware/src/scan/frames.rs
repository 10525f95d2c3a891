//! The frames in memory. The chain raises an interrupt where it begins a frame. Then the frame before is
//! complete, and the place of the frame after is chosen, so that the chain never writes a frame that is being
//! read.
//!
//! An interlaced scan raises it where it begins a sub-field. The codes of its sub-field are then in the order
//! of the scan; the interrupt checks them and copies them to their taxels' places in a frame.

use super::{reflex, select::Select, tables};
use crate::{adc, platform::Timer};
use core::cell::RefCell;
use core::future::poll_fn;
use core::sync::atomic::{AtomicPtr, Ordering};
use core::task::Poll;
use embassy_rp::interrupt::typelevel::{Handler, Interrupt, PIO0_IRQ_0};
use embassy_sync::blocking_mutex::{Mutex, raw::CriticalSectionRawMutex};
use embassy_sync::waitqueue::AtomicWaker;
use static_cell::ConstStaticCell;
use taxel_core::acquire::{Clock, Lent, PLACES, Ring, ScanError, TURN_PLACES};
use taxel_core::capacity::TAXELS;
use taxel_core::format::{Code, Micros};

/// Codes of one frame, by taxel number.
type CodeFrame = [Code; TAXELS];

/// State of the interrupt: ring, and whether the DMA left its sequence.
struct Beat {
    ring: Ring,
    astray: bool,
    /// Number of sub-fields of a frame; 0 if the scan is not interlaced.
    fields: usize,
    /// Sub-field that is being read.
    field: usize,
}

impl Beat {
    const fn new(now: Micros, fields: usize) -> Beat {
        Beat { ring: Ring::new(now), astray: false, fields, field: 0 }
    }

    /// Completes a frame. Returns false if the flag is not that of the frame after it.
    fn frame(&mut self, begun: u32, now: Micros) -> bool {
        let place = self.ring.next();
        if begun != 1 << place {
            return false;
        }
        self.ring.complete(now);
        tables::lead(place, self.ring.next());
        true
    }

    /// Completes a sub-field and, with the last one, a frame. Returns false if the flag is not that of the
    /// sub-field after it.
    fn field(&mut self, begun: u32, now: Micros) -> bool {
        let next = if self.field + 1 < self.fields { self.field + 1 } else { 0 };
        if begun != tables::flag_of(next) {
            return false;
        }
        let places = FRAMES_AT.load(Ordering::Relaxed).cast::<CodeFrame>();
        #[allow(unsafe_code)]
        // SAFETY: two places of a static, which was taken before the chain began. The chain stores only in
        // the last one, and returns to this sub-field after all others. The ring does not lend the place that
        // is being filled.
        let (codes, frame) = unsafe {
            let filling = usize::from(self.ring.filling()).min(TURN_PLACES - 1);
            (&*places.wrapping_add(TURN_PLACES), &mut *places.wrapping_add(filling))
        };
        reflex::check(self.field, codes, frame, now);
        self.field = next;
        if next == 0 {
            self.ring.turn(now);
        }
        true
    }
}

static BEAT: Mutex<CriticalSectionRawMutex, RefCell<Beat>> =
    Mutex::new(RefCell::new(Beat::new(Micros(0), 0)));
/// Memory of all frames, for the interrupt.
static FRAMES_AT: AtomicPtr<[CodeFrame; PLACES]> = AtomicPtr::new(core::ptr::null_mut());
static COMPLETE: AtomicWaker = AtomicWaker::new();

/// Handler of the interrupt at the beginning of each frame, or of each sub-field.
pub struct FrameBegin;

impl Handler<PIO0_IRQ_0> for FrameBegin {
    #[allow(unsafe_code)] // SAFETY: no unsafe code here; the trait requires that only the interrupt calls it
    unsafe fn on_interrupt() {
        let begun = u32::from(Select::take_flags());
        BEAT.lock(|beat| {
            let beat = &mut *beat.borrow_mut();
            let now = Timer.now();
            let led = if beat.fields == 0 { beat.frame(begun, now) } else { beat.field(begun, now) };
            beat.astray |= !led;
            // Nothing waits for a single sub-field.
            if beat.field == 0 || beat.astray {
                COMPLETE.wake();
            }
        });
    }
}

/// Memory of all frames, which the chain fills and [`Frames::next`] lends.
pub struct Frames {
    places: *mut [CodeFrame; PLACES],
    /// True if the processor has filled a frame since the chain began last.
    still: bool,
}

/// Place that the processor fills.
const STILL: u8 = 0;

impl Frames {
    /// Takes the static memory. Must be called once.
    pub fn take() -> Frames {
        static FRAMES: ConstStaticCell<[CodeFrame; PLACES]> =
            ConstStaticCell::new([[Code(0); TAXELS]; PLACES]);
        let frames = FRAMES.take();
        FRAMES_AT.store(frames, Ordering::Relaxed);
        Frames { places: frames, still: false }
    }

    /// Address of a taxel's code in a place.
    pub fn address(&self, place: usize, taxel: u16) -> u32 {
        let offset = place * size_of::<CodeFrame>() + usize::from(taxel) * size_of::<Code>();
        self.places as u32 + offset as u32
    }

    /// Address of a code of an interlaced scan until its sub-field is complete, by the order of the scan: in
    /// the place that no frame uses then.
    pub fn scanned(&self, index: usize) -> u32 {
        self.address(TURN_PLACES, index as u16)
    }

    /// Fills all places while the chain stands still: with a copy of the frame lent last if `keep`, else with
    /// 0.
    pub fn reset(&mut self, keep: bool) {
        let lent = BEAT.lock(|beat| beat.borrow().ring.lent());
        let last = if self.still { Some(STILL) } else { lent }.filter(|_| keep);
        #[allow(unsafe_code)]
        // SAFETY: the memory is that of a static, taken once, and the chain stands still.
        let codes = unsafe { &mut *self.places }.as_flattened_mut();
        let Some(last) = last else { return codes.fill(Code(0)) };
        let from = usize::from(last).min(PLACES - 1) * TAXELS;
        (0..PLACES).for_each(|place| codes.copy_within(from..from + TAXELS, place * TAXELS));
    }

    /// Waits until the triggered chain has begun its first frame, some 100 cycles. `fields` is the number of
    /// sub-fields, 0 if the scan is not interlaced.
    pub fn begin(&mut self, fields: usize) {
        self.still = false;
        while Select::take_flags() == 0 {}
        BEAT.lock(|beat| *beat.borrow_mut() = Beat::new(Timer.now(), fields));
        if fields == 0 {
            tables::lead(0, 1);
        }
        Select::listen();
        #[allow(unsafe_code)]
        // SAFETY: no critical section relies on this interrupt being masked.
        unsafe {
            PIO0_IRQ_0::enable()
        };
    }

    /// Lends a frame to the processor, while the chain stands still.
    pub fn still(&mut self) -> &mut CodeFrame {
        self.still = true;
        #[allow(unsafe_code)]
        // SAFETY: the memory is that of a static, taken once, the chain stands still, and the returned
        // reference borrows `self`, without which the chain cannot be started.
        unsafe {
            &mut *self.places.cast::<CodeFrame>().wrapping_add(STILL.into())
        }
    }

    /// Waits for a frame that was not lent yet; for more than one of `scans`, the sum of that many. The frame
    /// does not change until the next call.
    pub async fn next(&mut self, scans: u16) -> Result<(&mut CodeFrame, Lent), ScanError> {
        let mut lent = complete(Ring::lend).await?;
        for _ in 1..scans {
            let shown = complete(Ring::show).await?;
            self.add(lent, shown);
            Timer.progressed();
            if !BEAT.lock(|beat| beat.borrow().ring.is_whole(shown)) {
                return Err(ScanError::OutOfStep);
            }
            lent.missed = lent.missed.saturating_add(shown.missed);
            lent.duration_us = (shown.start.since(lent.start) as u32).saturating_add(shown.duration_us);
        }
        #[allow(unsafe_code)]
        // SAFETY: the ring keeps the chain away from a lent place, and the returned reference borrows `self`,
        // so that no other frame is lent meanwhile.
        let frame = unsafe { &mut *self.frame(lent) };
        Ok((frame, lent))
    }

    /// Adds the codes of a shown frame to the lent one.
    fn add(&mut self, lent: Lent, shown: Lent) {
        #[allow(unsafe_code)]
        // SAFETY: a shown frame lies in another place than the lent one, and the chain returns to it a whole
        // frame later at the earliest. If it does so earlier, the sum is discarded.
        let (sums, codes) = unsafe { (&mut *self.frame(lent), &*self.frame(shown)) };
        sums.iter_mut().zip(codes).for_each(|(sum, code)| sum.0 = sum.0.wrapping_add(code.0));
    }

    /// Memory of a place, within the static that was taken once.
    fn frame(&self, lent: Lent) -> *mut CodeFrame {
        self.places.cast::<CodeFrame>().wrapping_add(usize::from(lent.place).min(PLACES - 1))
    }
}

/// Waits until `ask` gets a frame from the ring. Error if a conversion failed or the DMA left its sequence.
async fn complete(ask: fn(&mut Ring) -> Option<Lent>) -> Result<Lent, ScanError> {
    let lent = poll_fn(|context| {
        COMPLETE.register(context.waker());
        BEAT.lock(|beat| {
            let Beat { ring, astray, .. } = &mut *beat.borrow_mut();
            match ask(ring) {
                _ if *astray => Poll::Ready(Err(ScanError::OutOfStep)),
                Some(lent) => Poll::Ready(Ok(lent)),
                None => Poll::Pending,
            }
        })
    })
    .await?;
    adc::check()?;
    Ok(lent)
}
