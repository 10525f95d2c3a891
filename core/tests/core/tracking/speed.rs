//! Velocities of things that move, against their true speed: at most 5 % off, or 0.05 taxel a frame.

use crate::random::Noise;
use crate::tracking::rig::{FRAME_US, Texture, TrackingRig, felt};
use taxel_core::contact::ContactConfig;
use taxel_core::garment::Garment;

/// Taxels per frame.
const SPEEDS: [f64; 8] = [0.02, 0.05, 0.11, 0.25, 0.5, 0.77, 1.0, 1.5];
/// Degrees from x towards y.
const DIRECTIONS: [f64; 4] = [0.0, 23.0, 90.0, -151.0];

/// A pressure that moves: what is felt at (x, y) once it has moved by (dx, dy).
type MovingPressure<'a> = &'a dyn Fn([f64; 2], [f64; 2]) -> f64;

/// A motion with noise, and how its velocity is smoothed.
struct NoisyMotion {
    speed: f64,
    degrees: f64,
    noise: f64,
    smoothing_ms: u16,
    /// Frames, and after how many of them the velocity counts.
    frames: usize,
    settled: usize,
}

impl NoisyMotion {
    /// The velocity of each frame as it is, over a way of 12 taxels at most.
    fn clean(speed: f64, degrees: f64) -> NoisyMotion {
        let frames = (12.0 / speed) as usize;
        NoisyMotion { speed, degrees, noise: 0.0, smoothing_ms: 0, frames: frames.min(60), settled: 4 }
    }

    /// With noise of 2 % of full scale, and the smoothing of 40 ms, five of which it takes to settle.
    fn noisy(speed: f64, degrees: f64) -> NoisyMotion {
        NoisyMotion { speed, degrees, noise: 0.02, smoothing_ms: 40, frames: 120, settled: 40 }
    }

    /// The greatest error of the velocity, in taxels per frame.
    fn worst(&self, what: MovingPressure) -> f64 {
        // Four standard deviations of the noise.
        let low = if self.noise > 0.0 { 330 } else { 60 };
        let config =
            ContactConfig { low, high: 2 * low, smoothing_ms: self.smoothing_ms, ..ContactConfig::default() };
        let mut rig = TrackingRig::new(&Garment::mat(), config);
        let (sin, cos) = self.degrees.to_radians().sin_cos();
        let (mut random, mut worst) = (Noise(7), 0.0f64);
        for frame in 0..self.frames {
            // Half of the way to either side of the middle.
            let way = self.speed * (frame as f64 - self.frames as f64 / 2.0);
            rig.draw_noisy(&mut random, self.noise, |x, y| {
                what([x - 15.5, y - 31.5], [way * cos, way * sin])
            });
            let contact = rig.only();
            if frame >= self.settled {
                let [vx, vy] = [contact.vx, contact.vy].map(|v| v.to_f64() * FRAME_US as f64 / 1e6);
                worst = worst.max((vx - self.speed * cos).hypot(vy - self.speed * sin));
            }
        }
        worst
    }
}

/// The greatest error over speeds and directions is within 5 % of the speed, or 0.05 taxel a frame.
fn check(what: &str, speeds: &[f64], motion: impl Fn(f64, f64) -> NoisyMotion, moving: MovingPressure) {
    for speed in speeds {
        let worst = DIRECTIONS.map(|degrees| motion(*speed, degrees).worst(moving));
        let worst = worst.into_iter().fold(0.0, f64::max);
        println!("{what} at {speed} taxels a frame: {worst:.3} off at most");
        assert!(worst <= (0.05 * speed).max(0.05), "{what} at {speed}: {worst}");
    }
}

/// What lies within `reach` of the middle and moves as a whole.
fn whole(reach: f64, pressure: impl Fn(f64, f64) -> f64) -> impl Fn([f64; 2], [f64; 2]) -> f64 {
    move |[x, y], [dx, dy]| {
        let (x, y) = (x - dx, y - dy);
        if x.abs().max(y.abs()) > reach + 1.0 { 0.0 } else { felt(x, y, &pressure) }
    }
}

#[test]
fn discs_and_fingers() {
    for radius in [1.5f64, 3.0, 6.3] {
        let disc = whole(radius, |x, y| if x.hypot(y) <= radius { 0.6 } else { 0.0 });
        check(&format!("a disc of radius {radius}"), &SPEEDS, NoisyMotion::clean, &disc);
        let dome = |x: f64, y: f64| 0.8 * (1.0 - (x * x + y * y) / (radius * radius)).max(0.0).sqrt();
        let finger = whole(radius, dome);
        check(&format!("a finger of radius {radius}"), &SPEEDS, NoisyMotion::clean, &finger);
        if radius > 2.0 {
            // As far as the panel goes.
            let motion = |speed: f64, degrees| {
                let motion = NoisyMotion::noisy(speed, degrees);
                NoisyMotion { frames: motion.frames.min((18.0 / speed) as usize), ..motion }
            };
            check(&format!("a noisy finger of radius {radius}"), &SPEEDS[..4], motion, &finger);
        }
    }
}

#[test]
fn a_textured_thing_that_moves_as_a_whole() {
    for (seed, half) in [(4, 4.0), (5, 6.5), (6, 8.0)] {
        let texture = Texture::new(seed);
        // How much of a taxel's cell lies within the thing, along one axis.
        let covered = |x: f64| (half + 0.5 - x.abs()).clamp(0.0, 1.0);
        let thing = |at: [f64; 2], way: [f64; 2]| {
            let (x, y) = (at[0] - way[0], at[1] - way[1]);
            covered(x) * covered(y) * texture.at(x, y)
        };
        check(&format!("a textured thing of {half}"), &SPEEDS, NoisyMotion::clean, &thing);
    }
}
