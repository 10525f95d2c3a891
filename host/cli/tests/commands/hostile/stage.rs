//! Arbitrary messages of a board.

use taxel::client::{Client, Event};
use taxel_core::format::Micros;
use taxel_core::garment::Garment;
use taxel_core::scene::Scene;
use taxel_core::wire::{Hello, MAGIC, PROTOCOL, Report, encode, frame_bound};

/// Longest message of these boards.
const LONGEST: usize = 8192;

/// A message as a frame of the wire.
pub fn frame(seq: u32, report: &Report<'_>) -> Vec<u8> {
    encode(&(seq, report), &mut vec![0; frame_bound(LONGEST)]).unwrap().to_vec()
}

/// A `Hello` with these bytes.
pub fn hello_of(seq: u32, garment: &[u8], scene: &[u8], firmware: &str, time: Micros) -> Vec<u8> {
    let clock = postcard::to_allocvec(&time).unwrap();
    let report = Report::Hello(Hello {
        magic: MAGIC,
        protocol: PROTOCOL,
        garment,
        firmware: firmware.as_bytes(),
        clock: &clock,
        scene,
        calibration: firmware.as_bytes(),
        chip: firmware.as_bytes(),
        boot: None,
    });
    frame(seq, &report)
}

/// A `Hello` with this garment and this scene.
pub fn hello(seq: u32, garment: &Garment, scene: &Scene, firmware: &str) -> Vec<u8> {
    let bytes = [postcard::to_allocvec(garment).unwrap(), postcard::to_allocvec(scene).unwrap()];
    hello_of(seq, &bytes[0], &bytes[1], firmware, Micros(1_000_000))
}

/// Events of a client for these bytes.
pub fn events(client: &mut Client, bytes: &[u8]) -> Vec<Event> {
    bytes.iter().filter_map(|byte| client.push(*byte)).collect()
}
