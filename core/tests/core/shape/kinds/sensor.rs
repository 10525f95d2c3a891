//! What a sensor makes of pressure: blur, crosstalk, the board's filters.

use crate::shape::rig::recorded;
use taxel_core::condition::{ConditionConfig, ConditionState, Feedback, Filter, Sampled};
use taxel_core::format::{Code, Micros};

/// Blurred by a Gaussian, cut after three taxels; nothing comes in from beyond the border.
pub fn blurred(image: &[f64], columns: usize, sigma: f64) -> Vec<f64> {
    let weight = |i: i32| (-0.5 * (f64::from(i) / sigma).powi(2)).exp();
    let all: f64 = (-3..=3).map(weight).sum();
    let pass = |image: &[f64], across: i32, along: i32| -> Vec<f64> {
        let sum = |at: usize| {
            let part = |i: i32| beside(image, columns, at, [across * i, along * i]) * weight(i);
            (-3..=3).map(part).sum::<f64>() / all
        };
        (0..image.len()).map(sum).collect()
    };
    pass(&pass(image, 1, 0), 0, 1)
}

/// Each taxel takes a share of its four neighbours.
pub fn leaky(image: &[f64], columns: usize, share: f64) -> Vec<f64> {
    let sum = |at: usize| {
        let four = [[1, 0], [-1, 0], [0, 1], [0, -1]];
        let others: f64 = four.map(|step| beside(image, columns, at, step)).iter().sum();
        (image[at] + share * others) / (1.0 + share)
    };
    (0..image.len()).map(sum).collect()
}

/// The value some columns and rows away; 0 beyond the border.
fn beside(image: &[f64], columns: usize, at: usize, [across, along]: [i32; 2]) -> f64 {
    let (column, row) = ((at % columns) as i32 + across, (at / columns) as i32 + along);
    if column < 0 || row < 0 || column >= columns as i32 {
        return 0.0;
    }
    image.get(row as usize * columns + column as usize).copied().unwrap_or(0.0)
}

/// Through the board's conditioning.
pub fn filtered(codes: &[u16], [rows, columns]: [u16; 2], filter: Filter) -> Vec<u16> {
    let layout = recorded(rows, columns);
    let codes: Vec<Code> = codes.iter().copied().map(Code).collect();
    let mut state: Box<ConditionState<2048>> = Box::default();
    state.reset(&layout, Code(0));
    let condition = ConditionConfig { filter, floor: 1, ..ConditionConfig::default() }.build().unwrap();
    let sampled = Sampled { codes: &codes, falling: false, panels: 1, now: Micros(0) };
    let image = condition.process(&mut state, &layout, &sampled, &Feedback::<8>::new());
    image.values.to_vec()
}
