//! Training data of a touch: features of the whole, of its parts, of its mirror images and of its beginnings.

use super::data::{Data, Touch};
use super::settings::{EARLY, TrainSettings};
use super::windows::{Windows, ladder};
use taxel::text::progress::{Progress, Unit};
use taxel_core::gesture::{Cells, Features, SIDE, Sheet, TouchState};

/// Least number of frames of a half.
const LEAST: usize = 3;

/// Training data of a touch.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Course {
    /// Features of the whole touch.
    pub whole: Features,
    /// Features of its halves and mirror images, if these are used.
    pub more: Vec<Features>,
    /// Training features for each early expert.
    pub early: [Vec<Features>; EARLY],
    /// Number of frames.
    pub frames: usize,
    /// Features of its beginnings, by frames: each 1.41 times as long as the one before.
    pub beginnings: Vec<(usize, Features)>,
}

impl Course {
    /// Training data of this touch.
    pub fn of(data: &Data, touch: &Touch, settings: &TrainSettings) -> Course {
        let sheet = Sheet::new(data.rows, data.columns);
        let cells: Vec<Cells> = data.frames(touch).map(|frame| sheet.cells(frame)).collect();
        let learnt = |cells: &[Cells]| features(cells, settings.pressed);
        let images = if settings.mirrored { mirrored(&cells) } else { Vec::new() };
        let mut more = Vec::new();
        if settings.halves {
            let half = (cells.len() / 2).max(LEAST.min(cells.len()));
            more.extend([learnt(&cells[..half]), learnt(&cells[cells.len() - half..])]);
        }
        more.extend(images.iter().map(|image| learnt(image)));
        let early = settings.early.map(|windows| {
            let of =
                |cells: &Vec<Cells>| windows.map_or(Vec::new(), |windows| cut(cells, &windows, settings));
            std::iter::once(&cells).chain(&images).flat_map(of).collect()
        });
        let ages: Vec<usize> = ladder(1).take_while(|age| *age <= cells.len()).collect();
        let beginnings = ages.iter().copied().zip(growing(&cells, &ages, settings.pressed)).collect();
        Course { whole: learnt(&cells), more, early, frames: cells.len(), beginnings }
    }
}

/// Training data of all touches.
pub fn courses(data: &Data, settings: &TrainSettings) -> Vec<Course> {
    let count = data.touches.len() as u64;
    let mut progress = Progress::of("finding features", Unit::Steps("touches"), Some(count));
    let course = |(done, touch)| {
        progress.at(done);
        Course::of(data, touch, settings)
    };
    (0..).zip(&data.touches).map(course).collect()
}

/// Features of the windows of a touch.
fn cut(cells: &[Cells], windows: &Windows, settings: &TrainSettings) -> Vec<Features> {
    let lengths = windows.lengths();
    let from = |start: usize| growing(&cells[start..], &lengths, settings.pressed);
    windows.starts(cells.len()).into_iter().flat_map(from).collect()
}

/// Maps a place of the mirror image to the original cell.
type Mirror = fn(usize, usize) -> (usize, usize);

/// Mirror images of a touch: by columns, by rows, by both.
fn mirrored(cells: &[Cells]) -> Vec<Vec<Cells>> {
    let images: [Mirror; 3] =
        [|x, y| (SIDE - 1 - x, y), |x, y| (x, SIDE - 1 - y), |x, y| (SIDE - 1 - x, SIDE - 1 - y)];
    let of = |frame: &Cells, image: Mirror| -> Cells {
        std::array::from_fn(|cell| {
            let (x, y) = image(cell % SIDE, cell / SIDE);
            frame[y * SIDE + x]
        })
    };
    images.iter().map(|image| cells.iter().map(|frame| of(frame, *image)).collect()).collect()
}

fn features(cells: &[Cells], pressed: u16) -> Features {
    let mut state = TouchState::new();
    cells.iter().for_each(|frame| state.add(frame, pressed));
    state.features()
}

/// Features after each of `lengths` frames, in ascending order, as far as there are frames.
fn growing(cells: &[Cells], lengths: &[usize], pressed: u16) -> Vec<Features> {
    let mut state = TouchState::new();
    let mut grown = Vec::new();
    for (number, frame) in (1..).zip(cells) {
        state.add(frame, pressed);
        if lengths.get(grown.len()) == Some(&number) {
            grown.push(state.features());
        }
        if grown.len() == lengths.len() {
            break;
        }
    }
    grown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_are_the_touches_that_they_would_be_alone() {
        let cells: Vec<Cells> =
            (0..60).map(|n| std::array::from_fn(|i| ((n * 37 + i * 11) % 300) as u16)).collect();
        let settings = TrainSettings { pressed: 12, ..TrainSettings::default() };
        let windows = Windows { shortest: 5, longest: 10, every: 25 };
        let have = cut(&cells, &windows, &settings);
        // Lengths 5, 7, 10 from 0, 25, 50.
        assert_eq!(have.len(), 9);
        assert_eq!((have[1], have[5]), (features(&cells[..7], 12), features(&cells[25..35], 12)));
        assert_eq!(cut(&cells[..6], &windows, &settings).len(), 1, "as far as there are frames");
    }
}
