//! Reads attachments of a recording.

use super::texts::fields;
use mcap::records::{AttachmentHeader, op};

/// Header and bytes of an attachment, and whether the record ends behind them; none if it is damaged.
pub fn attached(body: &[u8]) -> Option<(AttachmentHeader, &[u8], bool)> {
    let (header, used) = fields::<AttachmentHeader>(op::ATTACHMENT, body)?;
    let (length, rest) = body.get(used..)?.split_first_chunk()?;
    let (data, crc) = rest.split_at_checked(usize::try_from(u64::from_le_bytes(*length)).ok()?)?;
    let sum = u32::from_le_bytes(*crc.first_chunk()?);
    let summed = body.get(..body.len() - crc.len())?;
    let fits = sum == 0 || sum == crc32fast::hash(summed);
    fits.then_some((header, data, crc.len() == size_of::<u32>()))
}

#[cfg(test)]
mod tests {
    use super::super::append::{append, write};
    use super::*;

    #[test]
    fn what_is_cut_off_anywhere_is_damaged_and_nothing_panics() {
        let header = AttachmentHeader {
            log_time: 1,
            create_time: 2,
            name: "a.txt".into(),
            media_type: "text/plain".into(),
        };
        let mut body = Vec::new();
        write(&mut body, &header).unwrap();
        body.extend(5u64.to_le_bytes());
        body.extend(b"hello");
        let sum = crc32fast::hash(&body);
        body.extend(sum.to_le_bytes());
        assert_eq!(attached(&body), Some((header, &b"hello"[..], true)));
        for length in 0..body.len() {
            assert_eq!(attached(&body[..length]), None, "{length}");
        }
        body[40] ^= 1;
        assert_eq!(attached(&body), None);
        let mut record = Vec::new();
        append(&mut record, op::ATTACHMENT, &0u64, &[]).unwrap();
        assert_eq!(attached(&record[9..]), None);
    }
}
