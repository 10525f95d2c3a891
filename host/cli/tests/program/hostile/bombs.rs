//! Files that claim to be, or expand to, far more than they are. The program's memory is limited from
//! outside.

use mcap::MAGIC;
use mcap::records::op;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// Address space of the program: that for an empty file, 256 MiB, and some room.
const LIMIT_KIB: u64 = 600 << 10;

/// Runs the program with this limit, to which the size of its input is added.
fn limited(args: &[&str], input: &Path) -> Output {
    let limit = LIMIT_KIB + fs::metadata(input).unwrap().len() / 1024;
    let mut shell = Command::new("sh");
    shell.args(["-c", &format!("ulimit -v {limit}; exec \"$0\" \"$@\""), env!("CARGO_BIN_EXE_taxel")]);
    shell.args(args).stdin(Stdio::null()).output().unwrap()
}

/// It must end by itself, with at most one sentence.
#[track_caller]
fn ends(args: &[&str], input: &Path) -> Output {
    let output = limited(args, input);
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(matches!(output.status.code(), Some(0 | 1)), "{args:?}: {:?} {error}", output.status);
    assert!(!error.contains("panicked") && !error.contains("allocation"), "{args:?}: {error}");
    output
}

fn file(name: &str, bytes: &[u8]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("bombs");
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    fs::write(&path, bytes).unwrap();
    path
}

fn record(number: u8, body: &[u8]) -> Vec<u8> {
    [&[number][..], &(body.len() as u64).to_le_bytes(), body].concat()
}

/// A text that claims to be this long.
fn claim(length: u32) -> Vec<u8> {
    [&length.to_le_bytes()[..], b"short"].concat()
}

/// Bodies of records of which a text, a list or the rest claims to be 4 GB.
fn claims() -> Vec<(u8, Vec<u8>)> {
    let (much, empty) = (claim(u32::MAX), vec![0; 4]);
    let map = [&100u32.to_le_bytes()[..], &much].concat();
    vec![
        (op::HEADER, much.clone()),
        (op::HEADER, [empty.clone(), much.clone()].concat()),
        (op::SCHEMA, [vec![1, 0], much.clone()].concat()),
        (op::SCHEMA, [vec![1, 0], empty.clone(), much.clone()].concat()),
        (op::SCHEMA, [vec![1, 0], empty.clone(), empty.clone(), much.clone()].concat()),
        (op::CHANNEL, [vec![1, 0, 0, 0], much.clone()].concat()),
        (op::CHANNEL, [vec![1, 0, 0, 0], empty.clone(), empty.clone(), map.clone()].concat()),
        (op::CHUNK, [vec![0; 28], much.clone()].concat()),
        (op::MESSAGE_INDEX, [vec![1, 0], much.clone()].concat()),
        (op::CHUNK_INDEX, [vec![0; 32], much.clone()].concat()),
        (op::CHUNK_INDEX, [vec![0; 32], empty.clone(), vec![0; 8], much.clone()].concat()),
        (op::ATTACHMENT, [vec![0; 16], much.clone()].concat()),
        (op::ATTACHMENT, [vec![0; 16], empty.clone(), empty.clone(), vec![0; 8]].concat()),
        (op::ATTACHMENT_INDEX, [vec![0; 40], much.clone()].concat()),
        (op::METADATA, much.clone()),
        (op::METADATA, [empty.clone(), map].concat()),
        (op::METADATA_INDEX, [vec![0; 16], much].concat()),
        (op::STATISTICS, [vec![0; 42], vec![255; 4]].concat()),
    ]
}

/// A complete file with these records in its data and in its summary.
fn mcap(data: &[u8], summary: &[u8]) -> Vec<u8> {
    let mut bytes = MAGIC.to_vec();
    bytes.extend(record(op::HEADER, &[0; 8]));
    bytes.extend_from_slice(data);
    bytes.extend(record(op::DATA_END, &[0; 4]));
    let start = if summary.is_empty() { 0 } else { bytes.len() as u64 };
    bytes.extend_from_slice(summary);
    bytes.extend(record(op::FOOTER, &[&start.to_le_bytes()[..], &[0; 12]].concat()));
    bytes.extend_from_slice(MAGIC);
    bytes
}

