//! Files that end anywhere, and disks that are full at any byte.

use super::append::append;
use super::{Format, Messages, Skipped, Store, Writer, chunk_indexes, repair, scan};
use crate::error::{Error, Result};
use mcap::Summary;
use std::collections::BTreeSet;
use std::io::{self, Read, Write};
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

/// A disk with limited room.
#[derive(Debug)]
struct Disk {
    bytes: Vec<u8>,
    room: usize,
}

impl Write for &mut Disk {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let fits = bytes.len().min(self.room - self.bytes.len());
        if fits == 0 && !bytes.is_empty() {
            return Err(io::Error::new(io::ErrorKind::StorageFull, "no space left on device"));
        }
        self.bytes.extend_from_slice(&bytes[..fits]);
        Ok(fits)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Store for &mut Disk {
    fn keep(&mut self) -> io::Result<()> {
        Ok(())
    }

    fn cut(&mut self, length: u64) -> io::Result<()> {
        self.bytes.truncate(length as usize);
        Ok(())
    }

    fn look(&mut self, offset: u64, bytes: &mut [u8]) -> io::Result<usize> {
        (&self.bytes[offset as usize..]).read(bytes)
    }
}

const JSON: Format<'_> =
    Format { encoding: "json", schema: "a", schema_encoding: "jsonschema", text: b"{\"type\":\"object\"}" };

/// Writes three chunks of four messages. Returns the first error and the result of the end.
fn write(disk: &mut Disk) -> Result<(Option<Error>, Result<u64>)> {
    let mut writer = Writer::create(disk, "")?;
    let channels = [writer.channel("/a", &JSON)?, writer.channel("/b", &JSON)?];
    writer.attach("words.txt", "text/plain", b"hello", 1)?;
    writer.metadata("m", [("k".to_string(), "v".to_string())].into())?;
    let mut chunks = || {
        for chunk in 0..3u64 {
            for message in 0..4u64 {
                let time = 100 * chunk + message;
                writer.message(channels[message as usize % 2], time, time + 5, &[b'x'; 50])?;
            }
            writer.flush()?;
        }
        Ok(())
    };
    let error = chunks().err();
    Ok((error, writer.finish()))
}

fn disk(room: usize) -> Disk {
    Disk { bytes: Vec::new(), room }
}

/// A file of this test only; removed when dropped.
struct TestFile(PathBuf);

impl Deref for TestFile {
    type Target = Path;

