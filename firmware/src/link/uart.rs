//! The UART with two rings. Interrupts move the bytes, so nothing here waits, and no byte is lost while a
//! scan occupies the processor for several milliseconds.

use core::task::Poll;
use embassy_futures::poll_once;
use embassy_rp::uart::{BufferedUart, BufferedUartRx, BufferedUartTx};
use embedded_io_async::{Read, Write};
use taxel_core::run::Link;

/// Bits per second of the link, 8N1: 92,160 bytes a second each way.
pub const BAUD: u32 = 921_600;

/// Number of bytes of each ring: 11 ms of the line, more than two scans.
pub const RING: usize = 1024;

/// The port.
pub struct Uart {
    tx: BufferedUartTx,
    rx: BufferedUartRx,
}

impl Uart {
    /// Takes a configured UART.
    pub fn new(uart: BufferedUart) -> Uart {
        let (tx, rx) = uart.split();
        Uart { tx, rx }
    }
}

impl Link for Uart {
    fn try_read(&mut self, buffer: &mut [u8]) -> usize {
        // The ring returns only the bytes up to its end, hence two rounds.
        let mut taken = 0;
        for _ in 0..2 {
            match poll_once(self.rx.read(buffer.get_mut(taken..).unwrap_or(&mut []))) {
                Poll::Ready(Ok(count)) => taken += count,
                // Bytes around the fault are lost; the CRC of the frame detects it.
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
