//! Labelled images prepared for the recogniser: descriptors, classes and groups.

use super::classes::Classes;
use super::labels;
use super::sheet::SheetArgs;
use anyhow::{Result, anyhow, bail, ensure};
use serde_json::{Map, Value, json};
use std::collections::BTreeSet;
use std::path::PathBuf;
use taxel::files::arrays::{self, Frames};
use taxel::files::bases::view::View;
use taxel_core::shape::Descriptor;

/// Source of labelled images.
#[derive(Debug, Clone, clap::Args)]
pub struct Images {
    /// Images: .npz or .npy, one touch each
    #[arg(long, value_name = "FILE")]
    pub images: PathBuf,
    /// Their classes: CSV with a column `index` and one of names
    #[arg(long, value_name = "CSV")]
    pub labels: Option<PathBuf>,
    /// Sets to use of a file that holds NAME_img and NAME_label; * stands for any text
    #[arg(long, value_name = "NAME")]
    pub set: Vec<String>,
    /// Classes to keep, as NAME or NAME=GROUP with commas; or one of `three`, `groups`
    #[arg(long, value_name = "LIST", default_value = "all")]
    pub classes: Classes,
    /// Which part of an image is the touch.
    #[command(flatten)]
    pub view: SheetArgs,
}

/// One image.
#[derive(Debug, Clone)]
pub struct Example {
    /// Descriptor of the touch.
    pub descriptor: Descriptor,
    /// Index of its class.
    pub class: usize,
    /// Index of its label; several labels may be one class.
    pub kind: usize,
    /// Images of one shape under several conditions have the same number, and are never split in
    /// cross-validation.
    pub unit: usize,
    /// Index of its set.
    pub set: usize,
}

/// A set of images.
#[derive(Debug, Clone)]
pub struct Examples {
    /// The images.
    pub list: Vec<Example>,
    /// Names of the classes, sorted.
    pub names: Vec<String>,
    /// Names of the labels, sorted.
    pub kinds: Vec<String>,
    /// Which part of an image was the touch.
    pub view: View,
    /// Rows and columns of the images, if equal for all.
    pub grid: Option<(u16, u16)>,
    /// Names of the sets; an empty name for a file without sets.
    pub sets: Vec<String>,
}

impl Examples {
    /// Accuracy in each set, as an object, from the list of right answers.
    pub fn by_set(&self, right: &[bool]) -> Value {
        let share = |set: usize| {
            let own = self.list.iter().zip(right).filter(|(example, _)| example.set == set);
            let own: Vec<bool> = own.map(|(_, right)| *right).collect();
            own.iter().filter(|right| **right).count() as f64 / own.len().max(1) as f64
        };
        self.sets
            .iter()
            .enumerate()
            .map(|(set, name)| (name.clone(), json!(share(set))))
            .collect::<Map<_, _>>()
            .into()
    }
}

/// Images with the names of their labels.
struct LabelledImages {
    set: String,
    frames: Frames,
    names: Vec<String>,
}

impl Images {
    /// Reads and describes the images; with the view `seen` of a base, unless the arguments set another.
    pub fn read(&self, seen: Option<View>) -> Result<Examples> {
        let sets = self.sets()?;
        let top = sets.iter().flat_map(|set| &set.frames.values).max().copied().unwrap_or(0);
        let view = self.view.choice().build(seen, top);
        let mut kept = Vec::new();
        for (index, set) in sets.iter().enumerate() {
            for (unit, (image, name)) in set.frames.iter().zip(&set.names).enumerate() {
                if let Some(class) = self.classes.of(name) {
                    let descriptor = view.describe(image, set.frames.columns);
                    kept.push((descriptor, class.to_string(), name.clone(), unit, index));
                }
            }
        }
        let file = self.images.display();
        let names = sorted(kept.iter().map(|(_, class, ..)| class));
        let kinds = sorted(kept.iter().map(|(_, _, kind, ..)| kind));
        ensure!(
            names.len() > 1,
            "{file}: holds {} of the classes asked for, at least 2 are needed",
            names.len()
        );
        let index = |names: &[String], name: &String| names.binary_search(name).expect("it is one of them");
        let example = |(descriptor, class, kind, unit, set)| Example {
            descriptor,
            class: index(&names, &class),
            kind: index(&kinds, &kind),
            unit,
            set,
        };
        let list = kept.into_iter().map(example).collect();
        let grid = |set: &LabelledImages| (set.frames.rows, set.frames.columns);
        let first = sets.first().map(grid).filter(|first| sets.iter().all(|set| grid(set) == *first));
        Ok(Examples {
            list,
            names,
            kinds,
            view,
            grid: first,
            sets: sets.into_iter().map(|set| set.set).collect(),
        })
    }

    fn sets(&self) -> Result<Vec<LabelledImages>> {
        if let Some(labels) = &self.labels {
            let frames = arrays::read(&self.images, None)?;
            let names = labels::read(labels, frames.count)?;
            return Ok(vec![LabelledImages { set: String::new(), frames, names }]);
        }
        let file = self.images.display();
        let known: Vec<String> = arrays::names(&self.images)?;
        let known: Vec<&str> = known.iter().filter_map(|name| name.strip_suffix("_img")).collect();
        ensure!(
            !known.is_empty(),
            "{file}: has no set of images with labels; give the file of labels with --labels"
        );
        let asked = |set: &str| self.set.is_empty() || self.set.iter().any(|pattern| matches(pattern, set));
        let sets: Vec<&str> = known.iter().copied().filter(|set| asked(set)).collect();
        if sets.is_empty() {
            let known = known.join(", ");
            bail!("{file}: no set NAME_img was selected; known are {known}");
        }
        let classes = arrays::texts(&self.images, "classes")?;
        sets.into_iter().map(|set| self.labelled(set, classes.as_deref())).collect()
    }

    fn labelled(&self, set: &str, classes: Option<&[String]>) -> Result<LabelledImages> {
        let file = self.images.display();
        let frames = arrays::read(&self.images, Some(&format!("{set}_img")))?;
        let labels = arrays::list(&self.images, &format!("{set}_label"))?;
        let labels = labels.ok_or_else(|| anyhow!("{file}: there is no array {set}_label"))?;
        ensure!(
            labels.len() == frames.count,
            "{file}: {set} has {} images and {} labels",
            frames.count,
            labels.len()
        );
        let name = |label: &u16| match classes {
            None => Ok(label.to_string()),
            Some(names) => names
                .get(usize::from(*label))
                .cloned()
                .ok_or_else(|| anyhow!("{file}: {set}: there is no class {label}")),
        };
        Ok(LabelledImages { set: set.into(), names: labels.iter().map(name).collect::<Result<_>>()?, frames })
    }
}

/// Each name once, sorted.
fn sorted<'a>(names: impl Iterator<Item = &'a String>) -> Vec<String> {
    names.collect::<BTreeSet<_>>().into_iter().cloned().collect()
}

/// True if a text matches a pattern in which `*` stands for any text.
fn matches(pattern: &str, text: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == text,
        Some((start, rest)) => text.strip_prefix(start).is_some_and(|text| {
            (0..=text.len()).any(|skip| text.get(skip..).is_some_and(|text| matches(rest, text)))
        }),
    }
}