    fn deref(&self) -> &Path {
        &self.0
    }
}

impl Drop for TestFile {
    fn drop(&mut self) {
        _ = std::fs::remove_file(&self.0);
    }
}

fn file(name: &str, bytes: &[u8]) -> TestFile {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let path = std::env::temp_dir().join(format!("taxel-{}-{number}-{name}.mcap", std::process::id()));
    std::fs::write(&path, bytes).unwrap();
    TestFile(path)
}

/// Counts the messages of a file by its summary and by a scan, which must agree.
fn messages(path: &Path) -> u64 {
    let bytes = std::fs::read(path).unwrap();
    let summary = Summary::read(&bytes).unwrap().expect("a summary");
    let stated = summary.stats.as_ref().unwrap().message_count;
    assert_eq!(stated, read(path).0.len() as u64);
    assert_eq!(summary.chunk_indexes.len() as u64 * 4, stated);
    for index in &summary.chunk_indexes {
        assert_eq!(index.message_index_offsets.len(), 2);
        let start = index.chunk_start_offset as usize;
        assert_eq!(bytes[start], mcap::records::op::CHUNK);
        for offset in index.message_index_offsets.values() {
            assert_eq!(bytes[*offset as usize], mcap::records::op::MESSAGE_INDEX);
        }
    }
    assert!(scan(path).unwrap().whole);
    stated
}

/// Repairs a file.
fn repaired(path: &Path) -> TestFile {
    let mut bytes = Vec::new();
    repair(path, &scan(path).unwrap(), &mut bytes).unwrap();
    file("repaired", &bytes)
}

/// Log times of the readable messages, and what was skipped.
fn read(path: &Path) -> (Vec<u64>, Skipped) {
    let (mut messages, mut times) = (Messages::open(path).unwrap(), Vec::new());
    while let Some(message) = messages.next_message().unwrap() {
        assert_eq!(message.data, [b'x'; 50]);
        times.push(message.header.log_time);
    }
    (times, messages.skipped())
}

#[test]
fn a_file_that_ends_anywhere_is_completed_with_all_whole_chunks() {
    let mut whole = disk(usize::MAX);
    let (error, ended) = write(&mut whole).unwrap();
    assert!(error.is_none());
    assert_eq!(ended.unwrap(), whole.bytes.len() as u64);
    let path = file("whole", &whole.bytes);
    assert_eq!(messages(&path), 12);
    let ends: Vec<u64> = scan(&path)
        .unwrap()
        .contents
        .chunks
        .iter()
        .map(|c| c.index.chunk_start_offset + c.index.chunk_length)
        .collect();
    for length in (8..whole.bytes.len()).step_by(5) {
        let cut = file("cut", &whole.bytes[..length]);
        let before = std::fs::read(&*cut).unwrap();
        let cut = repaired(&cut);
        assert!(before == whole.bytes[..length], "the damaged file is as it was");
        let chunks = ends.iter().filter(|end| **end <= length as u64).count() as u64;
        assert_eq!(messages(&cut), 4 * chunks, "{length}");
    }
    // A power cut can leave zeros.
    let zeros = [&whole.bytes[..ends[1] as usize + 30], &[0; 3000]].concat();
    let cut = file("zeros", &zeros);
    assert!(!scan(&cut).unwrap().ended);
    assert_eq!(messages(&repaired(&cut)), 8);
}

#[test]
fn what_is_damaged_is_passed_over_and_counted() {
    let mut whole = disk(usize::MAX);
    write(&mut whole).unwrap().1.unwrap();
    let path = file("places", &whole.bytes);
    let places = chunk_indexes(&path).unwrap();
    let [first, second, third] = [0, 1, 2].map(|chunk| places[chunk].chunk_start_offset as usize);
    let others: Vec<u64> = [0, 1, 2, 3, 200, 201, 202, 203].into();
    // With the index at the end, and after a kill, which leaves none.
    for bytes in [&whole.bytes[..], &whole.bytes[..third + places[2].chunk_length as usize]] {
        let mut read_whole = 0;
        for at in second..second + places[1].chunk_length as usize {
            let mut damaged = bytes.to_vec();
            damaged[at] ^= 0x80;
            let path = file("damaged", &damaged);
            let (times, skipped) = read(&path);
            // Times of a chunk, and some bits of LZ4's head, have no checksum: the messages are right all the
            // same.
            let is_read = times.len() == 12;
            let unknown = at == second && bytes.len() < whole.bytes.len();
            assert!(is_read || times == others, "{at}: {times:?}");
            assert_eq!(skipped.chunks, u64::from(!is_read && !unknown), "{at}");
            read_whole += usize::from(is_read);
            let to_the_next = (third - second) as u64;
            let gone = [0, places[1].chunk_length, to_the_next];
            assert!(gone.contains(&skipped.bytes), "{at}: {skipped}");
        }
        assert!(read_whole < 40, "{read_whole} bytes of {} do not matter", places[1].chunk_length);
    }
    // Longer ranges: from the middle of one chunk to the middle of the next.
    let mut damaged = whole.bytes.clone();
    damaged[first + 30..second + 30].fill(0xAA);
    let path = file("damaged", &damaged);
    let (times, skipped) = read(&path);
    assert_eq!(times, [200, 201, 202, 203]);
    assert_eq!((skipped.chunks, skipped.bytes), (2, (third - first) as u64));
    assert_eq!(skipped.time.as_nanos(), 6);
    assert_eq!(skipped.to_string(), format!("skipped 2 damaged chunks, {} bytes, 0.00 s", third - first));
}

#[test]
fn records_that_nobody_knows_are_passed_over() {
    let mut whole = disk(usize::MAX);
    write(&mut whole).unwrap().1.unwrap();
    let path = file("unknown", &whole.bytes);
    let second = chunk_indexes(&path).unwrap()[1].chunk_start_offset as usize;
    let mut bytes = whole.bytes[..second].to_vec();
    append(&mut bytes, 0x8F, &4711u64, b"of a later version").unwrap();
    // Without the end, whose offsets would be wrong.
    bytes.extend_from_slice(&whole.bytes[second..whole.bytes.len() - 60]);
    let path = file("unknown", &bytes);
    let (times, skipped) = read(&path);
    assert_eq!((times.len(), skipped), (12, Skipped::default()));
}

#[test]
fn a_full_disk_keeps_every_chunk_that_it_took() {
    let mut whole = disk(usize::MAX);
    write(&mut whole).unwrap().1.unwrap();
    let path = file("whole", &whole.bytes);
    // Behind a chunk are the indexes of its two channels.
    let ends = scan(&path).unwrap().contents.chunks.iter().map(|chunk| chunk.end()).collect::<Vec<_>>();
    let mut counts = BTreeSet::new();
    for room in 0..whole.bytes.len() {
        let mut disk = disk(room);
        let Ok((error, ended)) = write(&mut disk) else { continue };
        let error = error.or(ended.err()).expect("there is too little room");
        assert_eq!(error.to_string(), "no space left on device");
        let path = file("full", &disk.bytes);
        let kept = repaired(&path);
        let count = messages(&kept);
        assert_eq!(count, 4 * ends.iter().filter(|end| **end <= room as u64).count() as u64, "{room} bytes");
        counts.insert(count);
    }
    assert_eq!(counts, BTreeSet::from([0, 4, 8, 12]));
}

/// A disk that fails from one write on, and whose truncation fails for a while, too.
#[derive(Debug)]
struct Failing {
    bytes: Vec<u8>,
    at: usize,
    /// Number of writes before the failure, and of failing writes and truncations.
    until: usize,
    writes: usize,
    cuts: usize,
    kind: io::ErrorKind,
}

impl Write for &mut Failing {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.until == 0 && self.writes > 0 {
            self.writes -= 1;
            return Err(io::Error::new(self.kind, "it fails"));
        }
        self.until = self.until.saturating_sub(1);
        let taken = if self.until == 0 && self.writes > 0 { bytes.len().div_ceil(2) } else { bytes.len() };
        self.bytes.resize(self.at, 0);
        self.bytes.extend_from_slice(&bytes[..taken]);
        self.at += taken;
        Ok(taken)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Store for &mut Failing {
    fn keep(&mut self) -> io::Result<()> {
        Ok(())
    }

    fn cut(&mut self, length: u64) -> io::Result<()> {
        if self.until == 0 && self.cuts > 0 {
            self.cuts -= 1;
            return Err(io::Error::other("it fails"));
        }
        self.bytes.truncate(length as usize);
        self.at = length as usize;
        Ok(())
    }

    fn look(&mut self, offset: u64, bytes: &mut [u8]) -> io::Result<usize> {
        (&self.bytes[offset as usize..]).read(bytes)
    }
}

/// Number of messages left after a repair, of twenty chunks of four messages on a disk that fails like this.
fn left(until: usize, writes: usize, cuts: usize, kind: io::ErrorKind) -> u64 {
    let mut disk = Failing { bytes: Vec::new(), at: 0, until, writes, cuts, kind };
    let mut writer = Writer::create(&mut disk, "").unwrap();
    let channels = [writer.channel("/a", &JSON).unwrap(), writer.channel("/b", &JSON).unwrap()];
    for chunk in 0..20u64 {
        for message in 0..4u64 {
            let time = 100 * chunk + message;
            writer.message(channels[message as usize % 2], time, time + 5, &[b'x'; 50]).unwrap();
        }
        if writer.flush().is_err() {
            break;
        }
    }
    _ = writer.finish();
    let path = file("failing", &disk.bytes);
    let found = scan(&path).unwrap();
    assert_eq!(found.damaged(), (0, 0), "fails after {until}, {writes} writes and {cuts} cuts");
    let repaired = repaired(&path);
    messages(&repaired)
}

#[test]
fn a_disk_that_fails_costs_the_last_chunk_at_most() {
    use io::ErrorKind::{Other, StorageFull};
    // The header, two channels and a half of the third chunk; the end can be written later, or never.
    for (writes, cuts) in [(1, 0), (1, 1), (2, 0), (2, 2), (1000, 0), (1000, 1000)] {
        assert_eq!(left(6, writes, cuts, Other), 8, "{writes} writes, {cuts} cuts");
    }
    // Only the end fails: its part is truncated.
    for kind in [Other, StorageFull] {
        assert_eq!([0, 2, 1000].map(|cuts| left(24, 1000, cuts, kind)), [80; 3]);
    }
}

#[test]
fn what_is_no_recording_is_named() {
    let path = file("no", b"hello");
    assert!(scan(&path).unwrap_err().to_string().ends_with("is not an MCAP file"));
    assert!(format!("{:#}", scan(&path.with_extension("none")).unwrap_err()).contains("cannot be read"));
}
