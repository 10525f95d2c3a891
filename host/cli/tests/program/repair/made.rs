//! Small recordings, and what other programs read from them.

use mcap::records::op;
use std::fs::{self, File};
use std::io::Read;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};
use taxel::recording::{Format, Messages, Scan, Writer, repair, scan};

/// A message: topic, log time, data.
pub type RecordedMessage = (String, u64, Vec<u8>);

/// A test's file, deleted at its end.
pub struct Scratch(pub PathBuf);

impl Scratch {
    pub fn new(bytes: &[u8]) -> Scratch {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("taxel-repair-{}-{number}.mcap", std::process::id()));
        fs::write(&path, bytes).unwrap();
        Scratch(path)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        fs::remove_file(&self.0).unwrap();
    }
}

/// Three chunks of four messages on two topics, an attachment and metadata.
pub fn recording() -> Vec<u8> {
    let scratch = Scratch::new(b"");
    let mut writer = Writer::create(File::create(&scratch.0).unwrap(), "").unwrap();
    let format = Format { encoding: "json", schema: "a", schema_encoding: "jsonschema", text: b"{}" };
    let channels = ["/a", "/b"].map(|topic| writer.channel(topic, &format).unwrap());
    writer.attach("words.txt", "text/plain", b"hello", 1).unwrap();
    writer.metadata("m", [("k".to_string(), "v".to_string())].into()).unwrap();
    for time in 0..12u64 {
        let data = format!("{{\"time\": {time}}}");
        writer.message(channels[time as usize % 2], 100 + time, time, data.as_bytes()).unwrap();
        if time % 4 == 3 {
            writer.flush().unwrap();
        }
    }
    writer.finish().unwrap();
    fs::read(&scratch.0).unwrap()
}

/// Scan of a file.
pub fn found(bytes: &[u8]) -> Scan {
    scan(&Scratch::new(bytes).0).unwrap()
}

/// Repairs a file, which must stay unchanged itself.
pub fn repaired(bytes: &[u8]) -> Vec<u8> {
    let scratch = Scratch::new(bytes);
    let mut out = Vec::new();
    let length = repair(&scratch.0, &scan(&scratch.0).unwrap(), &mut out).unwrap();
    assert_eq!(length, out.len() as u64);
    assert!(fs::read(&scratch.0).unwrap() == bytes, "the damaged file is as it was");
    out
}

/// Messages of a file, found by its summary. There may be no error, neither for the crate `mcap` (which is
/// built without LZ4 here and does not look into chunks) nor for us.
pub fn read(bytes: &[u8]) -> Vec<RecordedMessage> {
    let summary = mcap::Summary::read(bytes).unwrap().expect("a summary");
    for record in mcap::read::LinearReader::new(bytes).unwrap() {
        record.unwrap();
    }
    let scratch = Scratch::new(bytes);
    let (mut messages, mut all) = (Messages::open(&scratch.0).unwrap(), Vec::new());
    while let Some(message) = messages.next_message().unwrap() {
        let (header, data) = (message.header, message.data.to_vec());
        let topic = messages.topic(header.channel_id).expect("a channel that was reported before");
        let printed = summary.channels.get(&header.channel_id).expect("a channel that the summary reports");
        assert_eq!(printed.topic, topic);
        all.push((topic.to_string(), header.log_time, data));
    }
    assert!(messages.skipped().is_none());
    for index in &summary.chunk_indexes {
        // Read like readers that also check LZ4's own checksums.
        let end = (index.chunk_start_offset + index.chunk_length) as usize;
        let frame = &bytes[end - index.compressed_size as usize..end];
        let mut plain = Vec::new();
        lz4_flex::frame::FrameDecoder::new(frame).read_to_end(&mut plain).expect("a frame of LZ4");
        assert_eq!(plain.len() as u64, index.uncompressed_size);
        assert_eq!(bytes[index.chunk_start_offset as usize], op::CHUNK);
        assert!(index.message_index_offsets.values().all(|at| bytes[*at as usize] == op::MESSAGE_INDEX));
    }
    assert_eq!(summary.stats.unwrap().message_count, all.len() as u64);
    assert!(scan(&scratch.0).unwrap().whole);
    all
}

/// A record.
pub fn record(number: u8, body: &[u8]) -> Vec<u8> {
    [&[number], &(body.len() as u64).to_le_bytes()[..], body].concat()
}

/// Place of each record: number, first byte, end.
pub fn records(bytes: &[u8]) -> Vec<(u8, usize, usize)> {
    let mut found = Vec::new();
    let mut at = mcap::MAGIC.len();
    while let Some((head, _)) = bytes[at..].split_first_chunk::<9>() {
        let length = u64::from_le_bytes(head[1..].try_into().unwrap()) as usize;
        found.push((head[0], at, at + 9 + length));
        at += 9 + length;
        if head[0] == op::FOOTER {
            break;
        }
    }
    found
}
