//! A UART behind two rings. Interrupts move the bytes, so nothing here ever waits, and a scan that keeps the
//! processor for several milliseconds loses none.

use core::task::Poll;
use embassy_futures::poll_once;
use embassy_rp::uart::{BufferedUart, BufferedUartRx, BufferedUartTx};
use embedded_io_async::{Read, Write};
use taxel_core::run::Link;

/// Bits per second of the link, 8N1: 92,160 bytes a second each way.
pub const BAUD: u32 = 921_600;

/// Bytes of each ring: what the line carries in 11 ms, more than two scans take.
pub const RING: usize = 1024;

/// The port.
pub struct Uart {
    tx: BufferedUartTx,
    rx: BufferedUartRx,
}

impl Uart {
    /// Over a UART that is already configured.
    pub fn new(uart: BufferedUart) -> Uart {
        let (tx, rx) = uart.split();
        Uart { tx, rx }
    }
}

impl Link for Uart {
    fn try_read(&mut self, buffer: &mut [u8]) -> usize {
        // A ring hands out what lies before its end in one piece, hence two rounds.
        let mut taken = 0;
        for _ in 0..2 {
            match poll_once(self.rx.read(buffer.get_mut(taken..).unwrap_or(&mut []))) {
                Poll::Ready(Ok(count)) => taken += count,
                // The bytes around the fault are lost; the frame check at the other end of the ring finds out.
                Poll::Ready(Err(error)) => defmt::warn!("link: {}", error),
                Poll::Pending => break,
            }
        }
        taken
    }

    fn try_write(&mut self, bytes: &[u8]) -> usize {
        let mut given = 0;
        for _ in 0..2 {
            match poll_once(self.tx.write(bytes.get(given..).unwrap_or(&[]))) {
                Poll::Ready(Ok(count)) => given += count,
                Poll::Ready(Err(_)) | Poll::Pending => break,
            }
        }
        given
    }
}
