//! Training a model of touches, and applying one as the board does.

use super::data::{Data, Source, Touch};
use super::export::{Head, export};
use super::ridge::Ridge;
use crate::date::today;
use anyhow::{Context, Result, bail, ensure};
use serde::{Deserialize, Serialize};
use std::path::Path;
use taxel_core::gesture::{Cells, Features, History, Model, Sheet, TouchState, Touches, Window, signals};

/// How a model is trained; a task's own, chosen by cross-validation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// A cell above this counts as touched.
    pub pressed: u16,
    /// Frames of a part that is recognised by itself; 0: none is.
    pub part: u16,
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

/// The windows of a touch from which is learnt.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Course {
    /// The whole touch.
    pub whole: Features,
    /// Its parts, overlapping and half as long, too, where parts are recognised; its mirror images, where these are learnt.
    pub more: Vec<Features>,
}

impl Course {
    /// Of a touch.
    pub fn of(data: &Data, touch: &Touch, settings: &Settings) -> Course {
        let sheet = Sheet::new(data.rows, data.columns);
        let cells: Vec<Cells> = data.frames(touch).map(|frame| sheet.cells(frame)).collect();
        let window = |cells: &[Cells]| features(cells, settings.pressed);
        let part = usize::from(settings.part);
        let mut more = Vec::new();
        if part >= 4 && cells.len() > part {
            more.extend(
                (0..=cells.len() - part).step_by(part / 2).map(|start| window(&cells[start..start + part])),
            );
            more.extend(cells.chunks_exact(part / 2).map(window));
        }
        if settings.mirrored {
            let columns = usize::from(data.columns);
            let images: [Mirror; 3] = [
                |frame, columns| frame.chunks(columns).flat_map(|row| row.iter().rev()).copied().collect(),
                |frame, columns| frame.chunks(columns).rev().flatten().copied().collect(),
                |frame, _| frame.iter().rev().copied().collect(),
            ];
            more.extend(images.iter().map(|image| {
                let cells = data.frames(touch).map(|frame| sheet.cells(&image(frame, columns)));
                window(&cells.collect::<Vec<_>>())
            }));
        }
        Course { whole: window(&cells), more }
    }
}

/// Another image of a frame with so many columns.
type Mirror = fn(&[u16], usize) -> Vec<u16>;

fn features(cells: &[Cells], pressed: u16) -> Features {
    let (mut window, mut history) = (Window::default(), History::default());
    for (number, now) in cells.iter().enumerate() {
        let before = &cells[number.saturating_sub(1)];
        let signals = signals(now, before, pressed);
        window.add(now, before, &signals, &history);
        history.push(&signals);
    }
    window.features()
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
    export(
        &ridge,
        Head { names: &data.classes, pressed: settings.pressed, part: settings.part, notes: &notes },
    )
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
    let each = touches.iter().map(|touch| {
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
    let bytes = std::fs::read(path).with_context(|| format!("{}: cannot be read", path.display()))?;
    Model::read(&bytes).with_context(|| path.display().to_string())?;
    Ok(bytes)
}
