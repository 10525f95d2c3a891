//! Examples of shapes: their features as the board computes them, and what they are.

use crate::data;
use crate::drawn::{CLASSES, Rng};
use crate::kinds::{KINDS, Kind, VIEWS, View};
use crate::shape_of::{greatest, recorded};
use taxel_core::condition::{Image, Rows};
use taxel_core::garment::Layout;
use taxel_core::shape::{Class, Features, features, nmi};

/// Rows and columns.
pub const GRIDS: [[u16; 2]; 3] = [[4, 16], [16, 16], [32, 64]];

/// Examples of one kind.
pub struct Cell {
    pub kind: Kind,
    pub view: View,
    pub grid: [u16; 2],
    pub examples: Vec<(Features, Class)>,
}

impl Cell {
    /// What a base that was learned without this generator must know of it, in percent.
    pub fn least(&self) -> f64 {
        let [clean, noisy, hard] = match (self.kind, self.grid) {
            (Kind::Area, [4, _]) => [89.0, 84.0, 45.0],
            (Kind::Area, [16, _]) => [94.0, 93.0, 80.0],
            (Kind::Area, _) => [89.0, 91.0, 92.0],
            (Kind::Elastic, [4, _]) => [81.0, 78.0, 48.0],
            (Kind::Elastic, [16, _]) => [92.0, 90.0, 83.0],
            (Kind::Elastic, _) => [95.0, 95.0, 92.0],
            (Kind::Indenter, [4, _]) => [85.0, 83.0, 51.0],
            (Kind::Indenter, [16, _]) => [91.0, 89.0, 84.0],
            (Kind::Indenter, _) => [95.0, 96.0, 93.0],
        };
        match self.view {
            View::Clean => clean,
            View::Noisy => noisy,
            View::Hard => hard,
        }
    }
}

/// Features of the greatest contact.
fn seen(layout: &Layout, values: &[u16]) -> Option<Features> {
    let image = Image { values, rows: &Rows::ALL };
    greatest(layout, &image, |moments, contact| features(&nmi(moments, contact.peak), contact))
}

/// So many of each generator, grid and view; what no contact is left of is drawn anew.
pub fn drawn(count: usize, seed: u64) -> Vec<Cell> {
    let mut cells = Vec::new();
    for (number, kind) in (0..).zip(KINDS) {
        for grid in GRIDS {
            let layout = recorded(grid[0], grid[1]);
            for view in VIEWS {
                let mut rng = Rng(seed * 1000 + number * 100 + u64::from(grid[0]) * 3 + view as u64);
                let example = |class| {
                    let drawn =
                        std::iter::repeat_with(|| seen(&layout, &kind.image(class, grid, view, &mut rng)));
                    (drawn.flatten().next().expect("one is left"), class)
                };
                let examples = CLASSES.into_iter().cycle().take(count).map(example).collect();
                cells.push(Cell { kind, view, grid, examples });
            }
        }
    }
    cells
}

/// Images of tactnet that count as round, rectangular or finger-like, in 12 bits.
pub fn tactnet() -> Cell {
    let labels = std::fs::read_to_string(data::find("tactnet/labels.csv")).unwrap();
    let mut file = npyz::npz::NpzArchive::open(data::find("tactnet/images.npz")).unwrap();
    let images: Vec<u8> = file.by_name("images").unwrap().unwrap().into_vec().unwrap();
    let layout = recorded(28, 50);
    let mut examples = Vec::new();
    for (line, image) in labels.lines().skip(1).zip(images.chunks(layout.taxels())) {
        let class = match line.split(',').nth(1).expect("an object") {
            "ball" | "rock" | "sticky_tape" => Class::ROUND,
            "box" | "rubber" => Class::RECTANGLE,
            "finger" | "pen" | "highlighter" | "cable" | "cable_pipe" | "tube" => Class::FINGER,
            _ => continue,
        };
        let values: Vec<u16> = image.iter().map(|value| u16::from(*value) * 16).collect();
        examples.extend(seen(&layout, &values).map(|features| (features, class)));
    }
    Cell { kind: Kind::Area, view: View::Clean, grid: [28, 50], examples }
}
