//! Noise of an array at rest, and the limits of contacts that follow from it.

use taxel_core::condition::Filter;
use taxel_core::garment::{Area, cell_mm2};
use taxel_core::scene::Scene;

/// Frames that are measured: those of the first tare.
const FRAMES: usize = 32;
/// Noise from which on single taxels do not tell a touch from noise, counts rms.
const LOUD: f64 = 8.0;
/// Least noise that is believed, counts rms: 32 frames do not show what comes later.
const LEAST: f64 = 1.0;
/// Floor of the image, and the limits of a contact's taxels and of its peak, in standard deviations: no noise reaches
/// the peak, and a touch of 20 does on taxels of any size.
const LIMITS: [f64; 3] = [3.5, 4.0, 10.0];
/// Area of a taxel that a fingertip presses alone, mm2.
const FINGERTIP_MM2: f64 = 100.0;
/// Noise whose twentyfold does not stand out from its neighbours as the filter wants it to, counts rms.
const FAINT: f64 = 6.0;
/// Area of a taxel whose peak the high threshold is, mm2; it grows with the area up to twice that.
const REFERENCE_MM2: f64 = 120.0;
/// Share of the taxels that are no noisier, and of the changes of a taxel that are noise: the others may be a touch.
const NEARLY_ALL: f64 = 0.9;
/// Root mean square of that share of the changes of Gaussian noise, the smallest, in standard deviations of the noise.
const TRIMMED: f64 = 1.116;

/// Measures the noise of the first frames.
#[derive(Debug, Default)]
pub struct NoiseMeter {
    frames: Vec<Vec<u16>>,
    is_done: bool,
}

/// Noise of an array, counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArrayNoise {
    /// Standard deviation from frame to frame that nine in ten taxels do not exceed.
    pub deviation: f64,
    /// Least change of a code: a step of the sensor's converter.
    pub step: u16,
}

impl NoiseMeter {
    /// Takes the codes of a frame. Returns the noise once, with the last frame that is measured; never if no code has
    /// changed until then, because nothing is known of what changes later.
    pub fn add(&mut self, codes: &[u16]) -> Option<ArrayNoise> {
        if self.is_done {
            return None;
        }
        self.frames.push(codes.to_vec());
        if self.frames.len() < FRAMES {
            return None;
        }
        self.is_done = true;
        noise(&std::mem::take(&mut self.frames))
    }
}

/// Noise of frames of one size; none if no code changes.
fn noise(frames: &[Vec<u16>]) -> Option<ArrayNoise> {
    let changes = |taxel: usize| {
        let codes = frames.iter().filter_map(move |codes| codes.get(taxel));
        codes.clone().zip(codes.skip(1)).map(|(one, next)| one.abs_diff(*next))
    };
    let taxels = 0..frames.first()?.len();
    let step = taxels.clone().flat_map(changes).filter(|change| *change > 0).min()?;
    let deviation = |taxel: usize| {
        let mut changes: Vec<f64> = changes(taxel).map(f64::from).collect();
        changes.sort_by(f64::total_cmp);
        let kept = &changes[..nearly_all(changes.len())];
        let squares = kept.iter().map(|change| change * change).sum::<f64>();
        (squares / kept.len() as f64).sqrt() / TRIMMED
    };
    let mut deviations: Vec<f64> = taxels.map(deviation).collect();
    deviations.sort_by(f64::total_cmp);
    Some(ArrayNoise { deviation: deviations[nearly_all(deviations.len()) - 1], step })
}

/// Nearly all of so many: at least one.
fn nearly_all(count: usize) -> usize {
    ((NEARLY_ALL * count as f64) as usize).max(1)
}

