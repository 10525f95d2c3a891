//! Unknown parts are copied unchanged: other compressions, records of later versions.

use super::made::{Scratch, record, records, repaired};
use mcap::MAGIC;
use mcap::records::op;
use taxel::recording::scan;

/// Number of a record of another program.
const PRIVATE: u8 = 0x9A;

fn text(text: &str) -> Vec<u8> {
    [&(text.len() as u32).to_le_bytes()[..], text.as_bytes()].concat()
}

/// A chunk that only another program can read.
fn zstd(time: u64) -> Vec<u8> {
    let mut random = fastrand::Rng::with_seed(time);
    let data: Vec<u8> = std::iter::repeat_with(|| random.u8(..)).take(300).collect();
    let times = [time, time + 3, 1000].map(u64::to_le_bytes).concat();
    let sum = 4711u32.to_le_bytes();
    let body = [&times[..], &sum, &text("zstd"), &(data.len() as u64).to_le_bytes(), &data].concat();
    record(op::CHUNK, &body)
}

fn message_index(time: u64) -> Vec<u8> {
    let entries: Vec<u8> = (0..4u64).flat_map(|n| [time + n, 50 * n]).flat_map(u64::to_le_bytes).collect();
    let body = [&1u16.to_le_bytes()[..], &(entries.len() as u32).to_le_bytes(), &entries].concat();
    record(op::MESSAGE_INDEX, &body)
}

/// Records of another program's recording, without its end.
fn data() -> Vec<Vec<u8>> {
    let header = record(op::HEADER, &[text("ros2"), text("another program 1.2")].concat());
    let channel = [&1u16.to_le_bytes()[..], &[0; 2], &text("/camera"), &text("cdr"), &[0; 4]].concat();
    vec![
        header,
        record(op::CHANNEL, &channel),
        zstd(100),
        message_index(100),
        record(PRIVATE, b"of a later version"),
        zstd(200),
        message_index(200),
    ]
}

/// The end: records of the data, the summary with the channel, the footer.
fn end(data: &[Vec<u8>]) -> Vec<u8> {
    let offset = MAGIC.len() + data.concat().len();
    let data_end = record(op::DATA_END, &[0; 4]);
    let summary_start = (offset + data_end.len()) as u64;
    let footer = record(op::FOOTER, &[&summary_start.to_le_bytes()[..], &[0; 12]].concat());
    [&data_end[..], &data[1], &footer, MAGIC].concat()
}

/// Records of a repaired file before its end.
fn kept(bytes: &[u8]) -> Vec<Vec<u8>> {
    let data = records(bytes).into_iter().take_while(|(number, ..)| *number != op::DATA_END);
    data.map(|(_, start, end)| bytes[start..end].to_vec()).collect()
}

#[test]
fn every_record_of_another_program_survives_byte_for_byte() {
    let data = data();
    let whole = [MAGIC, &data.concat(), &end(&data)].concat();
    let scratch = Scratch::new(&whole);
    let found = scan(&scratch.0).unwrap();
    assert!(found.whole && found.ended, "a file with a footer has its end");
    assert_eq!((found.foreign, found.contents.messages("/camera")), (2, 8));
    for bytes in [&whole[..], &whole[..whole.len() - 9], &whole[..MAGIC.len() + data.concat().len()]] {
        let repaired = repaired(bytes);
        assert_eq!(kept(&repaired), data);
        let summary = mcap::Summary::read(&repaired).unwrap().unwrap();
        assert_eq!(summary.chunk_indexes.len(), 2);
        assert_eq!(summary.stats.unwrap().message_count, 8);
        let index = &summary.chunk_indexes[1];
        let at = index.message_index_offsets[&1] as usize;
        assert_eq!(repaired[at..][..message_index(200).len()], message_index(200));
    }
}

#[test]
fn a_bit_costs_one_record_of_another_program_at_most() {
    let data = data();
    let whole = [MAGIC, &data.concat(), &end(&data)].concat();
    for at in (0..MAGIC.len() + data.concat().len()).step_by(3) {
        let mut damaged = whole.clone();
        damaged[at] ^= 1 << (at % 8);
        let kept = kept(&repaired(&damaged));
        let lost = data.iter().filter(|record| !kept.contains(record)).count();
        // The record with the bit; for a chunk also its index, which is useless then.
        assert!(lost <= 2, "byte {at}: {lost} of {} records", data.len());
    }
}

#[test]
fn of_a_chunk_without_an_index_no_number_of_messages_is_claimed() {
    let data: Vec<_> = data().into_iter().filter(|record| record[0] != op::MESSAGE_INDEX).collect();
    let repaired = repaired(&[MAGIC, &data.concat()].concat());
    assert_eq!(kept(&repaired), data);
    let summary = mcap::Summary::read(&repaired).unwrap().unwrap();
    assert!(summary.stats.is_none());
    assert_eq!(summary.chunk_indexes.len(), 2);
}