#[test]
fn texts_of_four_gigabytes_are_claims() {
    for (index, (number, body)) in claims().into_iter().enumerate() {
        let bad = record(number, &body);
        for (place, bytes) in [("data", mcap(&bad, &[])), ("summary", mcap(&[], &bad))] {
            let path = file(&format!("claim-{index}-{place}.mcap"), &bytes);
            let name = path.to_str().unwrap();
            let csv = path.with_extension("csv");
            for args in [
                &["info", name][..],
                &["info", name, "--check", "--json"],
                &["info", name, "--repair", "--force"],
                &["export", name, "--to", "csv", "--force", "-o", csv.to_str().unwrap()],
                &["live", "--source", &format!("replay:{name}")],
            ] {
                ends(args, &path);
            }
            fs::remove_file(path).unwrap();
        }
    }
}

/// A compressed chunk of this many zeros.
fn zeros(bytes: u64) -> Vec<u8> {
    let mut encoder = lz4_flex::frame::FrameEncoder::new(Vec::new());
    for _ in 0..bytes >> 20 {
        encoder.write_all(&[0; 1 << 20]).unwrap();
    }
    let data = encoder.finish().unwrap();
    let mut body = [0u64.to_le_bytes(), 1u64.to_le_bytes(), bytes.to_le_bytes()].concat();
    body.extend([0; 4]);
    body.extend([&3u32.to_le_bytes()[..], b"lz4"].concat());
    body.extend((data.len() as u64).to_le_bytes());
    body.extend(data);
    record(op::CHUNK, &body)
}

#[test]
fn a_chunk_that_would_fill_the_memory_is_passed_over() {
    let path = file("chunk.mcap", &mcap(&zeros(1 << 30), &[]));
    assert!(fs::metadata(&path).unwrap().len() < 8 << 20);
    let name = path.to_str().unwrap();
    let info = ends(&["info", name, "--check"], &path);
    assert!(info.status.success());
    let csv = path.with_extension("csv");
    let export = ends(&["export", name, "--to", "csv", "--force", "-o", csv.to_str().unwrap()], &path);
    assert_eq!(export.status.code(), Some(1));
    let view = ends(&["view", name, "--port", "0"], &path);
    assert_eq!(view.status.code(), Some(1), "{view:?}");
    fs::remove_file(path).unwrap();
}

/// An archive with arrays of zeros of these sizes, as counts of one byte.
fn archive(name: &str, arrays: &[(&str, u64)]) -> PathBuf {
    let path = file(name, &[]);
    let mut archive = ZipWriter::new(fs::File::create(&path).unwrap());
    let options =
        SimpleFileOptions::default().large_file(true).compression_method(CompressionMethod::Deflated);
    for (name, bytes) in arrays {
        archive.start_file(format!("{name}.npy"), options).unwrap();
        let shape = format!("({}, 32, 16)", bytes / 512);
        let mut head = format!("{{'descr': '|u1', 'fortran_order': False, 'shape': {shape}, }}").into_bytes();
        head.resize(117, b' ');
        head.push(b'\n');
        archive.write_all(b"\x93NUMPY\x01\x00").unwrap();
        archive.write_all(&(head.len() as u16).to_le_bytes()).unwrap();
        archive.write_all(&head).unwrap();
        for _ in 0..bytes >> 20 {
            archive.write_all(&[0; 1 << 20]).unwrap();
        }
    }
    archive.finish().unwrap();
    path
}

#[test]
fn an_archive_that_would_fill_the_memory_is_refused_by_its_array() {
    let one = archive("one.npz", &[("back", 600 << 20)]);
    let many = archive("many.npz", &[("a", 70 << 20), ("b", 70 << 20), ("c", 70 << 20), ("d", 70 << 20)]);
    for (path, array) in [(&one, "back"), (&many, "")] {
        let name = path.to_str().unwrap();
        for args in [&["process", name][..], &["process", name, "--json"]] {
            let output = ends(args, path);
            let error = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(1), "{args:?}: {error}");
            assert!(error.contains(array) && error.contains("MiB"), "{args:?}: {error}");
        }
        fs::remove_file(path).unwrap();
    }
    // The expanded size of a recording of some minutes is accepted.
    let good = archive("good.npz", &[("back", 8 << 20)]);
    let output = ends(&["process", good.to_str().unwrap()], &good);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    fs::remove_file(good).unwrap();
}
