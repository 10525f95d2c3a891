//! Every loop of the program whose board is lost, and then another one answers: what is reported, with which status,
//! and within which time.

use super::Socket;
use crate::start::taxel;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex};
use std::thread::{self, sleep};
use std::time::{Duration, Instant};

/// Longest time until it is reported, s; on a machine that does a lot besides.
const SECONDS: f64 = if cfg!(debug_assertions) { 15.0 } else { 3.0 };

/// What a loop does when it has reported it.
#[derive(Debug, Clone, Copy)]
enum Then {
    GoesOn,
    /// It ends with status 3, once it has waited so many seconds.
    Ends(f64),
}

use Then::{Ends, GoesOn};

/// A command line, what it says when its board is lost, and when another one answers. `{}` is the board's source.
type Row = (&'static str, (&'static str, Then), (&'static str, Then));

const GONE: &str = "{} is gone: ";
const OTHER: &str = "{} answers with another board: it has the garment mat-64x32, not block-4x16\n";
const REFUSED: &str = "error: {} answers with another board: it has the garment mat-64x32, not block-4x16\n";
/// The end of a run that is limited in time.
const LIMITED: &str = "error: {} is gone, and has not come back within 10 s: ";
/// The end of a run that reads raw codes.
const RAW: &str = "error: {} is gone, and has not come back within 5 s: ";

const LOOPS: &[Row] = &[
    ("live --source {}", ("lost: {} is gone: ", GoesOn), ("another board: {} answers with", GoesOn)),
    ("live --json --source {}", ("{\"type\":\"lost\",", GoesOn), ("{\"type\":\"other\",", GoesOn)),
    ("view --port 0 --source {}", (GONE, GoesOn), (OTHER, GoesOn)),
    ("record -o a.mcap --source {}", (GONE, GoesOn), (REFUSED, Ends(0.0))),
    ("health --frames 1000000 --source {}", (LIMITED, Ends(10.0)), (REFUSED, Ends(0.0))),
    ("calibrate -o a.toml --source {}", (RAW, Ends(5.0)), (REFUSED, Ends(0.0))),
    ("live robot.toml --json", ("\"state\":\"lost\"", GoesOn), ("\"state\":\"other\"", GoesOn)),
    ("record robot.toml -o a.mcap", ("board hand: {} is gone: ", GoesOn), (OTHER, GoesOn)),
    #[cfg(feature = "ros2")]
    ("ros2 --domain 228 --source {}", (GONE, GoesOn), (REFUSED, Ends(0.0))),
    #[cfg(feature = "foxglove")]
    ("foxglove --port 0 --source {}", (GONE, GoesOn), (REFUSED, Ends(0.0))),
];

/// All others that last, in a campaign.
const REST: &[Row] = &[
    ("record --view --port 0 -o a.mcap --source {}", (GONE, GoesOn), (REFUSED, Ends(0.0))),
    ("doctor --for 1000s --source {}", (LIMITED, Ends(10.0)), (REFUSED, Ends(0.0))),
    ("report --for 1000s -o a.html --source {}", (LIMITED, Ends(10.0)), (REFUSED, Ends(0.0))),
    ("shapes learn ball -o a.json --source {}", (GONE, GoesOn), (REFUSED, Ends(0.0))),
];

/// A command that follows a board.
struct Running {
    child: Child,
    socket: Socket,
    said: Arc<Mutex<String>>,
}

impl Running {
    /// Starts it, and waits until it has heard the board.
    fn start(folder: &Path, line: &str) -> Running {
        let socket = Socket::new("block-4x16");
        let robot = format!(
            "name = \"one\"\n[[boards]]\nname = \"hand\"\nsource = \"tcp:{}\"\ngarment = \"block-4x16\"\n",
            socket.address
        );
        std::fs::write(folder.join("robot.toml"), robot).unwrap();
        let source = format!("tcp:{}", socket.address);
        let words = line.split(' ').map(|word| word.replace("{}", &source));
        let mut command = Command::new(taxel());
        command.args(words).current_dir(folder).stdin(Stdio::null());
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let said = Arc::<Mutex<String>>::default();
        let pipes: [Box<dyn Read + Send>; 2] =
            [Box::new(child.stdout.take().unwrap()), Box::new(child.stderr.take().unwrap())];
        pipes.into_iter().for_each(|pipe| keep(pipe, said.clone()));
        socket.await_client();
        Running { child, socket, said }
    }

    /// Plugs in another board, or none. Returns after which time that was reported, s.
    fn printed(&mut self, garment: Option<&'static str>, (words, then): (&str, Then)) -> f64 {
        let words = words.replace("{}", &format!("tcp:{}", self.socket.address));
        let longest = SECONDS + if let Ends(seconds) = then { seconds } else { 0.0 };
        let began = Instant::now();
        self.socket.plug(garment);
        while !self.said().contains(&words) {
            assert!(began.elapsed().as_secs_f64() < longest, "{words} is not in: {}", self.said());
            sleep(Duration::from_millis(5));
        }
        let seconds = began.elapsed().as_secs_f64();
        let status = self.child.try_wait().unwrap();
        match then {
            GoesOn => assert_eq!(status, None, "{}", self.said()),
            Ends(_) => assert_eq!(self.child.wait().unwrap().code(), Some(3), "{}", self.said()),
        }
        assert!(!self.said().contains("sim:"), "{}", self.said());
        seconds
    }

    fn said(&self) -> String {
        self.said.lock().unwrap().clone()
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Keeps what a program writes.
fn keep(mut pipe: Box<dyn Read + Send>, said: Arc<Mutex<String>>) {
    thread::spawn(move || {
        let mut buffer = [0; 4096];
        while let Ok(count @ 1..) = pipe.read(&mut buffer) {
            said.lock().unwrap().push_str(&String::from_utf8_lossy(&buffer[..count]));
        }
    });
}

/// A folder of this row's own, new.
fn folder(number: usize) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("exchanged").join(number.to_string());
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Runs a row. Returns its line.
fn row(number: usize, (line, lost, other): Row) -> String {
    let here = folder(number);
    let mut running = Running::start(&here, line);
    let lost_s = running.printed(None, lost);
    if let Ends(_) = lost.1 {
        running = Running::start(&here, line);
    }
    let other_s = running.printed(Some("mat-64x32"), other);
    format!("{line:<48} lost: reported after {lost_s:>4.1} s   another: {other_s:>4.1} s")
}

#[test]
fn a_lost_board_and_another_one_are_reported_by_every_loop() {
    let is_campaign = std::env::var_os("TAXEL_CAMPAIGN").is_some();
    let rest = if is_campaign { REST } else { &[] };
    let rows = LOOPS.iter().chain(rest).copied().enumerate();
    let rows: Vec<_> = rows.map(|(number, one)| thread::spawn(move || row(number, one))).collect();
    let printed: Vec<String> = rows.into_iter().map(|row| row.join().unwrap()).collect();
    if is_campaign {
        printed.iter().for_each(|line| println!("absent: {line}"));
    }
}
