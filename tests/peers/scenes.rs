//! Panels of 32 rows x 64 columns for all peers, and for the core's own tests: 8 bits, because imageproc's median
//! has no more, and 0 where nothing touches.

use proptest::prelude::Rng;
use proptest::test_runner::{RngAlgorithm, TestRng};

/// Rows of the panel.
pub const ROWS: usize = 32;
/// Columns of the panel.
pub const COLUMNS: usize = 64;
/// Pressure from which a taxel belongs to a contact.
pub const THRESHOLD: u8 = 20;

/// A named panel and how many contacts it shows.
pub struct Scene {
    /// its name
    pub name: &'static str,
    /// contacts
    pub contacts: usize,
    /// pressure, row by row
    pub values: Vec<u8>,
}

/// Empty, 1, 5 and 40 contacts, and every taxel pressed.
pub fn all() -> Vec<Scene> {
    let mut random = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut scene = |name, contacts, radius: f64, places: &[(f64, f64)]| {
        let mut values = vec![0; ROWS * COLUMNS];
        for (taxel, value) in values.iter_mut().enumerate() {
            let (x, y) = ((taxel % COLUMNS) as f64, (taxel / COLUMNS) as f64);
            let inside = |(cx, cy): &&(f64, f64)| (x - cx).powi(2) + (y - cy).powi(2) <= radius * radius;
            if places.iter().find(inside).is_some() {
                *value = 60 + (random.next_u32() % 160) as u8;
            }
        }
        Scene { name, contacts, values }
    };
    let five = [(8.3, 7.2), (24.0, 22.6), (38.4, 9.1), (52.7, 23.3), (56.2, 6.4)];
    let forty: Vec<(f64, f64)> =
        (0..40).map(|i| ((i % 8) as f64 * 7.9 + 3.4, (i / 8) as f64 * 6.2 + 2.9)).collect();
    vec![
        scene("empty", 0, 0.0, &[]),
        scene("1 contact", 1, 3.2, &five[..1]),
        scene("5 contacts", 5, 3.2, &five),
        scene("40 contacts", 40, 1.8, &forty),
        scene("saturated", 1, 1e3, &five[..1]),
    ]
}

/// The values of all of them, and of 60 at random.
pub fn panels() -> Vec<Vec<u8>> {
    let mut random = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut value = |_| {
        let drawn = random.next_u32();
        match drawn % 12 {
            0..3 => 0,
            3..7 => (drawn >> 8) as u8 % 40,
            _ => (drawn >> 8) as u8,
        }
    };
    let random = (0..60).map(|_| (0..ROWS * COLUMNS).map(&mut value).collect());
    let named: Vec<Vec<u8>> = all().into_iter().map(|scene| scene.values).collect();
    named.into_iter().chain(random).collect()
}
