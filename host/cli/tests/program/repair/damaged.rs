//! A flipped bit anywhere, and files that end anywhere.

use super::made::{RecordedMessage, found, read, recording, records, repaired};
use mcap::records::op;
use std::ops::Range;

/// The messages that were lost. There must be no new ones.
fn lost(before: &[RecordedMessage], after: &[RecordedMessage]) -> Vec<RecordedMessage> {
    for message in after {
        assert!(before.contains(message), "{message:?} was not recorded");
    }
    before.iter().filter(|message| !after.contains(message)).cloned().collect()
}

/// Ranges of the chunks.
fn chunks(bytes: &[u8]) -> Vec<Range<usize>> {
    let chunk = |(number, start, end): (u8, usize, usize)| (number == op::CHUNK).then_some(start..end);
    records(bytes).into_iter().filter_map(chunk).collect()
}

#[test]
fn a_bit_costs_one_chunk_at_most() {
    let whole = recording();
    let (before, chunks) = (read(&whole), chunks(&whole));
    assert_eq!((before.len(), chunks.len()), (12, 3));
    for (at, bit) in (0..whole.len()).flat_map(|at| [(at, at % 8), (at, (at + 5) % 8)]) {
        let mut damaged = whole.clone();
        damaged[at] ^= 1 << bit;
        let after = read(&repaired(&damaged));
        let lost = lost(&before, &after);
        match chunks.iter().position(|chunk| chunk.contains(&at)) {
            None => assert!(lost.is_empty(), "bit {bit} of byte {at} lies in no chunk: {lost:?}"),
            Some(chunk) => {
                let inside = &before[4 * chunk..4 * chunk + 4];
                assert!(lost.is_empty() || lost == inside, "bit {bit} of byte {at}: {lost:?}");
            }
        }
    }
}

#[test]
fn a_file_that_is_called_whole_needs_nothing_put_right() {
    let whole = recording();
    let (before, chunks) = (read(&whole), chunks(&whole));
    // Numbers of records; and of a chunk times, sizes, checksum and the name of the compression.
    let numbers = records(&whole).into_iter().map(|(_, start, _)| start);
    let fields: Vec<usize> = chunks.iter().flat_map(|chunk| chunk.start..chunk.start + 52).collect();
    for (at, bit) in numbers.chain(fields.clone()).flat_map(|at| (0..8).map(move |bit| (at, bit))) {
        let mut damaged = whole.clone();
        damaged[at] ^= 1 << bit;
        if found(&damaged).whole {
            assert!(!fields.contains(&at), "bit {bit} of byte {at}");
            // Not all numbers are needed: channels are declared twice.
            assert_eq!(read(&damaged), before, "bit {bit} of byte {at}");
        }
    }
    assert!(found(&whole).whole);
}

#[test]
fn a_bit_of_a_file_without_its_end_costs_one_chunk_at_most() {
    let whole = recording();
    let before = read(&whole);
    let chunks = chunks(&whole);
    let end = chunks[2].end;
    // Channels declared only once, before the chunks, have no checksum and no copy: only times and data are
    // compared.
    let bare = |printed: &[RecordedMessage]| {
        printed.iter().map(|(_, time, data)| (String::new(), *time, data.clone())).collect()
    };
    let before: Vec<RecordedMessage> = bare(&before);
    for at in 0..end {
        let mut damaged = whole[..end].to_vec();
        damaged[at] ^= 1 << (at % 8);
        let after: Vec<RecordedMessage> = bare(&read(&repaired(&damaged)));
        let lost = lost(&before, &after);
        match chunks.iter().position(|chunk| chunk.contains(&at)) {
            None => assert!(lost.is_empty(), "byte {at} lies in no chunk: {lost:?}"),
            Some(chunk) => {
                assert!(lost.is_empty() || lost == before[4 * chunk..4 * chunk + 4], "byte {at}: {lost:?}");
            }
        }
    }
}

#[test]
fn a_file_that_ends_anywhere_keeps_its_whole_chunks() {
    let whole = recording();
    let (before, chunks) = (read(&whole), chunks(&whole));
    for length in 8..whole.len() {
        let after = read(&repaired(&whole[..length]));
        let kept = chunks.iter().filter(|chunk| chunk.end <= length).count();
        assert_eq!(after, before[..4 * kept], "{length} of {} bytes", whole.len());
    }
}

#[test]
fn stretches_of_other_bytes_cost_what_they_cover() {
    let whole = recording();
    let (before, chunks) = (read(&whole), chunks(&whole));
    for (fill, has_end) in [(0, true), (0xAA, true), (0, false), (6, false)] {
        let mut damaged = whole.clone();
        damaged[chunks[0].start + 30..chunks[1].start + 30].fill(fill);
        damaged.truncate(if has_end { whole.len() } else { chunks[2].end });
        // If the summary has the offset of the second chunk, its remainder is readable.
        let kept = if has_end { 4 } else { 8 };
        assert_eq!(read(&repaired(&damaged)), before[kept..], "{fill}, {has_end}");
    }
}

#[test]
fn a_file_without_chunks_loses_one_message_at_most() {
    let mut whole = std::io::Cursor::new(Vec::new());
    let options = mcap::WriteOptions::new().use_chunks(false).compression(None);
    let mut writer = options.create(&mut whole).unwrap();
    let channel = writer.add_channel(0, "/a", "raw", &Default::default()).unwrap();
    for time in 0..8u64 {
        let header = mcap::records::MessageHeader {
            channel_id: channel,
            sequence: 7,
            log_time: time,
            publish_time: 0,
        };
        writer.write_to_known_channel(&header, &[time as u8; 40]).unwrap();
    }
    writer.finish().unwrap();
    drop(writer);
    let whole = whole.into_inner();
    let before = read(&whole);
    for at in 0..whole.len() {
        let mut damaged = whole.clone();
        damaged[at] ^= 1 << (at % 8);
        let after = read(&repaired(&damaged));
        // A flipped bit of a message's own bytes cannot be detected.
        let kept = before.iter().filter(|message| after.contains(message)).count();
        assert!(kept >= 7, "byte {at}: {kept} of 8 messages");
    }
}
