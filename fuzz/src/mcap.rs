//! A fuzzer's bytes as a recording whose lengths and checksums are right, whatever its records hold.

use crate::bytes::Bytes;

const MAGIC: &[u8] = b"\x89MCAP0\r\n";
const FOOTER: u8 = 2;
const CHUNK: u8 = 6;
const DATA_END: u8 = 15;

/// Records, chunks of records, and a summary of records, as the bytes say.
pub fn recording(bytes: &mut Bytes<'_>) -> Vec<u8> {
    let mut file = MAGIC.to_vec();
    let mut summary = None;
    while !bytes.is_empty() {
        match bytes.byte() % 8 {
            0 => file.extend(chunk(bytes)),
            1 if summary.is_none() => {
                file.extend(record(DATA_END, &[0; 4]));
                summary = Some(file.len());
            }
            _ => file.extend(any(bytes)),
        }
    }
    if let Some(start) = summary {
        end(&mut file, start);
    }
    file
}

/// A record of any number with any content.
fn any(bytes: &mut Bytes<'_>) -> Vec<u8> {
    record(bytes.byte() % 17, bytes.piece())
}

fn record(number: u8, body: &[u8]) -> Vec<u8> {
    [&[number][..], &(body.len() as u64).to_le_bytes(), body].concat()
}

/// A chunk of some records, not compressed.
fn chunk(bytes: &mut Bytes<'_>) -> Vec<u8> {
    let times = [u64::from(bytes.word()), u64::from(bytes.word())];
    let plain: Vec<u8> = (0..bytes.byte() % 8).flat_map(|_| any(bytes)).collect();
    let length = (plain.len() as u64).to_le_bytes();
    let crc = crc32fast::hash(&plain).to_le_bytes();
    let [first, last] = times.map(u64::to_le_bytes);
    // Its compression has no name.
    record(CHUNK, &[&first[..], &last, &length, &crc, &[0; 4], &length, &plain].concat())
}

/// The footer, whose checksum is that of the summary and of itself up to there.
fn end(file: &mut Vec<u8>, start: usize) {
    file.extend(record(FOOTER, &[&(start as u64).to_le_bytes()[..], &[0; 12]].concat()));
    let place = file.len() - 4;
    let crc = crc32fast::hash(&file[start..place]);
    file[place..].copy_from_slice(&crc.to_le_bytes());
    file.extend_from_slice(MAGIC);
}
