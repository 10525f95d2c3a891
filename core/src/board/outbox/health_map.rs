//! The health map, in as many parts as needed.

use crate::format::Micros;
use crate::health::FaultyTaxel;
use crate::wire::{FaultyTaxels, HealthMap};
use heapless::Vec;

/// The part of the map of a garment of `taxels` taxels that begins with the taxel `first`.
#[inline(never)]
pub(super) fn part(time: Micros, first: u16, taxels: u16, faulty: &[FaultyTaxel]) -> HealthMap {
    let mut map = HealthMap { time, first, end: taxels, taxels: Vec::new() };
    for faulty in faulty.iter().filter(|faulty| faulty.taxel >= first) {
        match map.taxels.last_mut() {
            Some(run) if run.health == faulty.health && run.first + run.count == faulty.taxel => {
                run.count += 1
            }
            _ => {
                let run = FaultyTaxels { first: faulty.taxel, count: 1, health: faulty.health };
                if map.taxels.push(run).is_err() {
                    map.end = faulty.taxel;
                    break;
                }
            }
        }
    }
    map
}
