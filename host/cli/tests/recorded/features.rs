//! Features of the reference images that are too large for the repository.

use crate::{data, reference};
use taxel::files::arrays;

#[test]
fn features_are_those_of_the_reference() {
    let images = data::find("shapes.npz");
    let mut compared = 0;
    for case in reference::cases().iter().filter(|case| case["img"].is_null()) {
        let array = format!("{}_img", case["set"].as_str().unwrap());
        let frames = arrays::read(&images, Some(&array)).unwrap();
        // The file has every second image of each set.
        let index = case["index"].as_u64().unwrap() as usize / 2;
        reference::check(frames.frame(index).unwrap(), case);
        compared += 1;
    }
    println!("{compared} reference images");
    assert!(compared > 0);
}
