//! Cost of recording compared with perception, and speed of replay.

use anyhow::{Context, Result};
use clap::Args;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::Instant;
use taxel::client::{Client, Event, ImageNews};
use taxel::record::{Origin, Plan, Recorder};
use taxel::session::Show;
use taxel::sim;
use taxel::source::{self, SourceOptions, SourceSpec, Speed};
use taxel_cli::watch::{LiveArgs, watch};
use taxel_core::capacity::{PARTS, RUNS, TAXELS};
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Layout};
use taxel_core::pipeline::{Pipeline, PipelineState};
use taxel_core::scene::Scene;

/// Scene that is recorded: five moving contacts on 2,048 taxels.
const SCENE: &str = "five";
/// Seconds of it: many chunks, so that what the first one costs does not count.
const SECONDS: f64 = 20.0;
/// Repetitions; the fastest counts, because the others were disturbed.
const TIMES: usize = 3;

/// Arguments of `cargo xtask bench record`.
#[derive(Debug, Clone, Args)]
pub struct RecordBench {
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
}

/// Results, microseconds per frame.
#[derive(Debug, Clone, Copy)]
pub struct RecordCost {
    /// Number of frames.
    pub frames: usize,
    /// Time between frames as sent by the board, us.
    pub period: f64,
    /// Running the board's pipeline on the images, on this machine.
    pub perceived: f64,
    /// Recording the stream.
    pub recorded: f64,
    /// Recording with ROS 2 messages.
    pub with_ros2: f64,
    /// Replaying the recording through a client.
    pub replayed: f64,
}

/// Runs the command.
pub fn run(args: &RecordBench) -> Result<()> {
    let folder = std::env::temp_dir().join(format!("taxel-bench-{}", std::process::id()));
    let measured = measure(&folder);
    // Nothing was made where it cannot be removed.
    let _ = std::fs::remove_dir_all(&folder);
    let cost = measured?;
    if args.json {
        println!("{}", cost.json());
    } else {
        print!("{}", cost.table());
    }
    Ok(())
}

impl RecordCost {
    fn rows(&self) -> [(&'static str, f64); 4] {
        [
            ("perceived", self.perceived),
            ("recorded", self.recorded),
            ("recorded, with ROS 2's messages", self.with_ros2),
            ("replayed", self.replayed),
        ]
    }

    fn frames_per_second(&self) -> f64 {
        1e6 / self.replayed
    }

    /// Readable form.
    pub fn table(&self) -> String {
        let mut text = format!(
            "Five moving contacts on 2,048 taxels, {} frames, one each {:.0} us; on this machine:\n\n{:<34}{:>12}{:>22}\n",
            self.frames, self.period, "", "us a frame", "% of a frame's time"
        );
        for (name, us) in self.rows() {
            text += &format!("{name:<34}{us:>12.1}{:>22.2}\n", 100.0 * us / self.period);
        }
        text + &format!(
            "\nA recording is played at {:.0} frames/s, {:.0} times real time.\n",
            self.frames_per_second(),
            self.period / self.replayed
        )
    }

    /// JSON form.
    pub fn json(&self) -> Value {
        let rows: Vec<_> = self.rows().into_iter().map(|(name, us)| json!([name, us])).collect();
        json!({
            "columns": ["what", "us_a_frame"],
            "rows": rows,
            "frames": self.frames,
            "replayed_frames_per_second": self.frames_per_second(),
            "replayed_times_real_time": self.period / self.replayed,
        })
    }
}

/// Measures, with files in a new folder.
pub fn measure(folder: &Path) -> Result<RecordCost> {
    std::fs::create_dir_all(folder).with_context(|| format!("{} cannot be made", folder.display()))?;
    let file = |name: &str| folder.join(name);
    play(SourceSpec::Sim(SCENE.into()), &mut recorder(file("scene.mcap"), false)?)?;
    let scene = SourceSpec::Replay { path: file("scene.mcap"), board: None, speed: Speed::Max };
    let mut images = Images::default();
    play(scene.clone(), &mut images)?;
    let frames = images.0.len();
    let each = |what: &mut dyn FnMut() -> Result<()>| fastest(what).map(|us| us / frames as f64);
    let replayed = each(&mut || play(scene.clone(), &mut Images::default()))?;
    let again = |name: &str, ros2| {
        let path = file(name);
        let recorded = each(&mut || play(scene.clone(), &mut recorder(path.clone(), ros2)?))?;
        // Without the time of reading; a negative difference is noise.
        anyhow::Ok((recorded - replayed).max(0.0))
    };
    let first_and_last = images.0.first().zip(images.0.last());
    let passed = first_and_last.map_or(0, |((first, _), (last, _))| last.saturating_sub(*first));
    Ok(RecordCost {
        frames,
        period: passed as f64 / (frames.max(2) - 1) as f64,
        perceived: each(&mut || perceive(&images))?,
        recorded: again("again.mcap", false)?,
        with_ros2: again("ros2.mcap", true)?,
        replayed,
    })
}

fn fastest(what: &mut dyn FnMut() -> Result<()>) -> Result<f64> {
    let mut fastest = f64::INFINITY;
    for _ in 0..TIMES {
        let start = Instant::now();
        what()?;
        fastest = fastest.min(start.elapsed().as_secs_f64() * 1e6);
    }
    Ok(fastest)
}

fn recorder(path: PathBuf, ros2: bool) -> Result<Recorder> {
    let origin = Origin { label: format!("sim:{SCENE}"), counts_per_newton: Some(1000.0), calibration: None };
    let inputs = Vec::new();
    Ok(Recorder::create(Plan {
        path,
        rotate: None,
        ros2,
        force: true,
        inputs,
        origin,
        raw: false,
        body: None,
    })?)
}

fn play(spec: SourceSpec, show: &mut dyn Show<anyhow::Error>) -> Result<()> {
    let seconds = matches!(spec, SourceSpec::Sim(_)).then_some(SECONDS);
    let source = source::open(&spec, &SourceOptions { repeat: true, ..SourceOptions::default() })?;
    watch(&LiveArgs { seconds, ..LiveArgs::of(spec) }, source, show)
}

/// Time (us) and values of each image.
#[derive(Debug, Default)]
struct Images(Vec<(u64, Vec<u16>)>);

impl Show<anyhow::Error> for Images {
    fn event(&mut self, client: &Client, event: &Event) -> Result<()> {
        if let (Event::Frame { time, image: ImageNews::Whole, .. }, Some((_, image))) =
            (event, client.image())
        {
            self.0.push((time.0, image.to_vec()));
        }
        Ok(())
    }
}

/// Runs the images through the pipeline as if they were codes: the same taxels are pressed.
fn perceive(images: &Images) -> Result<()> {
    let garment = Garment::reference();
    let layout = Layout::build(&garment, TAXELS, sim::FULL_SCALE)?;
    let pipeline = Pipeline::build(&Scene::shipped(), &layout)?;
    let mut state = Box::new(PipelineState::<TAXELS, RUNS, PARTS>::default());
    state.reset(&layout, garment.wiring.falling, sim::FULL_SCALE);
    let mut codes = Vec::new();
    for (time, image) in &images.0 {
        codes.clear();
        codes.extend(image.iter().map(|value| Code(*value)));
        pipeline.process(&mut state, &layout, &codes, garment.wiring.falling, Micros(*time), &mut ());
    }
    Ok(())
}
