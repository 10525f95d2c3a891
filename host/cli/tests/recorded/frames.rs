//! Every recorded frame through the pipeline: nothing panics, sums add up, ids never jump back.
//!
//! By default pmatdata and smart_garment; with TAXEL_RECORDED=all every folder.

use crate::data;
use crate::dense::DenseCondition;
use std::path::PathBuf;
use taxel::files::arrays::{self, Frames};
use taxel_core::condition::{ConditionConfig, ConditionState, Feedback, Filter, Sampled};
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Layout};
use taxel_core::pipeline::{Pipeline, PipelineState};
use taxel_core::scene::Scene;

const TAXELS: usize = 4096;
const FILTERS: [Filter; 5] =
    [Filter::Off, Filter::Conservative, Filter::Median, Filter::Square, Filter::Persistent];

/// Array files of a folder, sorted by name.
fn files(folder: &str) -> Vec<PathBuf> {
    let folder = data::find(folder);
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<_> = entries.map(|entry| entry.expect("it can be listed").path()).collect();
    files.retain(|path| path.extension().is_some_and(|ending| ending == "npy" || ending == "npz"));
    files.sort();
    files
}

/// Runs a recording through the pipeline. Returns the number of contacts.
fn perceive(frames: &Frames, full_scale: u16, what: &str) -> usize {
    let top = frames.values.iter().copied().max().unwrap_or(0).max(full_scale);
    let layout = Layout::build(&Garment::recorded(frames.rows, frames.columns), TAXELS, top).expect(what);
    let scene = Scene::scaled(full_scale);
    let low = u64::from(scene.contact.low);
    let pipeline = Pipeline::build(&scene, &layout).expect(what);
    let mut state = Box::new(PipelineState::<TAXELS, { TAXELS / 2 }>::default());
    state.reset(&layout, false, top);
    let mut newest = 0;
    let mut found = 0;
    for (number, frame) in frames.iter().enumerate() {
        let codes: Vec<Code> = frame.iter().map(|value| Code(*value)).collect();
        let time = Micros(number as u64 * 20_000);
        let percept = pipeline.process(&mut *state, &layout, &codes, false, time, &mut ());
        let above: u64 = percept.image.iter().map(|v| u64::from(*v)).filter(|v| *v >= low).sum();
        let within: u64 = percept.present.iter().map(|p| u64::from(p.contact.total)).sum();
        assert!(within <= above, "{what}, frame {number}: contacts hold {within} of {above} counts");
        for placed in percept.present {
            let contact = &placed.contact;
            let inside = |at: f64, size: u16| (0.0..=f64::from(size) - 1.0).contains(&at);
            assert!(
                inside(contact.x.to_f64(), frames.columns) && inside(contact.y.to_f64(), frames.rows),
                "{what}, frame {number}: a centroid outside the panel"
            );
            assert!(contact.area > 0 && u64::from(contact.total) >= u64::from(contact.peak));
        }
        let ids = percept.present.iter().map(|p| p.contact.id);
        let onsets: Vec<u32> = ids.filter(|id| *id > newest).collect();
        newest = onsets.iter().copied().max().unwrap_or(newest);
        found += onsets.len();
    }
    found
}

fn folder(name: &str, full_scale: u16) {
    let (mut frames, mut contacts) = (0, 0);
    for file in files(name) {
        for (array, recording) in arrays::read_all(&file).expect("a readable recording") {
            frames += recording.count;
            contacts += perceive(&recording, full_scale, &format!("{} {array}", file.display()));
        }
    }
    println!("{name}: {frames} frames, {contacts} contacts");
    assert!(frames > 0 && contacts > 0, "{name} holds touches");
}

/// Conditions at most 100 frames of a recording, with and without skipping inactive taxels; the first frame
/// is the baseline.
fn condition(frames: &Frames, filter: Filter, what: &str) {
    let top = frames.values.iter().copied().max().unwrap_or(1).max(1);
    let layout = Layout::build(&Garment::recorded(frames.rows, frames.columns), TAXELS, top).expect(what);
    let config = ConditionConfig { floor: top / 100 + 1, filter, track_baseline: true };
    let stage = config.build().expect("settings in range");
    let mut state = Box::new(ConditionState::<TAXELS>::new());
    state.reset(&layout, Code(0));
    let mut dense = DenseCondition::new(&layout, config, false, 0);
    for (number, frame) in frames.iter().step_by(frames.count / 100 + 1).enumerate() {
        let codes: Vec<Code> = frame.iter().map(|value| Code(*value)).collect();
        if number == 0 {
            codes.iter().enumerate().for_each(|(taxel, code)| assert!(state.set_baseline(taxel, *code)));
            dense.rest = frame.to_vec();
            dense.tared = true;
        }
        let now = Micros(number as u64 * 20_000);
        let sampled = Sampled { codes: &codes, falling: false, panels: 1, now };
        let image = stage.process(&mut state, &layout, &sampled, &Feedback::<1>::new());
        let want = dense.process(&layout, &sampled, &[]);
        assert_eq!(image.values, want, "{what}, {filter:?}, frame {number}");
    }
}

#[test]
fn sparse_is_dense() {
    for file in files("pmatdata").into_iter().chain(files("smart_garment")) {
        for (array, recording) in arrays::read_all(&file).expect("a readable recording") {
            for filter in FILTERS {
                condition(&recording, filter, &format!("{} {array}", file.display()));
            }
        }
    }
}

#[test]
fn pmatdata() {
    folder("pmatdata", 1000);
}

#[test]
fn smart_garment() {
    folder("smart_garment", 500);
}

#[test]
fn the_rest_where_asked_for() {
    if std::env::var("TAXEL_RECORDED").is_ok_and(|which| which == "all") {
        folder("haart", 1023);
        folder("social_touch", 510);
        folder("tactnet", 255);
    }
}
