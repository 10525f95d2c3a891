//! `taxel info`: what is in a recording.

use crate::client::Counts;
use crate::record::Play;
use crate::recording::{self, ChannelInfo, Scan};
use crate::repair::{RepairArgs, found};
use anyhow::Result;
use clap::Args;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// What `taxel info` takes.
#[derive(Debug, Clone, Args)]
pub struct InfoArgs {
    /// Recording: .mcap
    pub file: PathBuf,
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
    /// The repair.
    #[command(flatten)]
    pub repair: RepairArgs,
}

/// Runs the command.
pub fn run(args: InfoArgs) -> Result<()> {
    let file = if args.repair.repair { args.repair.run(&args.file)? } else { args.file };
    let repaired = args.repair.repair;
    let found = Found::of(&file, repaired)?;
    if args.json {
        println!("{}", found.json());
    } else {
        print!("{}", found.table());
    }
    Ok(())
}

/// What was found in a file.
struct Found<'a> {
    file: &'a Path,
    bytes: u64,
    scan: Scan,
    line: Counts,
    repaired: bool,
}

impl Found<'_> {
    fn of(file: &Path, repaired: bool) -> Result<Found<'_>> {
        let bytes = std::fs::metadata(file).map_or(0, |known| known.len());
        Ok(Found { file, bytes, scan: recording::scan(file)?, line: counted(file)?, repaired })
    }

    fn seconds(&self) -> f64 {
        self.scan.contents.stretch().map_or(0.0, |[first, last]| last.saturating_sub(first) as f64 / 1e9)
    }

    /// Topic, encoding, schema and messages of each channel.
    fn channels(&self) -> Vec<(ChannelInfo, u64)> {
        let counts = self.scan.contents.counts();
        let count = |info: &ChannelInfo| counts.get(&info.channel.id).copied().unwrap_or(0);
        self.scan.contents.channels().map(|info| (info.clone(), count(&info))).collect()
    }

    fn rate(&self, count: u64) -> f64 {
        let seconds = self.seconds();
        if seconds > 0.0 { count.saturating_sub(1) as f64 / seconds } else { 0.0 }
    }

    fn json(&self) -> Value {
        let channel = |(info, count): (ChannelInfo, u64)| {
            json!({
                "topic": info.channel.topic,
                "encoding": info.channel.message_encoding,
                "schema": info.schema,
                "messages": count,
                "hz": self.rate(count),
            })
        };
        let [first, last] = self.scan.contents.stretch().unwrap_or([0; 2]);
        let metadata = self.scan.metadata.iter();
        let words: serde_json::Map<_, _> = metadata.map(|m| (m.name.clone(), json!(m.metadata))).collect();
        json!({
            "file": self.file.display().to_string(),
            "bytes": self.bytes,
            "whole": self.scan.whole,
            "repaired": self.repaired,
            "torn_bytes": self.scan.torn,
            "has_end": self.scan.ended,
            "damaged_chunks": self.scan.damaged().0,
            "damaged_bytes": self.scan.damaged().1,
            "unread_chunks": self.scan.foreign,
            "start_us": first / 1000,
            "end_us": last / 1000,
            "seconds": self.seconds(),
            "frames": self.line.frames,
            "lost": self.line.lost,
            "thinned": self.line.thinned,
            "undecoded": self.line.undecoded,
            "refused": self.line.refused(),
            "restarts": self.line.restarts,
            "channels": self.channels().into_iter().map(channel).collect::<Vec<_>>(),
            "attachments": self.scan.contents.attachments().collect::<Vec<_>>(),
            "metadata": words,
        })
    }

    fn table(&self) -> String {
        let Counts { frames, lost, thinned, restarts, .. } = &self.line;
        let advice = if self.scan.whole { "" } else { ": --repair writes what can be read to another file" };
        let state = format!("{}{advice}", found(&self.scan));
        let mut text = format!("{}: {:.2} MB, {state}\n", self.file.display(), self.bytes as f64 / 1e6);
        for metadata in &self.scan.metadata {
            for (name, value) in metadata.metadata.iter().filter(|(_, value)| !value.is_empty()) {
                text += &format!("  {name:<18} {value}\n");
            }
        }
        let attached: Vec<_> = self.scan.contents.attachments().collect();
        text += &format!("  {:<18} {}\n\n", "attached", attached.join(", "));
        text += &format!(
            "{:.2} s, {frames} frames ({:.1} a second), {lost} lost, {thinned} thinned, {restarts} restarts\n",
            self.seconds(),
            self.rate(*frames)
        );
        for (info, count) in self.channels() {
            let ChannelInfo { channel, schema } = info;
            text += &format!("  {:<26} {count:>8}  {} {schema}\n", channel.topic, channel.message_encoding);
        }
        text
    }
}

/// What a board that is played counts as lost, thinned, restarted; as far as the file can be read.
fn counted(file: &Path) -> Result<Counts> {
    let mut play = Play::open(file)?;
    while let Ok(Some(_)) = play.next_event() {}
    Ok(play.client().counts().clone())
}
