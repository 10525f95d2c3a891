//! The `Hello`.

use super::about::About;
use crate::board::tx_frame::TxFrame;
use crate::format::Micros;
use crate::wire::{Hello, LONGEST_REQUEST, MAGIC, PROTOCOL, Report, write};
use core::fmt::Write;
use heapless::String;
use serde::Serialize;

/// Encodes a `Hello`; returns false if it does not fit. Own frame: it needs much stack.
#[inline(never)]
pub(super) fn put(tx_frame: &mut TxFrame, now: Micros, about: &About<'_>) -> bool {
    let About { info, boot, setup, certificate, .. } = *about;
    let mut calibration: String<48> = String::new();
    // Its longest form has 35 characters.
    let _ = certificate.map(|it| write!(calibration, "{it}"));
    let (mut clock, mut garment, mut scene) = ([0; 10], [0; 2048], [0; LONGEST_REQUEST]);
    let hello = Hello {
        magic: MAGIC,
        protocol: PROTOCOL,
        garment: written(&setup.garment, &mut garment),
        firmware: info.firmware.as_bytes(),
        clock: written(&now, &mut clock),
        scene: written(&setup.scene, &mut scene),
        calibration: calibration.as_bytes(),
        chip: info.chip.as_bytes(),
        boot,
    };
    tx_frame.put(Report::HELLO, &hello)
}

/// Writes a value as postcard; returns no bytes if it does not fit.
fn written<'a, T: Serialize>(value: &T, buffer: &'a mut [u8]) -> &'a [u8] {
    let bytes = write(value, buffer).unwrap_or(0);
    buffer.get(..bytes).unwrap_or(&[])
}
