//! A base of shapes from labelled images that were drawn.

use crate::called::{done, folder};
use crate::drawn::{CLASSES, DrawnTouch};
use crate::random::Noise;
use serde_json::Value;
use std::path::Path;

/// Files of drawn images and of their labels: NAME.csv, NAME-labels.csv.
fn draw(folder: &Path, name: &str, count: usize, seed: u64) -> [String; 2] {
    let (rows, columns, mut rng) = (16, 16, Noise(seed));
    let (mut images, mut labels) = (String::new(), "index,name\n".to_string());
    for (index, (class, what)) in
        CLASSES.into_iter().zip(["rectangle", "round", "finger"]).cycle().take(count).enumerate()
    {
        let codes = DrawnTouch::random(class, rows, columns, &mut rng).codes(rows, columns);
        for row in codes.chunks(columns.into()) {
            images += &row.iter().map(|code| code.0.to_string()).collect::<Vec<_>>().join(",");
            images.push('\n');
        }
        images.push('\n');
        labels += &format!("{index},{what}\n");
    }
    let files = [format!("{name}.csv"), format!("{name}-labels.csv")];
    std::fs::write(folder.join(&files[0]), images).unwrap();
    std::fs::write(folder.join(&files[1]), labels).unwrap();
    files
}

#[test]
fn a_base_is_trained_on_drawn_images_and_holds_on_others() {
    let folder = folder("train");
    let (own, other) = (draw(&folder, "own", 240, 1), draw(&folder, "other", 240, 2));
    let train = ["shapes", "train", "--images", &own[0], "--labels", &own[1], "-o", "base.json"];
    let (_, said) = done(&folder, &train);
    assert!(said.contains("learning 3 classes from 240 images, and in 5 folds"), "{said}");
    let eval = |[images, labels]: &[String; 2], by: &[&str]| {
        let args = [&["shapes", "eval", "--images", images, "--labels", labels, "--json"], by].concat();
        let (report, said) = done(&folder, &args);
        let report: Value = serde_json::from_str(&report).unwrap();
        assert_eq!(report["classes"], serde_json::json!(["finger", "rectangle", "round"]));
        assert_eq!(report["trained_on"] == true, said.contains("warning"), "{said}");
        let sum =
            |row: &Value| row.as_array().unwrap().iter().map(|count| count.as_u64().unwrap()).sum::<u64>();
        let rows: Vec<u64> = report["confusion"].as_array().unwrap().iter().map(sum).collect();
        assert_eq!(rows, [80, 80, 80]);
        (report["accuracy"].as_f64().unwrap(), report["trained_on"] == true)
    };
    let (own_right, warned) = eval(&own, &["--base", "base.json"]);
    let (other_right, not_warned) = eval(&other, &["--base", "base.json"]);
    let (cross_right, _) = eval(&own, &["--cross", "5"]);
    println!("drawn images: own {own_right:.3}, others {other_right:.3}, five folds {cross_right:.3}");
    assert!(warned && !not_warned);
    assert!(own_right > 0.95 && other_right > 0.93 && cross_right > 0.93);
}
