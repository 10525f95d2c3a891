//! A drifting garment, and the board's perception of it.

use std::collections::BTreeSet;
use taxel::files::scripts;
use taxel::sim::{Course, Drifting, Patch, World};
use taxel_core::capacity::TAXELS;
use taxel_core::format::{Code, Micros, name};
use taxel_core::garment::{Garment, Layout};
use taxel_core::intent::Leading;
use taxel_core::pipeline::{Pipeline, PipelineState};
use taxel_core::scene::Scene;

/// Code of a taxel at rest, with room on both sides.
const BASE: u16 = 1_500;

/// A trial.
#[derive(Clone)]
pub struct Trial {
    pub garment: Garment,
    /// Frames per second.
    pub hz: f64,
    /// Frames are up to half of this share of a period early or late.
    pub jitter: f64,
    pub common: Course,
    pub patches: Vec<Patch>,
    /// Touches, as in a script.
    pub touches: String,
    /// Noise of a sample, counts rms.
    pub noise: f64,
    pub seed: u64,
}

/// Garments, with the frame rate of the fastest scan.
pub fn garments() -> [(Garment, f64); 4] {
    [
        (Garment::reference(), 195.0),
        (Garment::mat(), 195.0),
        (Garment::block(), 1_562.0),
        (Garment::recorded(20, 27), 195.0),
    ]
}

/// A sheet of 40 columns of small taxels, on which contacts begin at 24 counts.
pub fn fine() -> (Garment, f64) {
    let mut garment = Garment::recorded(32, 40);
    garment.name = name("fine");
    garment.panels[0].pitch_um = [6_000, 7_000];
    (garment, 195.0)
}

impl Trial {
    /// A garment at rest, with this frame rate.
    pub fn new(garment: Garment, hz: f64) -> Trial {
        let common = Course { rate: 0.0, way: 400.0 };
        Trial {
            garment,
            hz,
            jitter: 0.8,
            common,
            patches: Vec::new(),
            touches: String::new(),
            noise: 3.0,
            seed: 1,
        }
    }

    /// Drifts back and forth at this rate, counts per second.
    pub fn drifting(self, rate: f64) -> Trial {
        Trial { common: Course { rate, ..self.common }, ..self }
    }

    /// Adds a touch in the middle of the first panel.
    pub fn touched(self, shape: &str, force_n: f64, start_s: f64, rise_s: f64, hold_s: f64) -> Trial {
        let panel = &self.garment.panels[0];
        let touches = format!(
            "[[touch]]\npanel = \"{}\"\nshape = \"{shape}\"\nforce_n = {force_n}\nat = [{}, {}]\nstart_s = {start_s}\nrise_s = {rise_s}\nhold_s = {hold_s}\nfall_s = 0.5",
            panel.name,
            f64::from(panel.columns / 2) - 0.5,
            f64::from(panel.rows / 2) - 0.5,
        );
        Trial { touches, ..self }
    }
}

/// Perceptions.
#[derive(Debug, Default, Clone)]
pub struct Felt {
    /// Time (s), total pressure (counts) and number of contacts, by frame.
    pub course: Vec<(f64, f64, usize)>,
    /// Time (s) of the frames in which a contact was unsure.
    pub unsure: Vec<f64>,
    /// Ids of all contacts.
    pub ids: BTreeSet<u32>,
    /// Ids of the contacts that were sure in some frame.
    pub sure: BTreeSet<u32>,
    /// All intentions that led, and when each began or ended (s).
    pub led: Vec<Leading>,
    pub led_at: Vec<f64>,
}

impl Felt {
    fn inside(&self, from: f64, to: f64) -> impl Iterator<Item = &(f64, f64, usize)> {
        self.course.iter().filter(move |(t, ..)| (from..to).contains(t))
    }

    /// Share of the frames between two times with a contact.
    pub fn felt(&self, from: f64, to: f64) -> f64 {
        let felt = self.inside(from, to).filter(|(.., contacts)| *contacts > 0).count();
        felt as f64 / self.inside(from, to).count() as f64
    }

    /// Share of the frames with contacts between two times in which one was unsure.
    pub fn unsure(&self, from: f64, to: f64) -> f64 {
        let unsure = self.unsure.iter().filter(|t| (from..to).contains(*t)).count();
        unsure as f64 / self.inside(from, to).filter(|(.., contacts)| *contacts > 0).count() as f64
    }

    /// Mean pressure between two times, counts.
    pub fn pressure(&self, from: f64, to: f64) -> f64 {
        self.inside(from, to).map(|(_, total, _)| total).sum::<f64>() / self.inside(from, to).count() as f64
    }
}

/// Plays it for this many seconds.
pub fn feel(trial: &Trial, seconds: f64) -> Felt {
    let text = format!(
        "duration_s = {}\nseed = {}\n[idle]\nbase_code = {BASE}\nspread_counts = 10\nnoise_counts = {}\n{}",
        seconds.ceil(),
        trial.seed,
        trial.noise,
        trial.touches
    );
    let script = scripts::parse(&text, "drift.toml").expect("a script");
    let layout = Layout::build(&trial.garment, TAXELS, 4095).expect("it fits");
    let world = World::build(&script, &trial.garment).expect("its panels are there");
    let drifting = Drifting::new(world, &layout, trial.common, &trial.patches, trial.seed);
    let pipeline = Pipeline::build(&Scene::shipped(), &layout).expect("the shipped scene fits");
    let mut state = Box::new(PipelineState::<TAXELS, { TAXELS / 2 }>::default());
    state.reset(&layout, false, 4095);
    state.condition.tare(16);
    let mut random = fastrand::Rng::with_seed(trial.seed);
    let (mut raw, mut felt) = (vec![0; layout.taxels()], Felt::default());
    let mut codes = vec![Code(0); layout.taxels()];
    let mut frame = 0;
    loop {
        let late = trial.jitter * (random.f64() - 0.5);
        let now = (f64::from(frame) + late).max(0.0) / trial.hz;
        if now >= seconds {
            return felt;
        }
        frame += 1;
        let start = (now * 1e6) as u64;
        drifting.frame(start, &mut raw);
        codes.iter_mut().zip(&raw).for_each(|(code, raw)| *code = Code(*raw));
        let percept = pipeline.process(&mut *state, &layout, &codes, false, Micros(start), &mut ());
        let total: u64 = percept.present.iter().map(|placed| u64::from(placed.contact.total)).sum();
        felt.course.push((now, total as f64, percept.present.len()));
        let unsure: Vec<u32> = percept.unsure.ids().collect();
        let ids = percept.present.iter().map(|placed| placed.contact.id);
        felt.ids.extend(ids.clone());
        felt.sure.extend(ids.filter(|id| !unsure.contains(id)));
        felt.unsure.extend(percept.unsure.ids().next().map(|_| now));
        if let Some(meaning) = percept.meaning.filter(|meaning| meaning.changed) {
            felt.led.push(meaning.leading);
            felt.led_at.push(now);
        }
    }
}
