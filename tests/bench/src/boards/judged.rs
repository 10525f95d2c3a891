//! `taxel record --view` as a process of its own, of boards that other processes play.

use super::stream::{Brought, Stream};
use anyhow::{Context, Result, bail, ensure};
use std::fs::File;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};
use taxel::record::{COUNTS, Tally};
use taxel::recording::Overview;

/// Boards that one process plays.
const EACH: usize = 10;
/// Time between two looks at the memory.
const LOOK: Duration = Duration::from_secs(10);
/// How long a program may take longer than the streams: boards that are played late.
const PATIENCE: Duration = Duration::from_secs(60);
/// The program rests once it takes less than this of the processor in this time, s: it has what was played.
const REST: (f64, Duration) = (0.3, Duration::from_secs(1));
/// Clock ticks of `/proc` in a second.
const TICKS: f64 = 100.0;

/// What a run has shown.
#[derive(Debug, Clone)]
pub struct Judged {
    /// Number of boards.
    pub boards: usize,
    /// Time that was played, s.
    pub seconds: f64,
    /// What each board has brought.
    pub each: Brought,
    /// Processor time of the program until it had all, s.
    pub cpu_s: f64,
    /// Its memory each ten seconds, MB.
    pub memory_mb: Vec<f64>,
    /// By how much the latest message was sent late, ms.
    pub late_ms: f64,
    /// Bytes that the viewer has read, MB.
    pub viewed_mb: f64,
    /// The recording, MB.
    pub written_mb: f64,
}

impl Judged {
    /// Processor time by elapsed time, % of one core.
    pub fn percent(&self) -> f64 {
        100.0 * self.cpu_s / self.seconds
    }

    /// Processor time of a frame, us.
    pub fn frame_us(&self) -> f64 {
        1e6 * self.cpu_s / (self.each.frames * self.boards as u64) as f64
    }

    /// Most memory in the last minute against that in the second one; none of a shorter run.
    pub fn growth(&self) -> Option<f64> {
        let minute = (60 / LOOK.as_secs()) as usize;
        let most = |part: &[f64]| part.iter().copied().fold(0.0, f64::max);
        let second = self.memory_mb.get(minute..2 * minute)?;
        let last = self
            .memory_mb
            .get(self.memory_mb.len() - minute..)
            .filter(|_| self.memory_mb.len() > 3 * minute)?;
        Some(most(last) / most(second))
    }
}

/// A process that ends with its value.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Records so many boards, in a folder that has the stream as `two.stream`, by this program. Error if anything is
/// lost.
pub fn judge(program: &Path, folder: &Path, stream: &Stream, seconds: f64, boards: usize) -> Result<Judged> {
    let (_players, ports, played) = players(folder, boards)?;
    let board = |(at, port)| format!("[[boards]]\nname = \"b{at}\"\nsource = \"tcp:127.0.0.1:{port}\"\n");
    let robot: String = ports.iter().enumerate().map(board).collect();
    std::fs::write(folder.join("robot.toml"), format!("name = \"many\"\n{robot}"))?;
    let mut recorder = Command::new(program);
    recorder.args(["record", "robot.toml", "-o", "out.mcap", "--force", "--view", "--port", "0"]);
    recorder.current_dir(folder).stdin(Stdio::null()).stdout(Stdio::piped());
    recorder.stderr(File::create(folder.join("said.txt"))?);
    let spawned = recorder.spawn().with_context(|| program.display().to_string())?;
    let mut recorder = Running(spawned);
    let (id, stdout) = (recorder.0.id(), recorder.0.stdout.take().context("no output")?);
    let mut line = String::new();
    BufReader::new(stdout).read_line(&mut line)?;
    let port =
        line.split("127.0.0.1:").nth(1).and_then(|rest| rest.split('/').next()).context(line.clone())?;
    let viewer = view(port)?;
    let (memory_mb, late_ms) = watch(id, ports.len().div_ceil(EACH), &played, seconds)?;
    let cpu_s = rested(id)?;
    ensure!(Command::new("kill").args(["-INT", &id.to_string()]).status()?.success(), "kill failed");
    let said = || std::fs::read_to_string(folder.join("said.txt")).unwrap_or_default();
    ensure!(recorder.0.wait()?.success(), "the recording failed: {}", said());
    let viewed = viewer.join().map_err(|_| anyhow::Error::msg("the viewer panicked"))?;
    ensure!(viewed > 0, "nothing was shown");
    let each = stream.brought();
    let file = folder.join("out.mcap");
    check(program, &file, each, boards)?;
    let written_mb = file.metadata()?.len() as f64 / 1e6;
    std::fs::remove_file(file)?;
    let viewed_mb = viewed as f64 / 1e6;
    Ok(Judged { boards, seconds, each, cpu_s, memory_mb, late_ms, viewed_mb, written_mb })
}