impl ArrayNoise {
    /// The shipped scene with limits for this noise on panels, above one step of the converter; those of
    /// [`Scene::against_noise`] if it is loud.
    pub fn scene(self, areas: &[Area]) -> Scene {
        let mut scene = Scene::shipped();
        if self.deviation > LOUD {
            return scene.against_noise(self.deviation.ceil().min(1000.0) as u16);
        }
        let [floor, low, high] = LIMITS.map(|limit| (limit * self.deviation.max(LEAST)).ceil() as u16);
        scene.condition.floor = floor;
        scene.contact.low = low.max(self.step.saturating_add(1));
        let peak = high.max(self.step.saturating_mul(5) / 2).max(scene.contact.low);
        // The high threshold is a pressure, and this peak is that of the smallest taxels.
        let sizes = areas.iter().map(|area| f64::from(cell_mm2(area.pitch_um)));
        let size_mm2 = sizes.fold(f64::MAX, f64::min);
        // The filter takes a faint touch of a single taxel for noise.
        if size_mm2 >= FINGERTIP_MM2 && self.deviation < FAINT {
            scene.condition.filter = Filter::Off;
        }
        let size = size_mm2.clamp(REFERENCE_MM2, 2.0 * REFERENCE_MM2) / REFERENCE_MM2;
        let noise = scene.contact.low / 2;
        scene.contact.high = (noise + (f64::from(peak - noise) / size).ceil() as u16).max(scene.contact.low);
        scene
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::garment::{Garment, Layout};

    /// Noise of 40 frames of 48 codes.
    fn measured(mut code: impl FnMut(usize, usize) -> u16) -> Option<ArrayNoise> {
        let mut meter = NoiseMeter::default();
        let mut found = (0..40)
            .filter_map(|frame| meter.add(&(0..48).map(|taxel| code(frame, taxel)).collect::<Vec<_>>()));
        let noise = found.next();
        assert_eq!(found.next(), None, "once");
        noise
    }

    /// Gaussian enough: the sum of twelve.
    fn noisy(deviation: f64) -> impl FnMut(usize, usize) -> u16 {
        let mut random = fastrand::Rng::with_seed(4);
        move |_, _| (500.0 + deviation * ((0..12).map(|_| random.f64()).sum::<f64>() - 6.0)).round() as u16
    }

    #[test]
    fn noise_is_measured_also_while_something_touches() {
        for deviation in [2.0, 5.0, 20.0] {
            let (mut still, mut touched) = (noisy(deviation), noisy(deviation));
            let alone = measured(&mut still).unwrap().deviation;
            assert!((0.9..1.5).contains(&(alone / deviation)), "{alone} of {deviation}");
            let mut both = |frame: usize, taxel| touched(frame, taxel) + if frame > 20 { 1000 } else { 0 };
            let both = measured(&mut both).unwrap().deviation;
            assert!((0.9..1.6).contains(&(both / deviation)), "{both} of {deviation}");
        }
    }

    #[test]
    fn limits_follow_the_noise() {
        let limits_of = |deviation, step, pitch_um| {
            let garment = Garment::grid("grid", 4, 4, [pitch_um; 2]);
            let layout = Layout::build(&garment, 16, 4095).unwrap();
            let scene = ArrayNoise { deviation, step }.scene(layout.areas());
            (scene.condition.floor, scene.contact.low, scene.contact.high)
        };
        let limits = |deviation, step| limits_of(deviation, step, 5_000);
        // A quiet array; one of 8 bits; noise of 3 and of 9 counts.
        assert_eq!(limits(0.2, 1), (4, 4, 10));
        assert_eq!(limits(0.2, 16), (4, 17, 40));
        assert_eq!(limits(3.0, 1), (11, 12, 30));
        assert_eq!(limits(9.0, 1), (18, 20, 40));
        // On taxels of 400 mm2, twice the threshold's pressure is the same peak.
        assert_eq!(limits_of(3.0, 1, 20_000), (11, 12, 18));
    }

    #[test]
    fn what_does_not_change_is_not_measured() {
        assert_eq!(measured(|_, taxel| taxel as u16), None);
        assert_eq!(NoiseMeter::default().add(&[]), None);
    }
}
