//! The labelled set of synthetic shapes, which the built-in base was not learned from.

use crate::data;
use crate::docs::says;
use crate::shape_of::{recorded, shape_of};
use std::fs::File;
use taxel_core::condition::{Image, Rows};
use taxel_core::shape::Class;
use zip::ZipArchive;

/// The values of an array of an archive.
fn array<T: npyz::Deserialize>(archive: &mut ZipArchive<File>, name: &str) -> Vec<T> {
    let file = archive.by_name(&format!("{name}.npy")).unwrap();
    npyz::NpyFile::new(file).unwrap().into_vec().unwrap()
}

#[test]
fn the_reference_set() {
    // The row of the docs for each set.
    let mut rows_of_docs =
        ["B_n0 (clean)", "C_n3 (blur, noise of 3 %)"].map(|set| format!("`shapes.npz`, {set} |"));
    let mut file = ZipArchive::new(File::open(data::find("shapes.npz")).unwrap()).unwrap();
    for (grid, rows, columns, least) in
        [("4x16", 4, 16, [45, 38]), ("16x16", 16, 16, [56, 46]), ("32x64", 32, 64, [56, 56])]
    {
        let layout = recorded(rows, columns);
        for ((set, least), row) in ["B_n0", "C_n3"].into_iter().zip(least).zip(&mut rows_of_docs) {
            let labels: Vec<i64> = array(&mut file, &format!("{grid}_{set}_label"));
            let images: Vec<u16> = array(&mut file, &format!("{grid}_{set}_img"));
            // Rows are what shapes were, columns what they were taken for; the last one is unknown.
            let mut confusion = [[0; 4]; 3];
            for (label, values) in labels.iter().zip(images.chunks(layout.taxels())) {
                let class = match label {
                    0 => Class::RECTANGLE,
                    1 => Class::ROUND,
                    3 => Class::FINGER,
                    _ => continue,
                };
                let shape = shape_of(&layout, &Image { values, rows: &Rows::ALL }).expect("a contact");
                let found = usize::from(shape.class.0).checked_sub(1).unwrap_or(3);
                confusion[usize::from(class.0) - 1][found] += 1;
            }
            let right: u32 = (0..3).map(|class| confusion[class][class]).sum();
            let all: u32 = confusion.iter().flatten().sum();
            let percent = 100.0 * f64::from(right) / f64::from(all);
            println!("{grid}_{set}: {percent:.1} % of {all} right: {confusion:?}");
            assert!(right >= least, "{grid}_{set}: {right} of {all}");
            row.push_str(&format!(" {percent:.1} |"));
        }
    }
    rows_of_docs.iter().for_each(|row| says("evidence/shapes.md", row));
}
