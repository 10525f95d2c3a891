//! The links to the host. The board talks, and listens, over USB while a program there has opened its port
//! and reads, else over the UART; both carry the same bytes.
//!
//! | file | what |
//! |---|---|
//! | `uart.rs` | the UART behind its rings |
//! | `usb.rs` | the rings of the USB port |
//! | `device.rs` | the USB device, and the tasks that move bytes between its endpoints and the rings |

mod device;
pub mod uart;
mod usb;

pub use uart::Uart;
pub use usb::Usb;

use taxel_core::run::Link;

/// The byte link to the host.
pub struct Wire {
    usb: Usb,
    uart: Uart,
    /// The board talks over USB.
    over_usb: bool,
    /// The last byte that was sent is the last one of a message.
    ended: bool,
    /// What comes next is the rest of a message whose beginning went over the other link.
    cut: bool,
}

/// Ends each message.
const END: u8 = 0;

impl Wire {
    /// Over these two.
    pub fn new(usb: Usb, uart: Uart) -> Wire {
        Wire { usb, uart, over_usb: false, ended: true, cut: false }
    }

    /// Looks which link is to be used.
    fn choose(&mut self) {
        let read = self.usb.is_read();
        if self.over_usb == read {
            return;
        }
        if !read {
            // What waits for a host that has gone is not for the next one.
            self.usb.forget();
        }
        (self.over_usb, self.cut) = (read, !self.ended);
        // Ends what was cut off when the board went from this link.
        self.send(&[END]);
    }

    fn send(&mut self, bytes: &[u8]) -> usize {
        if self.over_usb { self.usb.try_write(bytes) } else { self.uart.try_write(bytes) }
    }
}

impl Link for Wire {
    fn try_read(&mut self, buffer: &mut [u8]) -> usize {
        self.choose();
        // What comes over the UART meanwhile is taken from its ring, too, and heard by nobody: later it would
        // be out of date.
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
}
