//! Contents of a recording, as reported by `taxel info`.

use crate::commands::recordings::repair::found as reported;
use anyhow::Result;
use serde_json::{Value, json};
use std::path::Path;
use taxel::record::{COUNTS, Play, Tally};
use taxel::recording::{BoardRecording, ChannelInfo, Overview, Scan, Skipped, footer, scan};
use taxel::text::progress::{Progress, Unit};
use taxel::text::words::printable;

/// Largest file that is always read to its end, bytes: it takes a moment.
const SMALL: u64 = 8 << 20;
/// The topic with a message for each frame.
const FRAMES: &str = "/taxel/frames";

/// Contents and state of a file.
pub struct Contents<'a> {
    file: &'a Path,
    bytes: u64,
    overview: Overview,
    /// Boards: the only one, or those of a robot.
    boards: Vec<RecordedCounts>,
    /// Damage, and what readers pass over; none if the file was not read.
    checked: Option<(Scan, Skipped)>,
    repaired: bool,
}

/// Counts of a board.
struct RecordedCounts {
    recording: BoardRecording,
    /// Number of its images.
    frames: u64,
    /// Line counters of its messages; none if the file holds none and was not read.
    line: Option<Tally>,
}

impl RecordedCounts {
    /// By the file's summary.
    fn reported(overview: &Overview, recording: BoardRecording) -> RecordedCounts {
        RecordedCounts {
            frames: overview.messages(&recording.topic(FRAMES)),
            line: overview.words(&recording.attachment(COUNTS)).and_then(Tally::read),
            recording,
        }
    }

    /// Losses in words.
    fn losses(&self) -> String {
        match &self.line {
            Some(Tally { lost, thinned, restarts, .. }) => {
                format!("{lost} lost, {thinned} thinned, {restarts} restarts")
            }
            None => "losses are not counted: --check counts them".into(),
        }
    }
}

