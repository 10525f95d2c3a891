//! Files that end anywhere, and disks that are full at any byte.

use super::{Format, Messages, Store, Writer, repair, scan};
use mcap::Summary;
use std::io::{self, Write};
use std::path::PathBuf;

/// A disk with so much room.
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
}

const JSON: Format<'_> =
    Format { encoding: "json", schema: "a", schema_encoding: "jsonschema", text: "{\"type\":\"object\"}" };

/// Writes three chunks of four messages; the first error and what the end said.
fn write(disk: &mut Disk) -> anyhow::Result<(Option<anyhow::Error>, anyhow::Result<u64>)> {
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

fn file(name: &str, bytes: &[u8]) -> PathBuf {
    let path = std::env::temp_dir().join(format!("taxel-{}-{name}.mcap", std::process::id()));
    std::fs::write(&path, bytes).unwrap();
    path
}

/// Messages of a file by its own summary and by going through it, which must agree.
fn messages(path: &PathBuf) -> u64 {
    let bytes = std::fs::read(path).unwrap();
    let summary = Summary::read(&bytes).unwrap().expect("a summary");
    let told = summary.stats.as_ref().unwrap().message_count;
    let all: Vec<_> = Messages::open(path).unwrap().map(Result::unwrap).collect();
    assert_eq!(told, all.len() as u64);
    assert!(all.iter().all(|message| message.data == [b'x'; 50]));
    assert_eq!(summary.chunk_indexes.len() as u64 * 4, told);
    for index in &summary.chunk_indexes {
        assert_eq!(index.message_index_offsets.len(), 2);
        let start = index.chunk_start_offset as usize;
        assert_eq!(bytes[start], mcap::records::op::CHUNK);
        for offset in index.message_index_offsets.values() {
            assert_eq!(bytes[*offset as usize], mcap::records::op::MESSAGE_INDEX);
        }
    }
    assert!(scan(path).unwrap().whole);
    told
}

#[test]
fn a_file_that_ends_anywhere_is_completed_with_all_whole_chunks() {
    let mut whole = disk(usize::MAX);
    let (error, ended) = write(&mut whole).unwrap();
    assert!(error.is_none());
    assert_eq!(ended.unwrap(), whole.bytes.len() as u64);
    let path = file("whole", &whole.bytes);
    assert_eq!(messages(&path), 12);
    assert!(!repair(&path).unwrap(), "it was whole");
    let ends: Vec<u64> = scan(&path)
        .unwrap()
        .contents
        .chunks
        .iter()
        .map(|c| c.index.chunk_start_offset + c.index.chunk_length)
        .collect();
    for length in (8..whole.bytes.len()).step_by(5) {
        let cut = file("cut", &whole.bytes[..length]);
        assert!(repair(&cut).unwrap());
        let chunks = ends.iter().filter(|end| **end <= length as u64).count() as u64;
        assert_eq!(messages(&cut), 4 * chunks, "{length}");
        std::fs::remove_file(&cut).unwrap();
    }
    // A power cut can leave zeros.
    let zeros = [&whole.bytes[..ends[1] as usize + 30], &[0; 3000]].concat();
    let cut = file("zeros", &zeros);
    assert!(repair(&cut).unwrap());
    assert_eq!(messages(&cut), 8);
    for path in [cut, path] {
        std::fs::remove_file(path).unwrap();
    }
}

#[test]
fn a_full_disk_leaves_a_whole_file() {
    let mut whole = disk(usize::MAX);
    write(&mut whole).unwrap().1.unwrap();
    let (mut intact, mut before) = (0, 0);
    for room in 0..whole.bytes.len() {
        let mut disk = disk(room);
        let Ok((error, ended)) = write(&mut disk) else { continue };
        assert!(error.is_some() || ended.is_err() || disk.bytes.len() < whole.bytes.len());
        if let Some(error) = error {
            assert_eq!(error.to_string(), "no space left on device");
        }
        if Summary::read(&disk.bytes).is_ok_and(|summary| summary.is_some()) {
            intact += 1;
            let path = file("full", &disk.bytes);
            let count = messages(&path);
            assert!(count >= before, "more room holds no less");
            before = count;
            std::fs::remove_file(path).unwrap();
        }
    }
    assert_eq!(before, 8, "a byte too few costs the last chunk");
    assert!(intact > whole.bytes.len() / 4, "{intact} of {}", whole.bytes.len());
}

#[test]
fn what_is_no_recording_is_named() {
    let path = file("no", b"hello");
    assert!(scan(&path).unwrap_err().to_string().ends_with("is no MCAP file"));
    std::fs::remove_file(&path).unwrap();
    assert!(format!("{:#}", scan(&path).unwrap_err()).contains("cannot be read"));
}
