//! The links to the host. The board uses USB while a program there has opened its port and reads, else the
//! UART; both carry the same bytes.
//!
//! | file | what |
//! |---|---|
//! | `uart.rs` | UART with two rings |
//! | `usb.rs` | the USB port |
//! | `rings.rs` | its rings |
//! | `packets.rs` | packets from a ring to the host |
//! | `starts.rs` | starts of the frames of the USB |
//! | `device.rs` | USB device, and the task that moves bytes from the host to a ring |

mod device;
mod packets;
mod rings;
mod starts;
pub mod uart;
mod usb;

pub use packets::PacketHandler;
pub use uart::Uart;
pub use usb::Usb;

use taxel_core::run::Link;
use taxel_core::wire::StartOfFrame;

/// The byte link to the host.
pub struct Wire {
    usb: Usb,
    uart: Uart,
    /// True while USB is in use.
    over_usb: bool,
    /// True if the last byte sent ended a message.
    ended: bool,
    /// True while the rest of a message follows whose beginning went over the other link.
    cut: bool,
}

/// Byte that ends each message.
const END: u8 = 0;

impl Wire {
    /// Joins the two links.
    pub fn new(usb: Usb, uart: Uart) -> Wire {
        Wire { usb, uart, over_usb: false, ended: true, cut: false }
    }

    /// Chooses the link to use.
    fn choose(&mut self) {
        let read = self.usb.is_read();
        if self.over_usb == read {
            return;
        }
        if !read {
            // Bytes queued for a host that has gone must not reach the next one.
            self.usb.forget();
        }
        (self.over_usb, self.cut) = (read, !self.ended);
        // Ends the message that was cut off when the board last left this link.
        self.send(&[END]);
    }

    fn send(&mut self, bytes: &[u8]) -> usize {
        if self.over_usb { self.usb.try_write(bytes) } else { self.uart.try_write(bytes) }
    }
}

impl Link for Wire {
    fn try_read(&mut self, buffer: &mut [u8]) -> usize {
        self.choose();
        // Bytes from the UART are read and dropped while USB is in use: later they would be out of date.
        let count = self.uart.try_read(buffer);
        if self.over_usb { self.usb.try_read(buffer) } else { count }
    }

    fn try_write(&mut self, bytes: &[u8]) -> usize {
        let mut count = 0;
        if self.cut {
            let end = bytes.iter().position(|byte| *byte == END);
            self.cut = end.is_none();
            count = end.map_or(bytes.len(), |at| at + 1);
        }
        count += self.send(bytes.get(count..).unwrap_or(&[]));
        if let Some(last) = count.checked_sub(1).and_then(|last| bytes.get(last)) {
            self.ended = *last == END;
        }
        count
    }

    fn start_of_frame(&mut self, next: bool) -> Option<StartOfFrame> {
        self.usb.start_of_frame(next && self.over_usb)
    }
}
