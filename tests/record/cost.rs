//! What recording costs beside perceiving, and how fast a recording is played: printed, never judged.

use super::stage::{Seen, file, plan, play, record};
use std::time::Instant;
use taxel::client::{Client, Event};
use taxel::live::Show;
use taxel::record::Recorder;
use taxel::sim;
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Layout};
use taxel_core::pipeline::{Pipeline, PipelineState};
use taxel_core::scene::Scene;

/// Looks at nothing.
struct Nothing;

impl Show for Nothing {
    fn event(&mut self, _: &Client, _: &Event) -> anyhow::Result<()> {
        Ok(())
    }
}

/// Microseconds that each of `frames` takes.
fn each(frames: usize, what: impl FnOnce()) -> f64 {
    let start = Instant::now();
    what();
    start.elapsed().as_secs_f64() * 1e6 / frames as f64
}

fn perceive(seen: &Seen) {
    let garment = Garment::reference();
    let layout = Layout::build(&garment, 2048, sim::FULL_SCALE).unwrap();
    let pipeline = Pipeline::build(&Scene::shipped(), &layout).unwrap();
    let mut state = Box::new(PipelineState::<2048, 1024>::default());
    state.reset(&layout, garment.wiring.falling, sim::FULL_SCALE);
    for (_, time, image) in &seen.frames {
        let codes: Vec<Code> = image.iter().map(|value| Code(*value)).collect();
        pipeline.process(&mut state, &layout, &codes, garment.wiring.falling, Micros(*time), &mut ());
    }
}

#[test]
fn costs_are_printed() {
    let seen = record("sim:five", plan("cost.mcap", "sim", None, false));
    let frames = seen.frames.len();
    assert!(frames > 400);
    let replay = format!("replay:{}@max", file("cost.mcap").display());
    let perceived = each(frames, || perceive(&seen));
    let read = each(frames, || play(&replay, &mut Nothing));
    let again = |name: &str, ros2| {
        let mut recorder = Recorder::create(plan(name, "replay", None, ros2)).unwrap();
        each(frames, || play(&replay, &mut recorder)) - read
    };
    let (recorded, with_ros2) = (again("cost-again.mcap", false), again("cost-ros2.mcap", true));
    println!("five moving contacts, 2,048 taxels, microseconds a frame on this machine:");
    println!("perceived {perceived:.0}; recorded {recorded:.0}, with ROS 2's messages {with_ros2:.0}");
    println!("replayed {read:.0}: {:.0} times as fast as it was", 1e6 / 195.3 / read);
}
