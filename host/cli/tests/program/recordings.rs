//! `taxel info`, `report`, `live` and `export` on long, damaged and truncated recordings.

use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use taxel::recording::{Messages, chunk_indexes, summary};

fn taxel(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_taxel")).args(args).output().unwrap()
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// A file of a test in the build folder.
fn file(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("recordings");
    fs::create_dir_all(&folder).unwrap();
    folder.join(name)
}

/// Records five contacts for this many seconds; with raw codes a second takes half a megabyte.
fn recorded(name: &str, seconds: u32, raw: bool) -> PathBuf {
    let path = file(name);
    let seconds = format!("{seconds}s");
    let mut args = vec!["record", "--source", "sim:five", "--for", &seconds, "--force", "-o", text(&path)];
    args.extend(raw.then_some("--raw"));
    let done = taxel(&args);
    assert!(done.status.success(), "{done:?}");
    path
}

fn info(path: &Path, more: &[&str]) -> Value {
    let done = taxel(&[&["info", text(path), "--json"], more].concat());
    assert!(done.status.success(), "{done:?}");
    serde_json::from_slice(&done.stdout).unwrap()
}

/// A copy with a flipped bit in the n-th chunk's data.
fn damaged(path: &Path, name: &str, chunk: usize) -> (PathBuf, u64) {
    let mut places = chunk_indexes(path).unwrap();
    // Those of the wire, which is the first channel.
    places.retain(|place| place.message_index_offsets.contains_key(&1));
    let place = &places[chunk];
    let mut bytes = fs::read(path).unwrap();
    bytes[(place.chunk_start_offset + place.chunk_length) as usize - 40] ^= 1;
    let copy = file(name);
    fs::write(&copy, bytes).unwrap();
    (copy, place.chunk_length)
}

#[test]
fn a_large_recording_is_summed_up_without_reading_it() {
    let path = recorded("large.mcap", 20, true);
    let (printed, read) = (info(&path, &[]), info(&path, &["--check"]));
    assert!(printed["bytes"].as_u64() > Some(8 << 20), "{printed}");
    assert_eq!((&printed["checked"], &read["checked"]), (&false.into(), &true.into()));
    for key in
        ["whole", "frames", "lost", "thinned", "undecoded", "refused", "restarts", "seconds", "channels"]
    {
        assert_eq!(printed[key], read[key], "{key}");
        assert!(!printed[key].is_null(), "{key}");
    }
    assert_eq!((&printed["damaged_chunks"], &read["damaged_chunks"]), (&Value::Null, &0.into()));
    // Without the data, only the summary can have been read.
    let (first, last) = {
        let places = chunk_indexes(&path).unwrap();
        let last = &places[places.len() - 1];
        (places[0].chunk_start_offset as usize, (last.chunk_start_offset + last.chunk_length) as usize)
    };
    let mut bytes = fs::read(&path).unwrap();
    bytes[first..last].fill(0xAA);
    let hollow = file("hollow.mcap");
    fs::write(&hollow, bytes).unwrap();
    assert_eq!(info(&hollow, &[])["frames"], printed["frames"]);
    let checked = info(&hollow, &["--check"]);
    assert_eq!((&checked["whole"], checked["damaged_chunks"].as_u64() > Some(15)), (&false.into(), true));
}

#[test]
fn a_frame_of_five_contacts_takes_at_most_1400_bytes() {
    // As long as the touches last.
    let path = recorded("sizes.mcap", 2, false);
    let channels = summary(&path).unwrap().unwrap().channels;
    let (mut messages, mut counts, mut plain) =
        (Messages::open(&path).unwrap(), BTreeMap::new(), BTreeMap::new());
    while let Some(message) = messages.next_message().unwrap() {
        let topic = &channels[&message.header.channel_id].topic;
        *counts.entry(topic).or_insert(0) += 1;
        *plain.entry(topic).or_insert(0) += message.data.len();
    }
    // A chunk is of the wire, of JSON or of images.
    let mut packed = BTreeMap::new();
    for chunk in chunk_indexes(&path).unwrap() {
        let topics: Vec<_> = chunk.message_index_offsets.keys().map(|id| &channels[id].topic).collect();
        let topic = ["/taxel/wire", "/taxel/image", "/taxel/contacts"].into_iter();
        let topic = topic.into_iter().find(|topic| topics.iter().any(|it| it == topic)).unwrap_or("others");
        *packed.entry(topic).or_insert(0) += chunk.compressed_size;
    }
    let frames = counts[&"/taxel/frames".to_string()];
    let each = packed.values().sum::<u64>() / frames;
    println!("{each} bytes a frame");
    assert!(each <= 1400, "{each} bytes a frame of {frames}: packed {packed:?}, not packed {plain:?}");
}

#[test]
fn what_is_damaged_is_passed_over_and_reported() {
    let whole = recorded("whole.mcap", 6, false);
    let (path, bytes) = damaged(&whole, "damaged.mcap", 2);
    let (before, after) = (info(&whole, &[]), info(&path, &[]));
    assert_eq!((&before["whole"], &before["damaged_chunks"]), (&true.into(), &0.into()));
    assert_eq!((&after["whole"], &after["torn_bytes"]), (&false.into(), &0.into()));
    assert_eq!((after["damaged_chunks"].as_u64(), after["damaged_bytes"].as_u64()), (Some(1), Some(bytes)));
    let seconds = after["damaged_seconds"].as_f64().unwrap();
    // On a slow machine, what half a second of its clock has brought is less than that of the board's.
    assert!(seconds > 0.0 && seconds < 1.1, "{seconds}");
    // The frames behind the damage are there; those of the chunk are counted as lost.
    let frames = |info: &Value| info["frames"].as_u64().unwrap();
    let gone = frames(&before) - frames(&after);
    let expected = seconds * 195.3;
    assert!((gone as f64 - expected).abs() < 12.0 && after["lost"].as_u64() >= Some(gone), "{after}");
    let printed = format!("skipped 1 damaged chunk, {bytes} bytes, {seconds:.2} s");
    let table = taxel(&["info", text(&path)]);
    assert!(String::from_utf8_lossy(&table.stdout).contains(&printed), "{table:?}");
    assert!(!String::from_utf8_lossy(&table.stdout).contains("without its end"));
    let (npz, page) = (file("damaged.npz"), file("damaged.html"));
    for args in [
        &["export", text(&path), "--to", "npz", "--force", "-o", text(&npz)][..],
        &["report", text(&path), "--force", "-o", text(&page)],
        &["live", text(&path), "--json"],
    ] {
        let done = taxel(args);
        assert!(done.status.success(), "{args:?}: {}", String::from_utf8_lossy(&done.stderr));
        assert!(String::from_utf8_lossy(&done.stderr).contains(&printed), "{args:?}: {done:?}");
    }
    assert!(fs::read_to_string(page).unwrap().contains(&printed));
    let arrays = taxel::files::arrays::read(&npz, Some("chest")).unwrap();
    // Images behind the damage cannot be decoded until the next key frame.
    assert!(arrays.count as u64 <= frames(&after) && arrays.count as u64 + 220 > frames(&after));
}

/// Largest memory of a run, bytes, sampled from the system.
#[cfg(target_os = "linux")]
fn memory(args: &[&str]) -> u64 {
    use std::process::Stdio;
    let mut run = Command::new(env!("CARGO_BIN_EXE_taxel"))
        .args(args)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let mut most = 0;
    while run.try_wait().unwrap().is_none() {
        let status = fs::read_to_string(format!("/proc/{}/status", run.id())).unwrap_or_default();
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kib = line.and_then(|line| line.trim().trim_end_matches(" kB").parse::<u64>().ok());
        most = most.max(kib.unwrap_or(0) << 10);
        std::thread::sleep(std::time::Duration::from_micros(100));
    }
    assert!(run.wait().unwrap().success(), "{args:?}");
    most
}

#[cfg(target_os = "linux")]
#[test]
fn memory_does_not_grow_with_the_recording() {
    let [short, long] =
        // Even the short one takes long enough to be sampled after its largest chunk.
        [("short.mcap", 60), ("long.mcap", 150)].map(|(name, seconds)| recorded(name, seconds, false));
    let [npz, csv, page] = ["memory.npz", "memory.csv", "memory.html"].map(file);
    let runs = |path: &Path| -> Vec<u64> {
        let path = text(path);
        [
            &["info", path, "--check"][..],
            &["export", path, "--to", "npz", "--force", "-o", text(&npz)],
            &["export", path, "--to", "csv", "--touched", "--force", "-o", text(&csv)],
            &["report", path, "--force", "-o", text(&page)],
        ]
        .map(memory)
        .to_vec()
    };
    // On a busy machine a sample may be long before a run's end: the maximum of three runs counts.
    let most = |a: Vec<u64>, b: Vec<u64>| a.into_iter().zip(b).map(|(a, b)| a.max(b)).collect();
    let short = [runs(&short), runs(&short), runs(&short)].into_iter().reduce(most).unwrap();
    let long = runs(&long);
    for (what, (short, long)) in ["info", "npz", "csv", "report"].iter().zip(short.iter().zip(&long)) {
        println!("{what}: {:.1} MB of 60 s, {:.1} MB of 150 s", *short as f64 / 1e6, *long as f64 / 1e6);
        // 17,600 more frames: their images would be 72 MB, their contacts 9 MB.
        assert!(*short > 1 << 20 && *long < short + (4 << 20), "{what}: {short} and {long} bytes");
    }
}
