//! Models of touches: refused bytes, decisions of a trained model in the board's arithmetic, and its size.

use proptest::prelude::*;
use taxel::learn::model::{ModelHead, encode};
use taxel_core::format::{Q15, crc32};
use taxel_core::gesture::{
    FEATURES, Features, LARGEST, LEADS, Model, ModelError, Sheet, ShippedModel, TouchClassifier, TouchState,
};
use taxel_learn::touches::{Provenance, Ridge, Trained};

/// Touches of a sheet that differ in the speed of their back-and-forth movement.
fn rubbing(period: usize, seed: usize) -> impl Iterator<Item = Vec<u16>> {
    (0..100).map(move |frame| {
        let at = (frame + seed) % period * 8 / period;
        (0..64)
            .map(|cell| if cell % 8 == at { 300 + (seed * 7 % 50) as u16 } else { (cell % 3) as u16 })
            .collect()
    })
}

fn features(frames: impl Iterator<Item = Vec<u16>>) -> Features {
    let mut state = TouchState::default();
    frames.for_each(|frame| state.add(&Sheet::new(8, 8).cells(&frame), 12));
    state.features()
}

fn trained() -> (Ridge, Vec<u8>) {
    let examples: Vec<(Features, usize)> =
        (0..40).map(|seed| (features(rubbing(if seed % 2 == 0 { 8 } else { 40 }, seed)), seed % 2)).collect();
    let examples: Vec<_> = examples.iter().map(|(features, class)| (features, *class)).collect();
    let ridge = Ridge::fit(&examples, 2, 10.0, 0.0);
    let names = ["fast".to_string(), "slow".to_string()];
    let alone = Trained { from: 0, ridge: ridge.clone(), rows: vec![(0, [0.75; LEADS])] };
    let head = ModelHead { names: &names, pressed: 12, concludes: false, notes: "{}" };
    let bytes = encode(&[alone.expert()], head).unwrap();
    (ridge, bytes)
}

#[test]
fn a_trained_model_distinguishes_touches_that_it_has_not_seen() {
    let (_, bytes) = trained();
    let touches = TouchClassifier::new(Model::read(&bytes).unwrap(), 8, 8);
    for seed in 100..140 {
        let mut state = TouchState::default();
        rubbing(if seed % 2 == 0 { 8 } else { 40 }, seed)
            .for_each(|frame| touches.process(&mut state, &frame));
        assert_eq!(touches.decide(&state).class, seed % 2, "{seed}");
    }
}

#[test]
fn the_board_scores_as_the_planes_do() {
    let (ridge, bytes) = trained();
    let model = Model::read(&bytes).unwrap();
    for seed in 0..20 {
        let features = features(rubbing(5 + seed, seed));
        let scores = model.expert(9).unwrap().scores(&features);
        for (class, weights) in ridge.weights.iter().enumerate() {
            let away =
                |i: usize| ((f64::from(features[i]) - ridge.middle[i]) / ridge.deviation[i]).clamp(-2.5, 2.5);
            let exact: f64 = (0..FEATURES).map(|i| weights[i] * away(i)).sum::<f64>() + ridge.offsets[class];
            let have = f64::from(scores[class]) / 262_144.0;
            // Half of 2^-10 of each weight, and a unit of 2^-8 of each feature.
            let most: f64 = weights.iter().map(|weight| weight.abs() / 100.0 + 2.5 / 2048.0).sum();
            assert!((have - exact).abs() <= most, "{have} of {exact}");
        }
    }
}

#[test]
fn the_shipped_models_fit_a_board_and_name_their_data() {
    for (bytes, classes) in [(ShippedModel::Gestures.bytes(), 7), (ShippedModel::Intent.bytes(), 3)] {
        let model = Model::read(bytes).unwrap();
        assert_eq!(model.classes(), classes);
        assert!(model.experts().count() > 1 && model.experts().all(|e| e.confidence(0, 9).is_some()));
        let notes = Provenance::of(&model).unwrap();
        assert!(notes.data.len() == 2 && notes.touches > 200);
    }
    assert!(size_of::<TouchState>() <= 4 << 10, "{} bytes", size_of::<TouchState>());
}

/// A model of two classes with experts, by age, that each prefer the given class.
fn of_experts(experts: &[(usize, usize)], concludes: bool) -> Vec<u8> {
    let (ridge, _) = trained();
    let experts: Vec<Trained> = experts
        .iter()
        .map(|(from, class)| {
            let weights = vec![vec![0.0; FEATURES]; 2];
            let offsets = (0..2).map(|other| if other == *class { 0.5 } else { -0.5 }).collect();
            let rows = vec![(*from, [0.25 + *class as f64 / 4.0; LEADS])];
            Trained { from: *from, ridge: Ridge { weights, offsets, ..ridge.clone() }, rows }
        })
        .collect();
    let names = ["fast".to_string(), "slow".to_string()];
    let experts: Vec<_> = experts.iter().map(Trained::expert).collect();
    encode(&experts, ModelHead { names: &names, pressed: 12, concludes, notes: "{}" }).unwrap()
}

