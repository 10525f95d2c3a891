//! Warnings about labelled touches: forces that saturate in several classes, and units of another sheet.

use super::data::{Data, Touch};
use taxel::learn::doubts::top;
use taxel_core::gesture::{Model, Sheet, TouchState};

/// Feature used to compare levels: the mean over the frames of the total, log2 in Q8.
const LEVEL: usize = 0;

/// Warning about classes of which most touches saturate; none if there is at most one such class.
pub fn saturation(data: &Data) -> Option<String> {
    let top = top(data.touches.iter().flat_map(|touch| touch.values.iter().copied()))?;
    let classes = data.classes.iter().enumerate().filter_map(|(class, name)| {
        let own = || data.touches.iter().filter(move |touch| touch.class == class);
        let reach = own().filter(|touch| touch.values.contains(&top)).count();
        let share = 100.0 * reach as f64 / own().count().max(1) as f64;
        (share > 50.0).then(|| format!("{share:.0} % of {name}"))
    });
    let classes: Vec<String> = classes.collect();
    let which = classes.join(", ");
    (classes.len() > 1).then(|| {
        format!("saturation: values stop at {top} in {which}: force no longer distinguishes these classes")
    })
}

/// Warning about touches whose levels are far from those of the training; none if they fit.
pub fn units(data: &Data, model: &Model<'_>) -> Option<String> {
    let (middle, deviation) = model.experts().last()?.known(LEVEL)?;
    let sheet = Sheet::new(data.rows, data.columns);
    let level = |touch: &Touch| {
        let mut state = TouchState::new();
        data.frames(touch).for_each(|frame| state.add(&sheet.cells(frame), model.pressed()));
        f64::from(state.features()[LEVEL])
    };
    let mean = data.touches.iter().map(level).sum::<f64>() / data.touches.len().max(1) as f64;
    let above = mean - f64::from(middle);
    (above.abs() > f64::from(deviation)).then(|| {
        let times = 2f64.powf(above / 256.0);
        let as_trained = "as hard as those that the model was trained on; levels are features";
        format!("units: the touches press {times:.2} times {as_trained}")
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::gesture::ShippedModel;

    /// Touches of two classes with these values in all taxels and frames.
    fn data(first: u16, second: u16) -> Data {
        let touch = |class: usize, most: u16| Touch {
            values: (0..64 * 20u32).map(|i| ((i * 7919 % 701) as u16).min(most)).collect(),
            class,
            label: String::new(),
            group: String::new(),
        };
        let classes = ["kind".to_string(), "cruel".to_string()].to_vec();
        let touches = vec![touch(0, first), touch(1, second)];
        Data {
            rows: 8,
            columns: 8,
            classes,
            touches,
            idle: Vec::new(),
            doubts: Vec::new(),
            sources: Vec::new(),
        }
    }

    #[test]
    fn saturation_in_both_classes_is_reported_and_in_one_is_not() {
        let reported = saturation(&data(500, 500)).unwrap();
        assert!(
            reported.starts_with("saturation: values stop at 500 in 100 % of kind, 100 % of cruel"),
            "{reported}"
        );
        assert_eq!(saturation(&data(300, 500)), None);
        assert_eq!(saturation(&data(999, 999)), None);
    }

    #[test]
    fn another_unit_is_reported() {
        let model = Model::read(ShippedModel::Gestures.bytes()).unwrap();
        let (middle, _) = model.experts().last().unwrap().known(LEVEL).unwrap();
        // A sheet with the total of the training.
        let cell = (2f64.powf(f64::from(middle) / 256.0) / 64.0).round() as u16;
        let even = |times: u16| {
            let mut data = data(0, 0);
            data.touches.iter_mut().for_each(|touch| touch.values.fill(cell * times));
            units(&data, &model)
        };
        assert_eq!(even(1), None);
        let reported = even(100).unwrap();
        assert!(reported.starts_with("units: the touches press "), "{reported}");
    }
}
