//! Moments, NMI and axis of the reference images: some pixels are in the reference itself, the others are with the
//! recordings.

use crate::reference::{cases, check};

#[test]
fn features_are_those_of_the_reference() {
    let cases = cases();
    let whole = cases.iter().filter_map(|case| Some((case, case["img"].as_array()?)));
    let mut compared = 0;
    for (case, image) in whole {
        let image: Vec<u16> = image.iter().map(|value| value.as_u64().unwrap() as u16).collect();
        check(&image, case);
        compared += 1;
    }
    assert!(compared >= 8);
}
