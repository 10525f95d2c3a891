//! `taxel features` on the reference images that are too large for the repository.

use crate::{data, reference};

#[test]
fn features_are_those_of_the_reference() {
    let images = data::find("shapes.npz");
    let mut compared = 0;
    for case in reference::cases().iter().filter(|case| case["img"].is_null()) {
        let array = format!("{}_img", case["set"].as_str().unwrap());
        // The file has every second image of each set.
        let frame = (case["index"].as_u64().unwrap() / 2).to_string();
        let image = [images.to_str().unwrap(), "--array", &array, "--frame", &frame];
        reference::check(&reference::features(&image), case);
        compared += 1;
    }
    println!("{compared} reference images");
    assert!(compared > 0);
}
