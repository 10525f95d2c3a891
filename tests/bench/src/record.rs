//! Cost of recording compared with perception, and speed of replay. What the processor does is distinguished from
//! what is waited for: the disk, and other programs.

use anyhow::{Context, Result};
use clap::Args;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::Instant;
use taxel::client::{Client, Event, ImageNews, Stamp};
use taxel::files::calibrate::ForceScale;
use taxel::record::{Origin, Plan, PlannedBoard, Recorder};
use taxel::session::Observer;
use taxel::sim;
use taxel::source::{self, SourceOptions, SourceSpec, Speed};
use taxel_cli::watch::{WatchOptions, watch};
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

/// Results.
#[derive(Debug, Clone, Copy)]
pub struct RecordCost {
    /// Number of frames.
    pub frames: usize,
    /// Time between frames as sent by the board, us.
    pub period: f64,
    /// Running the board's pipeline on the images, on this machine.
    pub perceived: Spent,
    /// Recording the stream.
    pub recorded: Spent,
    /// Recording with ROS 2 messages.
    pub with_ros2: Spent,
    /// Replaying the recording through a client.
    pub replayed: Spent,
}

/// Time of a frame, us.
#[derive(Debug, Clone, Copy)]
pub struct Spent {
    /// Of the processor, in this thread; none if the system does not report it.
    pub cpu: Option<f64>,
    /// From beginning to end.
    pub elapsed: f64,
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
    fn rows(&self) -> [(&'static str, Spent); 4] {
        [
            ("perceived", self.perceived),
            ("recorded", self.recorded),
            ("recorded, with ROS 2's messages", self.with_ros2),
            ("replayed", self.replayed),
        ]
    }

    fn frames_per_second(&self) -> f64 {
        1e6 / self.replayed.elapsed
    }

    /// Readable form.
    pub fn table(&self) -> String {
        let mut text = format!(
            "Five moving contacts on 2,048 taxels, {} frames, one each {:.0} us; on this machine:\n\n{:<34}{:>24}{:>22}{:>14}\n",
            self.frames, self.period, "", "processor, us a frame", "% of a frame's time", "elapsed, us"
        );
        for (name, spent) in self.rows() {
            let [us, share] = match spent.cpu {
                Some(us) => [format!("{us:.1}"), format!("{:.2}", 100.0 * us / self.period)],
                None => ["-".into(), "-".into()],
            };
            text += &format!("{name:<34}{us:>24}{share:>22}{:>14.1}\n", spent.elapsed);
        }
        text + &format!(
            "\nA recording is played at {:.0} frames/s, {:.0} times real time.\n",
            self.frames_per_second(),
            self.period / self.replayed.elapsed
        )
    }

    /// JSON form.
    pub fn json(&self) -> Value {
        let rows: Vec<_> =
            self.rows().into_iter().map(|(name, spent)| json!([name, spent.cpu, spent.elapsed])).collect();
        json!({
            "columns": ["what", "processor_us_a_frame", "elapsed_us_a_frame"],
            "rows": rows,
            "frames": self.frames,
            "replayed_frames_per_second": self.frames_per_second(),
            "replayed_times_real_time": self.period / self.replayed.elapsed,
        })
    }
}

/// Measures, with files in a new folder.
pub fn measure(folder: &Path) -> Result<RecordCost> {
    std::fs::create_dir_all(folder).with_context(|| format!("{} cannot be made", folder.display()))?;
    let file = |name: &str| folder.join(name);
    record(SourceSpec::Sim(SCENE.into()), file("scene.mcap"), false)?;
    let scene = SourceSpec::Replay { recording: file("scene.mcap").into(), speed: Speed::Max };
    let mut images = Images::default();
    play(scene.clone(), &mut images)?;
    let frames = images.0.len();
    let each = |what: &mut dyn FnMut() -> Result<()>| fastest(what, frames as f64);
    let replayed = each(&mut || play(scene.clone(), &mut Images::default()))?;
    let again = |name: &str, ros2| {
        let path = file(name);
        let recorded = each(&mut || record(scene.clone(), path.clone(), ros2))?;
        // Without the time of reading; a negative difference is noise.
        let without = |all: f64, reading: f64| (all - reading).max(0.0);
        anyhow::Ok(Spent {
            cpu: recorded.cpu.zip(replayed.cpu).map(|(all, reading)| without(all, reading)),
            elapsed: without(recorded.elapsed, replayed.elapsed),
        })
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

/// The fastest of some runs of so many frames, by each clock.
fn fastest(what: &mut dyn FnMut() -> Result<()>, frames: f64) -> Result<Spent> {
    let mut fastest = Spent { cpu: Some(f64::INFINITY), elapsed: f64::INFINITY };
    for _ in 0..TIMES {
        let (start, before) = (Instant::now(), cpu_us());
        what()?;
        let cpu = cpu_us().zip(before).map(|(after, before)| (after - before) / frames);
        fastest.cpu = fastest.cpu.zip(cpu).map(|(least, cpu)| least.min(cpu));
        fastest.elapsed = fastest.elapsed.min(start.elapsed().as_secs_f64() * 1e6 / frames);
    }
    Ok(fastest)
}

/// Time of the processor that this thread has taken, us; none where there is no `/proc`.
fn cpu_us() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse::<f64>().ok().map(|ns| ns / 1e3)
}

fn record(spec: SourceSpec, path: PathBuf, ros2: bool) -> Result<()> {
    let origin = Origin { label: format!("sim:{SCENE}"), scale: ForceScale::new(None, Some(1000.0)) };
    let board = PlannedBoard { origin, ..PlannedBoard::default() };
    let recorder = Recorder::create(Plan { ros2, force: true, ..Plan::of(path, board) })?;
    play(spec, &mut recorder.board(0))?;
    Ok(recorder.finish()?)
}

fn play(spec: SourceSpec, observer: &mut dyn Observer) -> Result<()> {
    let seconds = matches!(spec, SourceSpec::Sim(_)).then_some(SECONDS);
    let source = source::open(&spec, &SourceOptions { repeat: true, ..SourceOptions::default() })?;
    watch(&WatchOptions { seconds, ..WatchOptions::of(spec) }, source, observer)
}

/// Time (us) and values of each image.
#[derive(Debug, Default)]
struct Images(Vec<(u64, Vec<u16>)>);

impl Observer for Images {
    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
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
