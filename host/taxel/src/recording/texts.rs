//! Parses records whose texts are known to lie within them. The crate `mcap` allocates as much memory as a
//! text claims to be long, up to 4 GB each, before it checks the length, and assumes that an attachment has
//! its checksum.

use binrw::BinRead;
use mcap::records::{Record, op};
use mcap::{McapError, McapResult};
use std::io::Cursor;

/// A part of a record's fields.
#[derive(Debug, Clone, Copy)]
enum FieldPart {
    /// This many bytes.
    Fixed(usize),
    /// A length of four bytes, and as many bytes.
    Text,
    /// A length of four bytes, and pairs of texts that fill it.
    Texts,
    /// A length of four bytes, and numbers of this size that fill it.
    Numbers(usize),
}

use FieldPart::{Fixed, Numbers, Text, Texts};

/// Fields of a record up to its last text.
fn parts(number: u8) -> &'static [FieldPart] {
    match number {
        op::HEADER => &[Text, Text],
        op::SCHEMA => &[Fixed(2), Text, Text],
        op::CHANNEL => &[Fixed(4), Text, Text, Texts],
        op::CHUNK => &[Fixed(28), Text],
        op::MESSAGE_INDEX => &[Fixed(2), Numbers(16)],
        op::CHUNK_INDEX => &[Fixed(32), Numbers(10), Fixed(8), Text],
        op::ATTACHMENT => &[Fixed(16), Text, Text],
        op::ATTACHMENT_INDEX => &[Fixed(40), Text, Text],
        op::METADATA => &[Text, Texts],
        op::METADATA_INDEX => &[Fixed(16), Text],
        _ => &[],
    }
}

/// Longest text or list of a record that is read, bytes; names and indexes are shorter.
pub const LONGEST: usize = 1 << 24;
/// Bytes after an attachment's name and type: its length and its checksum.
const AROUND_FILE: usize = 12;

/// True if all texts and lists of a record end within it.
pub(crate) fn texts_fit(number: u8, body: &[u8]) -> bool {
    behind_texts(number, body).is_some()
}

/// Bytes behind the last text; none if a text ends outside the record.
fn behind_texts(number: u8, mut body: &[u8]) -> Option<&[u8]> {
    for part in parts(number) {
        match *part {
            Fixed(bytes) => _ = body.split_off(..bytes)?,
            Text => _ = text(&mut body)?,
            Numbers(bytes) => _ = text(&mut body).filter(|list| list.len().is_multiple_of(bytes))?,
            Texts => {
                let mut pairs = text(&mut body)?;
                while !pairs.is_empty() {
                    let (_name, _value) = (text(&mut pairs)?, text(&mut pairs)?);
                }
            }
        }
    }
    Some(body)
}

fn text<'a>(body: &mut &'a [u8]) -> Option<&'a [u8]> {
    let length = body.split_off(..4)?.try_into().ok()?;
    let length = Some(u32::from_le_bytes(length) as usize).filter(|length| *length <= LONGEST)?;
    body.split_off(..length)
}

/// Parses a record.
pub(crate) fn parse_record(number: u8, body: &[u8]) -> McapResult<Record<'_>> {
    let rest = behind_texts(number, body).ok_or(McapError::UnexpectedEof)?;
    if number == op::ATTACHMENT && rest.len() < AROUND_FILE {
        return Err(McapError::UnexpectedEof);
    }
    mcap::parse_record(number, body)
}

/// Fields at the beginning of the body of a record with this number, and their size.
pub fn fields<T: for<'a> BinRead<Args<'a> = ()>>(number: u8, body: &[u8]) -> Option<(T, usize)> {
    if !texts_fit(number, body) {
        return None;
    }
    let mut cursor = Cursor::new(body);
    let fields = T::read_le(&mut cursor).ok()?;
    Some((fields, cursor.position() as usize))
}

#[cfg(test)]
mod tests {
    use super::super::append::write;
    use super::*;
    use mcap::records::{AttachmentIndex, Channel, ChunkHeader, ChunkIndex, Header, Metadata, MetadataIndex};
    use std::collections::BTreeMap;

    fn words() -> BTreeMap<String, String> {
        BTreeMap::from([("a".into(), "one".into()), ("b".into(), String::new())])
    }

    /// A record of each kind that has texts.
    fn records() -> Vec<(u8, Vec<u8>)> {
        let of = |number, fill: &dyn Fn(&mut Vec<u8>)| {
            let mut body = Vec::new();
            fill(&mut body);
            (number, body)
        };
        let (name, topic) = (String::from("name"), String::from("/a"));
        vec![
            of(op::HEADER, &|out| {
                write(out, &Header { profile: name.clone(), library: topic.clone() }).unwrap()
            }),
            of(op::CHANNEL, &|out| {
                let [topic, message_encoding] = [topic.clone(), name.clone()];
                write(out, &Channel { id: 1, schema_id: 2, topic, message_encoding, metadata: words() })
                    .unwrap();
            }),
            of(op::METADATA, &|out| write(out, &Metadata { name: name.clone(), metadata: words() }).unwrap()),
            of(op::METADATA_INDEX, &|out| {
                write(out, &MetadataIndex { offset: 1, length: 2, name: name.clone() }).unwrap();
            }),
            of(op::ATTACHMENT_INDEX, &|out| {
                let index = AttachmentIndex {
                    offset: 1,
                    length: 2,
                    log_time: 3,
                    create_time: 4,
                    data_size: 5,
                    name: name.clone(),
                    media_type: topic.clone(),
                };
                write(out, &index).unwrap();
            }),
            of(op::CHUNK_INDEX, &|out| {
                let index = ChunkIndex {
                    message_start_time: 1,
                    message_end_time: 2,
                    chunk_start_offset: 3,
                    chunk_length: 4,
                    message_index_offsets: BTreeMap::from([(1, 2), (3, 4)]),
                    message_index_length: 5,
                    compression: name.clone(),
                    compressed_size: 6,
                    uncompressed_size: 7,
                };
                write(out, &index).unwrap();
            }),
            of(op::CHUNK, &|out| {
                let header = ChunkHeader {
                    message_start_time: 1,
                    message_end_time: 2,
                    uncompressed_size: 3,
                    uncompressed_crc: 4,
                    compression: name.clone(),
                    compressed_size: 0,
                };
                write(out, &header).unwrap();
            }),
        ]
    }

    #[test]
    fn whole_records_are_read_and_no_text_may_end_outside() {
        for (number, body) in records() {
            assert!(texts_fit(number, &body) && parse_record(number, &body).is_ok(), "{number}");
            for end in 0..body.len() {
                assert!(parse_record(number, &body[..end]).is_err(), "{number} cut at {end}");
            }
            for at in 0..body.len().saturating_sub(3) {
                let mut claims = body.clone();
                claims[at..at + 4].fill(0xff);
                // If the length of a text was overwritten, it is refused; elsewhere it is another number.
                let _ = parse_record(number, &claims);
            }
        }
        assert!(parse_record(op::ATTACHMENT, &[0; 32]).is_err(), "no room for a checksum");
        assert!(parse_record(op::STATISTICS, &[]).is_err());
    }
}
