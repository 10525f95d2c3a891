//! `cargo xtask peers`: microseconds per 32 x 64 panel, the core beside imageproc, and OpenCV where Python
//! has it.

use image::GrayImage;
use serde_json::{Value, json};
use std::hint::black_box;
use std::io::Write;
use std::process::{Command, Stdio};
use std::time::Instant;
use taxel_core::format::Code;
use taxel_peers::chains;
use taxel_peers::ours::Ours;
use taxel_peers::scenes::{self, Scene};

/// Repetitions that are timed together, and how often. All take turns within a round: what else the machine
/// does, and how fast it is just then, meets them alike. It only ever adds, so the quickest round of each
/// counts; how the ratio of a round is mostly is reported, too.
const ROUNDS: usize = 201;
const REPEATED: u32 = 25;

/// The table as it was last written.
const WRITTEN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/evidence/bench/peers.txt");

fn main() {
    let asked = |option: &str| std::env::args().any(|arg| arg == option);
    let rows = rows();
    if asked("--json") {
        return println!("{}", json!({ "unit": "us per 32 x 64 panel", "rows": rows }));
    }
    let text = table(&rows);
    print!("{text}");
    if asked("--write") {
        std::fs::write(WRITTEN, text).expect(WRITTEN);
    }
}

fn table(rows: &[Value]) -> String {
    let mut text = format!(
        "Microseconds per panel of 32 x 64: median 3x3, Sobel, threshold, labels, moments; one thread, the quickest of {ROUNDS} rounds\n\
         (mostly: the median ratio of a round, whatever else the machine did; all: taxel with axes, ids, velocities and slip, which\n\
         the others do not do)\n\
         scene           taxel  imageproc   ratio  mostly   OpenCV   ratio      all\n",
    );
    for row in rows {
        let number = |key: &str| row[key].as_f64();
        let show = |value: Option<f64>| value.map_or("-".into(), |value| format!("{value:.1}"));
        text += &format!(
            "{:<12} {:>8} {:>10} {:>7} {:>7} {:>8} {:>7} {:>8}\n",
            row["scene"].as_str().unwrap_or(""),
            number("taxel").map_or("-".into(), |value| format!("{value:.2}")),
            show(number("imageproc")),
            show(number("ratio")),
            show(number("ratio_mostly")),
            show(number("opencv")),
            show(number("opencv_ratio")),
            number("follow").map_or("-".into(), |value| format!("{value:.2}")),
        );
    }
    if rows.iter().all(|row| row["opencv"].is_null()) {
        text += "OpenCV: not run, `python3 -c 'import cv2'` fails here\n";
    }
    text
}

/// A scene, the chains that see it, and the times of each round: the core's stages, all that it does,
/// imageproc.
struct Course {
    scene: Scene,
    codes: Vec<Code>,
    panel: GrayImage,
    segment: Ours,
    follow: Ours,
    rounds: Vec<[f64; 3]>,
}

impl Course {
    fn new(scene: Scene) -> Course {
        let codes = scene.values.iter().map(|value| Code(u16::from(*value))).collect();
        let panel = chains::panel(&scene.values);
        Course { scene, codes, panel, segment: Ours::default(), follow: Ours::default(), rounds: Vec::new() }
    }

    fn round(&mut self) {
        let Course { codes, panel, segment, follow, .. } = self;
        self.rounds.push([
            time(|| segment.segment(black_box(codes)).for_each(|sums| _ = black_box(sums))),
            time(|| _ = black_box(follow.follow(black_box(codes)))),
            time(|| _ = black_box(chains::imageproc(black_box(panel)))),
        ]);
    }

    fn row(&self) -> Value {
        let Scene { name, contacts, values } = &self.scene;
        let (ours, theirs) = chains::found(values);
        if ours != theirs || ours.len() != *contacts {
            return json!({ "scene": format!("{name} (void: not the same contacts)") });
        }
        let quickest = |at: usize| self.rounds.iter().map(|round| round[at]).fold(f64::INFINITY, f64::min);
        let [taxel, follow, imageproc] = [0, 1, 2].map(quickest);
        let mostly = median(self.rounds.iter().map(|[taxel, _, imageproc]| imageproc / taxel).collect());
        let opencv = opencv(values);
        json!({
            "scene": name, "contacts": contacts, "taxel": taxel, "imageproc": imageproc, "ratio": imageproc / taxel,
            "ratio_mostly": mostly, "follow": follow, "opencv": opencv, "opencv_ratio": opencv.map(|time| time / taxel),
        })
    }
}

fn rows() -> Vec<Value> {
    let mut courses: Vec<Course> = scenes::all().into_iter().map(Course::new).collect();
    for _ in 0..ROUNDS {
        courses.iter_mut().for_each(Course::round);
    }
    courses.iter().map(Course::row).collect()
}

/// Microseconds of a call, the mean of some.
fn time(mut call: impl FnMut()) -> f64 {
    let start = Instant::now();
    (0..REPEATED).for_each(|_| call());
    start.elapsed().as_secs_f64() * 1e6 / f64::from(REPEATED)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Those steps by OpenCV in Python, one thread; `None` if it is not installed.
fn opencv(values: &[u8]) -> Option<f64> {
    let script = format!(
        "import sys, time, cv2, numpy as np
cv2.setNumThreads(1)
image = np.frombuffer(sys.stdin.buffer.read(), np.uint8).reshape({rows}, {columns})
def chain():
    smooth = cv2.medianBlur(image, 3)
    cv2.Sobel(smooth, cv2.CV_16S, 1, 0), cv2.Sobel(smooth, cv2.CV_16S, 0, 1)
    _, touched = cv2.threshold(smooth, {below}, 255, cv2.THRESH_BINARY)
    count, labels, stats, _ = cv2.connectedComponentsWithStats(touched, connectivity=8)
    for label in range(1, count):
        x, y, w, h, _ = stats[label]
        box = np.s_[y:y + h, x:x + w]
        cv2.moments(smooth[box] * (labels[box] == label))
times = []
for _ in range({ROUNDS}):
    start = time.perf_counter()
    for _ in range({REPEATED}): chain()
    times.append((time.perf_counter() - start) * 1e6 / {REPEATED})
print(min(times))",
        rows = scenes::ROWS,
        columns = scenes::COLUMNS,
        below = scenes::THRESHOLD - 1,
    );
    let mut python = Command::new("python3");
    python.args(["-c", &script]).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
    let mut child = python.spawn().ok()?;
    // A script that ends early for want of cv2 does not read.
    let _ = child.stdin.take()?.write_all(values);
    let output = child.wait_with_output().ok()?;
    String::from_utf8(output.stdout).ok()?.trim().parse().ok()
}
