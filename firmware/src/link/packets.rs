//! Packets to the host. The interrupt of the USB controller fills the endpoint from the ring: 350 cycles a
//! packet, where a task of the device that is woken for each takes 1,200.

use super::rings::{OPENED, PACKETS, SENT};
use super::starts;
use core::cell::Cell;
use core::sync::atomic::Ordering;
use embassy_rp::interrupt::typelevel::{Handler, USBCTRL_IRQ};
use embassy_sync::blocking_mutex::{Mutex, raw::CriticalSectionRawMutex};
use rp_pac::usb_dpram::vals::EpControlEndpointType;
use rp_pac::{USB, USB_DPRAM};

/// Endpoint of the port's data; the first is that of its notifications.
const ENDPOINT: usize = 2;
/// Number of bytes of a packet.
pub(super) const PACKET: usize = 64;

/// True if the last packet was full. A transfer ends with a packet that is not full: an empty one after a
/// full one.
static WAS_FULL: Mutex<CriticalSectionRawMutex, Cell<bool>> = Mutex::new(Cell::new(false));

/// Handles the interrupt before the driver does, and leaves to it what is not of this endpoint.
pub struct PacketHandler;

impl Handler<USBCTRL_IRQ> for PacketHandler {
    #[allow(unsafe_code)] // SAFETY: no unsafe code here; the trait requires that only the interrupt calls it
    unsafe fn on_interrupt() {
        // First: what follows would make it late.
        starts::notice();
        let taken = USB.buff_status().read().ep_in(ENDPOINT);
        if taken {
            // A bit is cleared by writing 1.
            USB.buff_status().write(|status| status.set_ep_in(ENDPOINT, true));
            // This interrupt is its only writer.
            PACKETS.store(PACKETS.load(Ordering::Relaxed).wrapping_add(1), Ordering::Relaxed);
        }
        begin();
    }
}

/// Checks that the port was given the endpoint that is filled here. Must be called once, when it has been.
pub(super) fn start() {
    let endpoint = USB_DPRAM.ep_in_control(ENDPOINT - 1).read();
    defmt::assert!(endpoint.endpoint_type() == EpControlEndpointType::BULK, "the port has another endpoint");
}

/// Begins to send what the ring holds, with interrupts off for 3 us; the interrupt goes on with it.
pub(super) fn begin() {
    // While a packet waits for the host, the interrupt comes when it has been taken.
    if !USB_DPRAM.ep_in_buffer_control(ENDPOINT).read().available(0) {
        WAS_FULL.lock(send_next);
    }
}

/// Gives the controller the next packet, if it has none, the port is open, and there is something to send.
fn send_next(was_full: &Cell<bool>) {
    let control = USB_DPRAM.ep_in_buffer_control(ENDPOINT);
    let (mut next, endpoint) = (control.read(), USB_DPRAM.ep_in_control(ENDPOINT - 1).read());
    // Asked again: the interrupt may have come since.
    if next.available(0) || !endpoint.enable() || !OPENED.get() {
        return;
    }
    let count = fill(usize::from(endpoint.buffer_address()));
    if count == 0 && !was_full.get() {
        return;
    }
    was_full.set(count == PACKET);
    // The first packet after a connection is DATA0: the driver has left the other one there.
    next.set_pid(0, !next.pid(0));
    next.set_length(0, count as u16);
    next.set_full(0, true);
    control.write_value(next);
    // The controller runs at 48 MHz, and must see the rest before it sees that the packet is available
    // (RP2040 datasheet, 4.1.2.5.1).
    cortex_m::asm::delay(12);
    next.set_available(0, true);
    control.write_value(next);
}

/// Moves the next bytes of the ring to the controller's memory, at most a packet, and returns their number.
fn fill(offset: usize) -> usize {
    #[allow(unsafe_code)]
    // SAFETY: the driver has set aside 64 bytes of the controller's 4 KiB for this endpoint alone, and gives
    // their offset, below 4 KiB by its 64 units of 64. No other slice of them lives: this function runs with
    // interrupts off. The controller does not read them while no packet is available.
    let packet =
        unsafe { core::slice::from_raw_parts_mut(USB_DPRAM.as_ptr().cast::<u8>().add(offset), PACKET) };
    SENT.try_read(packet).unwrap_or(0)
}
