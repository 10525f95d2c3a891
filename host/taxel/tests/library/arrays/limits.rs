//! Limits of contacts by the noise of an array, without a number set by hand: on any of 4 x 4 to 32 x 32 taxels nothing
//! is felt at rest, and a fingertip of 20 times the noise is, whatever their pitch.

use crate::random::Noise;
use taxel::client::{Client, Event, scene_bytes};
use taxel::source::array::NoiseMeter;
use taxel::virtual_board::VirtualBoard;
use taxel_core::format::Micros;
use taxel_core::garment::Garment;
use taxel_core::scene::Scene;
use taxel_core::wire::Request;

/// Frames of rest, and of a touch.
const REST: u64 = 1_500;
const TOUCH: u64 = 50;

/// An array: rows, columns, pitch in um, bits, noise in counts of 12 bits.
#[derive(Debug)]
struct Array {
    rows: u16,
    columns: u16,
    pitch_um: u16,
    bits: u32,
    noise: f64,
    period_us: u64,
}

impl Array {
    fn random(random: &mut Noise) -> Array {
        let (rows, columns) = (4 + random.below(29) as u16, 4 + random.below(29) as u16);
        let bits = [8, 10, 12][random.below(3) as usize];
        // A converter shows no noise far below its step.
        let step = f64::from(4095u16) / f64::from((1u32 << bits) - 1);
        Array {
            rows,
            columns,
            pitch_um: [2_000, 5_000, 8_000, 10_000, 14_000, 20_000, 25_000][random.below(7) as usize],
            bits,
            noise: step * 0.4 + random.range(0.0, 12.0),
            period_us: 2_500 + random.below(47_500),
        }
    }

    /// Codes of a frame, on which a finger presses with a share of its force.
    fn codes(&self, random: &mut Noise, share: f64) -> Vec<u16> {
        let full = f64::from((1u32 << self.bits) - 1);
        let (rows, columns) = (usize::from(self.rows), usize::from(self.columns));
        // A fingertip of 10 mm, as wide as 0.6 taxels at least.
        let wide = 5_000f64.max(0.6 * f64::from(self.pitch_um)) / f64::from(self.pitch_um);
        let code = |taxel: usize| {
            let [row, column] = [taxel / columns, taxel % columns].map(|at| at as f64);
            let far = (row - (rows / 2) as f64).hypot(column - (columns / 2) as f64) / wide;
            let press = 20.0 * self.noise * share * (-far * far / 2.0).exp();
            let value = 400.0 + 90.0 * ((taxel * 7 % 11) as f64) + self.noise * random.normal() + press;
            ((value / 4095.0 * full).round() * 4095.0 / full).round().clamp(0.0, 4095.0) as u16
        };
        (0..rows * columns).map(code).collect()
    }
}

#[test]
fn on_any_array_nothing_is_felt_at_rest_and_a_fingertip_is() {
    let (mut random, mut found, mut ghosts) = (Noise(5), Vec::new(), Vec::new());
    for _ in 0..16 {
        let array = Array::random(&mut random);
        let garment = Garment::grid("grid", array.rows, array.columns, [array.pitch_um.into(); 2]);
        let mut board = VirtualBoard::new(garment, Scene::shipped()).unwrap();
        board.client().request(&Request::Tare { frames: 32 }).unwrap();
        let (mut meter, mut felt) = (NoiseMeter::default(), [0, 0]);
        for frame in 0..REST + TOUCH {
            let is_touched = frame >= REST;
            let codes = array.codes(&mut random, if is_touched { 1.0 } else { 0.0 });
            let mut note = |client: &Client, event: &Event| {
                let feels = matches!(event, Event::Frame { .. }) && !client.contacts().is_empty();
                felt[usize::from(is_touched)] += u64::from(feels);
                Ok(())
            };
            board.step(&codes, Micros(frame * array.period_us), &mut note).unwrap();
            if let Some(noise) = meter.add(&codes) {
                let scene = scene_bytes(&noise.scene(board.areas())).unwrap();
                board.client().request(&Request::SetScene(&scene)).unwrap();
            }
        }
        println!("{array:?}: {} of {REST} frames at rest, {} of {TOUCH} of the touch", felt[0], felt[1]);
        found.push(felt[1] > TOUCH / 2);
        ghosts.push(felt[0]);
    }
    assert!(
        found.iter().all(|found| *found) && ghosts.iter().all(|frames| *frames == 0),
        "{ghosts:?} {found:?}"
    );
}
