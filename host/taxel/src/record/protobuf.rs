//! Fields of messages of [Protocol Buffers](https://protobuf.dev/programming-guides/encoding), appended to bytes.

/// Appends a whole number (`int32`, `int64`, an enum).
pub fn whole(out: &mut Vec<u8>, field: u8, value: u64) {
    out.push(field << 3);
    varint(out, value);
}

/// Appends a `fixed32`.
pub fn fixed(out: &mut Vec<u8>, field: u8, value: u32) {
    out.push(field << 3 | 5);
    out.extend(value.to_le_bytes());
}

/// Appends a text, bytes or a message.
pub fn bytes(out: &mut Vec<u8>, field: u8, value: &[u8]) {
    begin(out, field, value.len());
    out.extend_from_slice(value);
}

/// Begins such a field, whose so many bytes follow.
pub fn begin(out: &mut Vec<u8>, field: u8, length: usize) {
    out.push(field << 3 | 2);
    varint(out, length as u64);
}

/// A message whose fields this appends.
pub fn message(fields: impl FnOnce(&mut Vec<u8>)) -> Vec<u8> {
    let mut out = Vec::new();
    fields(&mut out);
    out
}

fn varint(out: &mut Vec<u8>, mut value: u64) {
    while value > 0x7F {
        out.push(value as u8 | 0x80);
        value >>= 7;
    }
    out.push(value as u8);
}
