//! Encodes one record: its number, its length, its body.

use crate::error::{Context, Result};
use binrw::BinWrite;
use std::io::Cursor;

/// Bytes before a record's body: its number (u8) and its length (u64).
pub const HEAD: usize = 9;

/// Appends a record whose body is `fields` and then `data`.
pub fn append<F>(out: &mut Vec<u8>, op: u8, fields: &F, data: &[u8]) -> Result<()>
where
    F: for<'a> BinWrite<Args<'a> = ()>,
{
    append_with(out, op, fields, |out| {
        out.extend_from_slice(data);
        Ok(())
    })
}

/// Appends a record whose body is `fields` and what `data` appends.
pub(crate) fn append_with<F>(
    out: &mut Vec<u8>,
    op: u8,
    fields: &F,
    data: impl FnOnce(&mut Vec<u8>) -> Result<()>,
) -> Result<()>
where
    F: for<'a> BinWrite<Args<'a> = ()>,
{
    let start = out.len();
    out.push(op);
    out.extend([0; HEAD - 1]);
    write(out, fields)?;
    data(out)?;
    let length = (out.len() - start - HEAD) as u64;
    out[start + 1..start + HEAD].copy_from_slice(&length.to_le_bytes());
    Ok(())
}

/// Appends the fields.
pub fn write<F>(out: &mut Vec<u8>, fields: &F) -> Result<()>
where
    F: for<'a> BinWrite<Args<'a> = ()>,
{
    let end = out.len() as u64;
    let mut cursor = Cursor::new(out);
    cursor.set_position(end);
    fields.write_options(&mut cursor, binrw::Endian::Little, ()).context("a record cannot be written")
}

/// Returns the bytes behind their length (u32).
pub(crate) fn sized(data: &[u8]) -> Vec<u8> {
    let mut out = (data.len() as u32).to_le_bytes().to_vec();
    out.extend_from_slice(data);
    out
}
