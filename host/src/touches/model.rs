//! Training a model of touches, and applying one as the board does.

use super::data::{Data, Source, Touch};
use super::export::{Head, export};
use super::ridge::Ridge;
use crate::date::today;
use crate::progress::{Progress, Unit};
use anyhow::{Context, Result, bail, ensure};
use serde::{Deserialize, Serialize};
use std::path::Path;
use taxel_core::gesture::{Cells, Features, Model, SIDE, Sheet, TouchState, Touches};

/// How a model is trained; a task's own, chosen by cross-validation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// A cell above this counts as touched.
    pub pressed: u16,
    /// Also train on each half of a touch.
    pub halves: bool,
    /// Draws weights towards 0.
    pub penalty: f64,
    /// 1: every class counts alike, 0: every example.
    pub balance: f64,
    /// Whether is learnt from the mirror images of a touch, too.
    pub mirrored: bool,
}

/// What a model says of itself.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// Day of the training.
    pub date: String,
    /// The files it was trained on.
    pub data: Vec<Source>,
    /// Touches it was trained on.
    pub touches: usize,
    /// How it was trained.
    pub settings: Settings,
}

impl Provenance {
    /// Of a model.
    pub fn of(model: &Model<'_>) -> Result<Provenance> {
        serde_json::from_slice(model.notes()).context("the notes of the model cannot be read")
    }

    /// Whether one of the files is one it was trained on.
    pub fn knows(&self, sources: &[Source]) -> bool {
        sources.iter().any(|source| self.data.iter().any(|known| known.fnv1a == source.fnv1a))
    }
}

/// Fewest frames of a half.
const LEAST: usize = 3;

/// What is learnt of a touch.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Course {
    /// The whole touch.
    pub whole: Features,
    /// Its halves and its mirror images, where these are learnt.
    pub more: Vec<Features>,
}

impl Course {
    /// Of a touch.
    pub fn of(data: &Data, touch: &Touch, settings: &Settings) -> Course {
        let sheet = Sheet::new(data.rows, data.columns);
        let cells: Vec<Cells> = data.frames(touch).map(|frame| sheet.cells(frame)).collect();
        let learnt = |cells: &[Cells]| features(cells, settings.pressed);
        let mut more = Vec::new();
        if settings.halves {
            let half = (cells.len() / 2).max(LEAST.min(cells.len()));
            more.extend([learnt(&cells[..half]), learnt(&cells[cells.len() - half..])]);
        }
        if settings.mirrored {
            let images: [Mirror; 3] =
                [|x, y| (SIDE - 1 - x, y), |x, y| (x, SIDE - 1 - y), |x, y| (SIDE - 1 - x, SIDE - 1 - y)];
            let of = |frame: &Cells, image: Mirror| -> Cells {
                std::array::from_fn(|cell| {
                    let (x, y) = image(cell % SIDE, cell / SIDE);
                    frame[y * SIDE + x]
                })
            };
            let seen = |image: &Mirror| cells.iter().map(|frame| of(frame, *image)).collect::<Vec<_>>();
            more.extend(images.iter().map(|image| learnt(&seen(image))));
        }
        Course { whole: learnt(&cells), more }
    }
}

/// What is learnt of each touch.
pub fn courses(data: &Data, settings: &Settings) -> Vec<Course> {
    let count = data.touches.len() as u64;
    let mut progress = Progress::of("finding features", Unit::Steps("touches"), Some(count));
    let course = |(done, touch)| {
        progress.at(done);
        Course::of(data, touch, settings)
    };
    (0..).zip(&data.touches).map(course).collect()
}

/// Which cell is seen at a place.
type Mirror = fn(usize, usize) -> (usize, usize);

fn features(cells: &[Cells], pressed: u16) -> Features {
    let mut state = TouchState::new();
    cells.iter().for_each(|frame| state.add(frame, pressed));
    state.features()
}

/// Trains on touches whose courses are given; the bytes of a model.
pub fn train(data: &Data, examples: &[(&Course, usize)], settings: &Settings) -> Result<Vec<u8>> {
    ensure!(data.classes.len() >= 2, "touches of one class only: nothing can be told apart");
    let windows: Vec<(&Features, usize)> = examples
        .iter()
        .flat_map(|(course, class)| std::iter::once(&course.whole).chain(&course.more).map(|f| (f, *class)))
        .collect();
    let ridge = Ridge::fit(&windows, data.classes.len(), settings.penalty, settings.balance);
    let notes = Provenance {
        date: today(),
        data: data.sources.clone(),
        touches: examples.len(),
        settings: *settings,
    };
    let notes = serde_json::to_string(&notes)?;
    export(&ridge, Head { names: &data.classes, pressed: settings.pressed, notes: &notes })
}

/// Applies a model to touches: for each the class in the data's numbering, and the classes after as many frames as `times` says
/// (the last that there is where a touch is shorter).
pub fn apply(
    model: &Model<'_>,
    data: &Data,
    touches: &[&Touch],
    times: &[usize],
) -> Result<Vec<(usize, Vec<usize>)>> {
    let names: Vec<String> =
        (0..model.classes()).filter_map(|class| model.name(class)).map(|n| n.to_string()).collect();
    let place = |name: &String| data.classes.iter().position(|known| known == name);
    let Some(places) = names.iter().map(place).collect::<Option<Vec<usize>>>() else {
        bail!("the model knows {}, the labels {}", names.join(", "), data.classes.join(", "));
    };
    let recogniser = Touches::new(*model, data.rows, data.columns);
    let mut progress = Progress::of("applying the model", Unit::Steps("touches"), Some(touches.len() as u64));
    let each = (0..).zip(touches).map(|(done, touch)| {
        progress.at(done);
        let (last, early) = decide(&recogniser, data.frames(touch), times);
        (places[last], early.into_iter().map(|class| places[class]).collect())
    });
    Ok(each.collect())
}

/// What a touch is taken for at its end, and after as many frames as `times`, which ascend, say.
pub fn decide<'a>(
    recogniser: &Touches<'_>,
    frames: impl Iterator<Item = &'a [u16]>,
    times: &[usize],
) -> (usize, Vec<usize>) {
    let mut state = TouchState::default();
    let mut early = Vec::new();
    for (number, frame) in frames.enumerate() {
        recogniser.process(&mut state, frame);
        let due = times[early.len()..].iter().take_while(|time| **time == number + 1).count();
        if due > 0 {
            early.extend(vec![recogniser.decide(&state).class; due]);
        }
    }
    let last = recogniser.decide(&state).class;
    early.resize(times.len(), last);
    (last, early)
}

/// Reads the bytes of a model; the error names the file.
pub fn read(path: &Path) -> Result<Vec<u8>> {
    crate::verbose::reads(path);
    let bytes = std::fs::read(path).with_context(|| format!("{}: cannot be read", path.display()))?;
    Model::read(&bytes).with_context(|| path.display().to_string())?;
    Ok(bytes)
}