impl Contents<'_> {
    /// Inspects a file by its summary. Reads all of it if `check` is set or the file is small.
    pub fn of(file: &Path, check: bool, repaired: bool) -> Result<Contents<'_>> {
        let bytes = std::fs::metadata(file).map_or(0, |known| known.len());
        let read = check || bytes <= SMALL || footer(file)?.is_none();
        let scan = read.then(|| scan(file)).transpose()?;
        let overview =
            scan.as_ref().map_or_else(|| Overview::of(file), |scan| Ok(Overview::found(file, scan)))?;
        let mut recordings = BoardRecording::all(file, &overview);
        if recordings.is_empty() {
            // A file of another program.
            recordings.push(BoardRecording { path: file.into(), board: None });
        }
        let counted = recordings.into_iter().map(|one| RecordedCounts::reported(&overview, one));
        let mut found =
            Contents { file, bytes, boards: counted.collect(), checked: None, repaired, overview };
        if let Some(scan) = scan {
            let mut skipped = Skipped::default();
            for board in &mut found.boards {
                let (line, passed_over) = played(&board.recording)?;
                (board.frames, board.line) = (line.frames, Some(line));
                // Each reader passes over the damage of its own board's chunks: the worst is reported.
                if passed_over.time >= skipped.time {
                    skipped = passed_over;
                }
            }
            found.checked = Some((scan, skipped));
        }
        Ok(found)
    }

    /// Frames of all boards.
    fn frames(&self) -> u64 {
        self.boards.iter().map(|board| board.frames).sum()
    }

    fn is_of_robot(&self) -> bool {
        self.boards.iter().any(|board| board.recording.board.is_some())
    }

    fn seconds(&self) -> f64 {
        self.overview.stretch.map_or(0.0, |[first, last]| last.saturating_sub(first) as f64 / 1e9)
    }

    /// Topic, encoding, schema and messages of each channel.
    fn channels(&self) -> impl Iterator<Item = (&ChannelInfo, u64)> {
        let counts = &self.overview.counts;
        let count = |info: &ChannelInfo| counts.get(&info.channel.id).copied().unwrap_or(0);
        self.overview.channels.iter().map(move |info| (info, count(info)))
    }

    fn attached(&self) -> Vec<&str> {
        self.overview.attachments.iter().map(|index| index.name.as_str()).collect()
    }

    fn rate(&self, count: u64) -> f64 {
        let seconds = self.seconds();
        if seconds > 0.0 { count.saturating_sub(1) as f64 / seconds } else { 0.0 }
    }

    /// True if the file has its end, and no damage is known.
    fn is_whole(&self) -> bool {
        self.checked.as_ref().map_or(self.overview.torn.is_none(), |(scan, _)| scan.whole)
    }

    /// Encodes as JSON; values are `null` for a large file that was not read.
    pub fn json(&self) -> Value {
        let channel = |(info, count): (&ChannelInfo, u64)| {
            json!({
                "topic": info.channel.topic,
                "encoding": info.channel.message_encoding,
                "schema": info.schema,
                "messages": count,
                "hz": self.rate(count),
            })
        };
        let [first, last] = self.overview.stretch.unwrap_or([0; 2]);
        let metadata = self.overview.metadata.iter();
        let words: serde_json::Map<_, _> = metadata.map(|m| (m.name.clone(), json!(m.metadata))).collect();
        let line = |count: fn(&Tally) -> u64| {
            self.boards.iter().map(|board| board.line.as_ref().map(count)).sum::<Option<u64>>()
        };
        let board = |counted: &RecordedCounts| {
            let RecordedCounts { recording, frames, line } = counted;
            let name = recording.board.clone()?;
            let mut reported = line.map_or(json!({}), |line| json!(line.words(Tally::default())));
            reported["frames"] = json!(frames);
            Some((name, reported))
        };
        let boards: serde_json::Map<_, _> = self.boards.iter().filter_map(board).collect();
        let scan = self.checked.as_ref().map(|(scan, _)| scan);
        json!({
            "file": self.file.display().to_string(),
            "bytes": self.bytes,
            "whole": self.is_whole(),
            "repaired": self.repaired,
            "torn_bytes": self.overview.torn.unwrap_or(0),
            "checked": self.checked.is_some(),
            "has_end": self.overview.torn.is_none(),
            "damaged_chunks": scan.map(|scan| scan.damaged().0),
            "damaged_bytes": scan.map(|scan| scan.damaged().1),
            "damaged_seconds": self.checked.as_ref().map(|(_, skipped)| skipped.time.as_secs_f64()),
            "corrected_records": scan.map(|scan| scan.corrected),
            "unread_chunks": scan.map(|scan| scan.foreign),
            "start_us": first / 1000,
            "end_us": last / 1000,
            "seconds": self.seconds(),
            "frames": self.frames(),
            "lost": line(|line| line.lost),
            "thinned": line(|line| line.thinned),
            "undecoded": line(|line| line.undecoded),
            "refused": line(|line| line.refused),
            "restarts": line(|line| line.restarts),
            "boards": boards,
            "channels": self.channels().map(channel).collect::<Vec<_>>(),
            "attachments": self.attached(),
            "metadata": words,
        })
    }

    /// State in a few words: whole, without its end, damaged.
    fn state(&self) -> String {
        match &self.checked {
            None => "whole by its summary (--check reads all of it)".into(),
            Some((scan, _)) if scan.whole => reported(scan),
            Some((scan, _)) => {
                format!("{}: --repair writes what can be read to another file", reported(scan))
            }
        }
    }

    /// Metadata for people, of a robot board by board.
    fn reported(&self) -> String {
        let mut text = String::new();
        let is_counts = |name: &str| name == COUNTS || name.ends_with("/counts");
        for metadata in self.overview.metadata.iter().filter(|words| !is_counts(&words.name)) {
            if self.is_of_robot() {
                text += &format!("{}\n", printable(metadata.name.trim_end_matches("/taxel")));
            }
            for (name, value) in metadata.metadata.iter().filter(|(_, value)| !value.is_empty()) {
                text += &format!("  {:<18} {}\n", printable(name), printable(value));
            }
        }
        text
    }

    /// Formats for people.
    pub fn table(&self) -> String {
        let mut text =
            format!("{}: {:.2} MB, {}\n", self.file.display(), self.bytes as f64 / 1e6, self.state());
        if let Some((_, skipped)) = self.checked.as_ref().filter(|(_, skipped)| !skipped.is_none()) {
            text += &format!("  {:<18} {skipped}\n", "readers");
        }
        text += &self.reported();
        text += &format!("  {:<18} {}\n\n", "attached", printable(&self.attached().join(", ")));
        text += &format!("{:.2} s", self.seconds());
        for board in &self.boards {
            let name = board.recording.board.as_ref().map(|name| format!("\n  {name}:"));
            let (frames, rate) = (board.frames, self.rate(board.frames));
            let name = name.as_deref().unwrap_or(",");
            text += &format!("{name} {frames} frames ({rate:.1} a second), {}", board.losses());
        }
        text.push('\n');
        for (info, count) in self.channels() {
            let ChannelInfo { channel, schema } = info;
            let [topic, encoding, schema] =
                [&channel.topic, &channel.message_encoding, schema].map(|word| printable(word));
            text += &format!("  {topic:<26} {count:>8}  {encoding} {schema}\n");
        }
        text
    }
}

/// Plays a board's part of the file. Returns lost, thinned and restart counters, and the damage.
fn played(recording: &BoardRecording) -> Result<(Tally, Skipped)> {
    let mut play = Play::open(recording)?;
    let mut progress = Progress::of(format!("reading {recording}"), Unit::Bytes, Some(play.passed()[1]));
    while play.next_event()?.is_some() {
        progress.at(play.passed()[0]);
    }
    Ok((Tally::of(play.client().counts()), play.skipped()))
}
