//! One step of the map that ships, in several number formats.

use micromath::F32Ext;
use taxel_core::intent::{Inference, Map, MapConfig, tactile};

/// Number of concepts of a map on the board.
pub const CONCEPTS: usize = taxel_core::intent::CONCEPTS;

/// Number of concepts computed in floats: enough for the map that ships.
pub const PLAIN: usize = 24;

/// Number format of the step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Activation {
    /// Q15, by the core.
    Q15,
    /// f32, with micromath's exponential.
    Micromath,
    /// f32, with libm's hyperbolic tangent.
    Libm,
}

/// The map in both forms.
pub struct Maps {
    map: Map<CONCEPTS>,
    weights: [[f32; PLAIN]; PLAIN],
    lambda: f32,
}

impl Maps {
    /// The map that ships: rule kosko, tanh above 0, inputs held.
    pub fn shipped() -> Option<Maps> {
        let config: MapConfig = tactile();
        let mut weights = [[0.0; PLAIN]; PLAIN];
        let step = (0..config.decimals).fold(1.0f32, |step, _| step * 10.0);
        for edge in &config.edges {
            let row = weights.get_mut(usize::from(edge.to))?;
            *row.get_mut(usize::from(edge.from))? = f32::from(edge.weight) / step;
        }
        Some(Maps { map: Map::build(&config).ok()?, weights, lambda: f32::from(config.lambda) / 1000.0 })
    }

    /// Runs a whole inference by the core, with the steps that a scene allows; `run` is overwritten.
    #[inline(never)]
    pub fn infer(&self, start: &[i32], run: &mut Inference<CONCEPTS>) {
        self.map.infer_into(start, 16, run);
    }

    /// The weights by effect and cause, and the steepness.
    pub const fn plain(&self) -> (&[[f32; PLAIN]; PLAIN], f32) {
        (&self.weights, self.lambda)
    }
}

impl Activation {
    /// All of them.
    pub const ALL: [Activation; 3] = [Activation::Q15, Activation::Micromath, Activation::Libm];

    /// Name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Activation::Q15 => "Q15",
            Activation::Micromath => "f32 micromath",
            Activation::Libm => "f32 libm",
        }
    }

    /// Returns the next state of the first concepts (Q15, or the bits of f32), from a state in Q15.
    #[inline(never)]
    pub fn step(self, maps: &Maps, state: &[i32; CONCEPTS]) -> [u32; PLAIN] {
        match self {
            Activation::Q15 => {
                let mut next = [0; PLAIN];
                next.iter_mut().zip(maps.map.step(state)).for_each(|(to, value)| *to = value as u32);
                next
            }
            // tanh z = 1 - 2 / (e^(2 z) + 1)
            Activation::Micromath => plain(maps, state, |z| 1.0 - 2.0 / (F32Ext::exp(2.0 * z) + 1.0)),
            Activation::Libm => plain(maps, state, libm::tanhf),
        }
    }

    /// Value of a result, -1 to 1.
    pub fn value(self, raw: u32) -> f64 {
        match self {
            Activation::Q15 => f64::from(raw as i32) / 32768.0,
            _ => f64::from(f32::from_bits(raw)),
        }
    }
}

fn plain(maps: &Maps, start: &[i32; CONCEPTS], transfer: fn(f32) -> f32) -> [u32; PLAIN] {
    let mut state = [0.0; PLAIN];
    state.iter_mut().zip(start).for_each(|(to, value)| *to = *value as f32 / 32768.0);
    let mut next = state;
    for (value, weights) in next.iter_mut().zip(&maps.weights) {
        // Concepts without causes keep their value.
        if weights.iter().any(|weight| *weight != 0.0) {
            let sum = weights.iter().zip(&state).map(|(weight, y)| weight * y).sum::<f32>();
            *value = transfer(maps.lambda * sum.max(0.0));
        }
    }
    next.map(f32::to_bits)
}