#[test]
fn the_expert_of_its_age_decides_and_the_last_concludes_where_touches_are_whole() {
    for (concludes, short) in [(false, 0), (true, 1)] {
        let bytes = of_experts(&[(0, 0), (5, 1)], concludes);
        let touches = TouchClassifier::new(Model::read(&bytes).unwrap(), 8, 8);
        let mut state = TouchState::default();
        for (number, frame) in (1..10).zip(rubbing(8, 1)) {
            touches.process(&mut state, &frame);
            let decision = touches.decide(&state);
            assert_eq!(decision.class, usize::from(number >= 5), "{number}");
            let quarters = 1 + decision.class as i32;
            assert_eq!(
                (decision.lead, decision.confidence),
                (1 << 18, Some(Q15(quarters << 13))),
                "{number}"
            );
            let concluded = touches.conclude(&state).class;
            assert_eq!(concluded, if number < 5 { short } else { 1 }, "{number}");
        }
    }
    let bytes = |from| {
        let mut bytes = of_experts(&[(0, 0), (5, 1)], false);
        let second = bytes.len() - 4 - (6 + 2 * 4 + FEATURES * 10 + 20);
        bytes.truncate(bytes.len() - 4);
        bytes[second] = from;
        let sum = crc32(&bytes);
        bytes.extend(sum.to_le_bytes());
        bytes
    };
    assert_eq!(Model::read(&bytes(0)), Err(ModelError::Age(1, 0)));
    assert_eq!(Model::read(&bytes(1)).unwrap().expert(3).unwrap().from(), 1);
}

#[test]
fn a_model_of_version_2_is_read_and_knows_no_confidence() {
    let (_, three) = trained();
    // Without the flag of the last expert and its header and row; with the number of features instead of that
    // of the experts.
    let notes = 12 + 2;
    let mut two = three[..three.len() - 4 - 20].to_vec();
    two[7] = 2;
    two[notes + 2..notes + 4].copy_from_slice(&(FEATURES as u16).to_le_bytes());
    two.drain(notes + 8 + 32..notes + 8 + 32 + 6);
    two.drain(notes + 6..notes + 8);
    let sum = crc32(&two);
    two.extend(sum.to_le_bytes());
    let [two, three] = [&two, &three].map(|bytes| TouchClassifier::new(Model::read(bytes).unwrap(), 8, 8));
    let mut state = TouchState::default();
    rubbing(9, 4).for_each(|frame| two.process(&mut state, &frame));
    let [old, new] = [two, three].map(|touches| touches.decide(&state));
    assert_eq!((old.class, old.scores), (new.class, new.scores));
    assert_eq!((old.confidence, new.confidence), (None, Some(Q15(24_576))));
}

#[test]
fn bad_models_are_refused_with_a_sentence() {
    let good = ShippedModel::Gestures.bytes();
    let with = |at: usize, byte: u8| {
        let mut bytes = good[..good.len() - 4].to_vec();
        bytes[at] = byte;
        let sum = crc32(&bytes);
        bytes.extend(sum.to_le_bytes());
        Model::read(&bytes).unwrap_err()
    };
    assert_eq!(with(0, b'T'), ModelError::Foreign);
    assert_eq!(with(7, 1).to_string(), "a model of version 1, known are 2 and 3");
    let notes = u32::from_le_bytes(good[8..12].try_into().unwrap()) as usize;
    assert_eq!(with(12 + notes, 9).to_string(), "9 classes, expected 2 to 8");
    assert_eq!(with(12 + notes + 2, 4).to_string(), "4 experts, expected 1 to 3");
    let names = 12 + notes + 8;
    assert_eq!(with(names, 0), ModelError::Nameless(0));
    assert_eq!(with(names, 0xff), ModelError::Nameless(0));
    let expert = names + 7 * 16;
    assert_eq!(with(expert, 1), ModelError::Age(0, 1));
    let features = expert + 6 + 7 * 4;
    assert_eq!(with(features + 1, 9), ModelError::Feature(0, 9 << 8));
    assert_eq!(with(expert + 6 + 3, 0x7f), ModelError::Heavy(0));
    assert_eq!(Model::read(&[0; LARGEST + 1]), Err(ModelError::Large(LARGEST + 1)));
    let longer = [good, &[0]].concat();
    assert_eq!(Model::read(&longer), Err(ModelError::Longer(1)));
    let mut damaged = good.to_vec();
    damaged[features + 30] ^= 1;
    assert_eq!(Model::read(&damaged), Err(ModelError::Damaged));
    for length in 0..good.len() {
        assert!(Model::read(&good[..length]).is_err(), "{length} bytes");
    }
}

proptest! {
    #[test]
    fn whatever_the_bytes_and_the_frames_nothing_panics(
        flips in proptest::collection::vec((12usize..2500, any::<u8>()), 0..20),
        frames in proptest::collection::vec(proptest::collection::vec(any::<u16>(), 0..200), 1..60),
        rows in any::<u16>(), columns in any::<u16>(),
    ) {
        let mut bytes = ShippedModel::Gestures.bytes()[..ShippedModel::Gestures.bytes().len() - 4].to_vec();
        flips.into_iter().for_each(|(at, byte)| bytes[at] = byte);
        let sum = crc32(&bytes);
        bytes.extend(sum.to_le_bytes());
        if let Ok(model) = Model::read(&bytes) {
            let touches = TouchClassifier::new(model, rows, columns);
            let mut state = TouchState::default();
            frames.iter().for_each(|frame| touches.process(&mut state, frame));
            prop_assert!(touches.decide(&state).class < model.classes());
        }
    }
}
