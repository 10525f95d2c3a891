//! Scenes of pressure over the plane of a panel, as its taxels feel them, and the stage that follows contacts.

use crate::random::Noise;
use taxel_core::condition::{Image, Rows};
use taxel_core::contact::{Contact, ContactConfig, ContactState, Contacts};
use taxel_core::format::Micros;
use taxel_core::garment::{Garment, Layout};

/// Time between two frames, us: 195 frames/s.
pub const FRAME_US: u64 = 5128;
/// Full scale of 12 bits.
pub const FULL: f64 = 4095.0;

pub struct TrackingRig {
    pub layout: Layout,
    pub values: Vec<u16>,
    stage: Contacts,
    state: Box<ContactState<16, 1024>>,
    now: u64,
}

/// What one frame gave.
pub struct FoundContacts {
    pub present: Vec<Contact>,
    pub released: Vec<Contact>,
}

impl TrackingRig {
    pub fn new(garment: &Garment, config: ContactConfig) -> TrackingRig {
        let layout = Layout::build(garment, 2048, u16::MAX).unwrap();
        TrackingRig {
            values: vec![0; layout.taxels()],
            stage: config.build().unwrap(),
            state: Box::default(),
            now: 1_000_000,
            layout,
        }
    }

    /// A panel of 64 x 32 taxels.
    pub fn mat() -> TrackingRig {
        TrackingRig::new(&Garment::mat(), ContactConfig::default())
    }

    /// Draws on panel 0 what `pressure(x, y)` says, in shares of full scale.
    pub fn draw(&mut self, pressure: impl Fn(f64, f64) -> f64) {
        self.draw_with(|x, y| pressure(x, y) * FULL);
    }

    /// [`TrackingRig::draw`] with noise of `sigma` (a share of full scale) on every taxel.
    pub fn draw_noisy(&mut self, noise: &mut Noise, sigma: f64, pressure: impl Fn(f64, f64) -> f64) {
        self.draw_with(|x, y| (pressure(x, y) + sigma * noise.normal()) * FULL);
    }

    fn draw_with(&mut self, mut counts: impl FnMut(f64, f64) -> f64) {
        let columns = usize::from(self.layout.areas()[0].columns);
        let taxels = columns * usize::from(self.layout.areas()[0].rows);
        for (index, value) in self.values.iter_mut().enumerate().take(taxels) {
            *value =
                counts((index % columns) as f64, (index / columns) as f64).round().clamp(0.0, FULL) as u16;
        }
    }

    pub fn frame(&mut self) -> FoundContacts {
        self.frame_after(FRAME_US)
    }

    pub fn frame_after(&mut self, us: u64) -> FoundContacts {
        self.now += us;
        let rows = Rows::of(&self.layout, &self.values);
        let image = Image { values: &self.values, rows: &rows };
        let touches = self.stage.process(&mut self.state, &self.layout, &image, Micros(self.now));
        assert_eq!((touches.dropped, touches.overflow), (0, 0));
        FoundContacts { present: touches.present.to_vec(), released: touches.released.to_vec() }
    }

    pub fn only(&mut self) -> Contact {
        let frame = self.frame();
        assert_eq!(frame.present.len(), 1);
        frame.present[0].clone()
    }
}

/// The share of a taxel's cell at (x, y) that a shape covers, and how much it presses there: the mean over 8
/// x 8 places.
pub fn felt(x: f64, y: f64, pressure: impl Fn(f64, f64) -> f64) -> f64 {
    let places = (0..8).flat_map(|i| (0..8).map(move |j| (f64::from(i), f64::from(j))));
    places.map(|(i, j)| pressure(x + (i - 3.5) / 8.0, y + (j - 3.5) / 8.0)).sum::<f64>() / 64.0
}

/// A texture: waves of pressure around one half, each of 5 to 12 taxels.
pub struct Texture(Vec<[f64; 3]>);

impl Texture {
    pub fn new(seed: u64) -> Texture {
        let mut noise = Noise(seed);
        let wave = |_| {
            let (length, angle) = (5.0 + 7.0 * noise.unit(), noise.unit() * std::f64::consts::TAU);
            let k = std::f64::consts::TAU / length;
            [k * angle.cos(), k * angle.sin(), noise.unit() * std::f64::consts::TAU]
        };
        Texture((0..8).map(wave).collect())
    }

    /// Half of full scale on average, with a standard deviation of about 0.14.
    pub fn at(&self, x: f64, y: f64) -> f64 {
        let waves = self.0.iter().map(|[kx, ky, phase]| (kx * x + ky * y + phase).cos()).sum::<f64>();
        (0.5 + 0.2 * waves / (self.0.len() as f64).sqrt()).clamp(0.25, 1.0)
    }
}
