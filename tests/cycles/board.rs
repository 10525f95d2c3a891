//! The image that measures, on the emulated board.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Stdio};
use taxel_bench::stages::case::Step;
use taxel_bench::stages::row::Cost;
use taxel_core::format::Code;
use taxel_suite::chain::Said;
use taxel_suite::kernel::Kernel;

/// What the board did in a step.
#[derive(Debug, Clone)]
pub struct Answer {
    /// What it said.
    pub said: Said,
    /// What it took, in cycles.
    pub cost: Cost,
}

/// Commands of firmware/src/bin/bench.rs.
const RECEIVE: u32 = 1;
const SCAN: u32 = 2;
const FOLD: u32 = 3;
const KERNELS: u32 = 16;

/// Runs the image that TAXEL_BENCH_ELF names.
pub fn run(steps: &[Step]) -> Result<Vec<Answer>, String> {
    let image = std::env::var_os("TAXEL_BENCH_ELF")
        .ok_or("TAXEL_BENCH_ELF names no image: run this by `cargo xtask cycles`")?;
    let operations = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cycles.bin");
    std::fs::write(&operations, steps.iter().flat_map(bytes).collect::<Vec<u8>>())
        .map_err(|error| format!("{}: {error}", operations.display()))?;
    let output = Command::new("node")
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("emulator/bench.mjs"))
        .args([&image, operations.as_os_str()])
        .stderr(Stdio::inherit())
        .output()
        .map_err(|error| format!("node: {error}"))?;
    if !output.status.success() {
        return Err(format!("the emulated board failed ({})", output.status));
    }
    let text = String::from_utf8_lossy(&output.stdout);
    let answers: Option<Vec<Answer>> = text.lines().map(answer).collect();
    answers.filter(|a| a.len() == steps.len()).ok_or("the emulated board left answers out".into())
}

/// A step as the harness reads it.
fn bytes(step: &Step) -> Vec<u8> {
    let halves = |codes: &[Code]| codes.iter().flat_map(|code| code.0.to_le_bytes()).collect();
    let (command, content): (u32, Vec<u8>) = match step {
        Step::Receive(bytes) => (RECEIVE, bytes.clone()),
        Step::Scan(codes) => (SCAN, halves(codes)),
        Step::Fold(on) => (FOLD, vec![1; usize::from(*on) * 2]),
        Step::Kernel(kernel, codes) => {
            let number = Kernel::all().position(|k| k == *kernel).expect("one of all");
            (KERNELS + number as u32, halves(&codes[..]))
        }
    };
    [&command.to_le_bytes(), &(content.len() as u32).to_le_bytes(), &content[..]].concat()
}

/// A line of the harness.
fn answer(line: &str) -> Option<Answer> {
    let value: Value = serde_json::from_str(line).ok()?;
    let number = |value: &Value| value.as_u64();
    let said = Said { bytes: number(&value["bytes"])? as u32, digest: number(&value["digest"])? as u32 };
    let cycles = |stage: usize| number(&value["marks"][stage.to_string()]["cycles"]).unwrap_or(0);
    let cost = Cost { stages: std::array::from_fn(cycles), stack: Some(number(&value["stack"]["used"])?) };
    Some(Answer { said, cost })
}