/// Processes that play so many boards: their ports, and the lines that say when all boards of one are played.
fn players(folder: &Path, boards: usize) -> Result<(Vec<Running>, Vec<String>, Receiver<String>)> {
    let (mut running, mut ports) = (Vec::new(), Vec::new());
    let (reported, played) = channel();
    let mut left = boards;
    while left > 0 {
        let count = left.min(EACH);
        left -= count;
        let mut player = Command::new(std::env::current_exe()?);
        player.args(["play", "two.stream", &count.to_string()]).current_dir(folder);
        let mut player = Running(player.stdin(Stdio::null()).stdout(Stdio::piped()).spawn()?);
        let mut lines = BufReader::new(player.0.stdout.take().context("no output")?).lines();
        let first = lines.next().context("a player has ended")??;
        ports.extend(first.split(' ').map(String::from));
        let reported = reported.clone();
        thread::spawn(move || lines.map_while(Result::ok).try_for_each(|line| reported.send(line)));
        running.push(player);
    }
    Ok((running, ports, played))
}

/// Opens a page of the first board, and reads what is sent to it: the number of bytes until the end.
fn view(port: &str) -> Result<thread::JoinHandle<usize>> {
    let mut page = TcpStream::connect(format!("127.0.0.1:{port}"))?;
    write!(
        page,
        "GET /boards/b0/socket HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\
         Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n"
    )?;
    let mut head = [0; 12];
    page.read_exact(&mut head)?;
    ensure!(&head == b"HTTP/1.1 101", "no page: {}", String::from_utf8_lossy(&head));
    Ok(thread::spawn(move || {
        let (mut buffer, mut all) = ([0; 65536], 0);
        while let Ok(count @ 1..) = page.read(&mut buffer) {
            all += count;
        }
        all
    }))
}

/// Looks at the program until all players have played. Returns its memory by the time, MB, and the latest message,
/// ms.
fn watch(id: u32, players: usize, played: &Receiver<String>, seconds: f64) -> Result<(Vec<f64>, f64)> {
    let begun = Instant::now();
    let (mut memory_mb, mut late_us, mut done) = (Vec::new(), 0.0f64, 0);
    while done < players {
        let next = LOOK * (memory_mb.len() as u32 + 1);
        match played.recv_timeout(next.saturating_sub(begun.elapsed())) {
            Ok(late) => {
                late_us = late_us.max(late.parse()?);
                done += 1;
            }
            Err(RecvTimeoutError::Timeout) => memory_mb.push(self::memory_mb(id)?),
            Err(RecvTimeoutError::Disconnected) => bail!("a player has ended"),
        }
        ensure!(begun.elapsed().as_secs_f64() < seconds + PATIENCE.as_secs_f64(), "boards are not played");
    }
    memory_mb.push(self::memory_mb(id)?);
    Ok((memory_mb, late_us / 1e3))
}

/// Waits until the program has all that was played. Returns the processor time that it has taken, s.
fn rested(id: u32) -> Result<f64> {
    let (begun, mut before) = (Instant::now(), cpu_s(id)?);
    while begun.elapsed() < PATIENCE {
        thread::sleep(REST.1);
        let now = cpu_s(id)?;
        if now - std::mem::replace(&mut before, now) < REST.0 {
            return Ok(now);
        }
    }
    bail!("what was played is not recorded {} s later", PATIENCE.as_secs());
}

/// Processor time of a process so far, s.
fn cpu_s(id: u32) -> Result<f64> {
    let text = std::fs::read_to_string(format!("/proc/{id}/stat")).context("the system has no /proc")?;
    // Behind the name: the 12th and 13th words are those of the program and of the system for it.
    let words: Vec<&str> = text.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
    let ticks: Result<Vec<f64>, _> = words.iter().skip(11).take(2).map(|word| word.parse()).collect();
    Ok(ticks?.iter().sum::<f64>() / TICKS)
}

/// Memory of a process now, MB.
fn memory_mb(id: u32) -> Result<f64> {
    let text = std::fs::read_to_string(format!("/proc/{id}/status")).context("the program has ended")?;
    let line = text.lines().find(|line| line.starts_with("VmRSS:")).context("no VmRSS")?;
    Ok(line.split_whitespace().nth(1).context("no VmRSS")?.parse::<f64>()? / 1024.0)
}

/// Error unless the recording is whole, and has of each board all that was played.
fn check(program: &Path, file: &Path, each: Brought, boards: usize) -> Result<()> {
    let checked = Command::new(program).args(["info", "--check"]).arg(file).stdin(Stdio::null()).output()?;
    ensure!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stderr));
    let overview = Overview::of(file)?;
    for board in (0..boards).map(|at| format!("b{at}")) {
        let count = |topic: &str| overview.messages(&format!("/taxel/{board}/{topic}"));
        let written = Brought { frames: count("frames"), contacts: count("contacts") };
        ensure!(written == each, "{board}: {written:?} are recorded of {each:?}");
        let tally =
            overview.words(&format!("{board}/{COUNTS}")).and_then(Tally::read).context("no counts")?;
        let whole = Tally { frames: each.frames, ..Tally::default() };
        ensure!(tally == whole, "{board}: {tally:?}");
    }
    Ok(())
}
