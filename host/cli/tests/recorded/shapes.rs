//! The labelled set of synthetic shapes.

use crate::data;
use crate::shape_of::{recorded, shape_of};
use taxel_core::condition::{Image, Rows};
use taxel_core::shape::Class;

#[test]
fn the_reference_set() {
    let mut file = npyz::npz::NpzArchive::open(data::find("shapes.npz")).unwrap();
    for (grid, rows, columns, least) in [("4x16", 4, 16, 71), ("16x16", 16, 16, 79), ("32x64", 32, 64, 89)] {
        let layout = recorded(rows, columns);
        let (mut right, mut all) = (0, 0);
        for set in ["B_n0", "C_n0", "C_n1", "C_n3", "D_n3"] {
            let labels = file.by_name(&format!("{grid}_{set}_label")).unwrap().unwrap();
            let labels: Vec<i64> = labels.into_vec().unwrap();
            let images = file.by_name(&format!("{grid}_{set}_img")).unwrap().unwrap();
            let images: Vec<u16> = images.into_vec().unwrap();
            for (label, values) in labels.iter().zip(images.chunks(layout.taxels())) {
                let class = match label {
                    0 => Class::RECTANGLE,
                    1 => Class::ROUND,
                    3 => Class::FINGER,
                    _ => continue,
                };
                let shape = shape_of(&layout, &Image { values, rows: &Rows::ALL }).expect("a contact");
                right += u32::from(shape.class == class);
                all += 1;
            }
        }
        let percent = 100.0 * f64::from(right) / f64::from(all);
        println!("reference set (learned from), {grid}: {percent:.1} % of {all} right");
        assert!(percent >= f64::from(least));
    }
}
