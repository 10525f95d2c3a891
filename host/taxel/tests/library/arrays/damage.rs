//! Streams that are cut, and that lose, gain and change bytes.

use super::{decoded, described};
use crate::random::Noise;
use taxel::source::array::ArrayDescription;

/// Forms of all kinds, and streams of them.
fn streams(random: &mut Noise) -> Vec<(ArrayDescription, Vec<u8>)> {
    let mut frame = || -> Vec<u8> { (0..6).map(|_| random.below(256) as u8).collect() };
    let numbers = |frame: &[u8], ends: [&str; 2]| -> Vec<u8> {
        let rows = frame.chunks(3).map(|row| row.iter().map(u8::to_string).collect::<Vec<_>>().join(" "));
        (rows.collect::<Vec<_>>().join(ends[0]) + ends[1]).into_bytes()
    };
    let zeros = |frame: &[u8]| -> Vec<u8> {
        let coded = frame.iter().flat_map(|value| if *value % 255 == 0 { vec![0, 1] } else { vec![*value] });
        coded.chain([255]).collect()
    };
    let crc = |frame: &[u8]| -> Vec<u8> {
        let crc = frame.iter().fold(0xFFFF_u16, |crc, byte| {
            (0..8).fold(crc ^ u16::from(*byte) << 8, |crc, _| {
                crc << 1 ^ if crc >> 15 == 1 { 0x1021 } else { 0 }
            })
        });
        [&[0xA5, 0x5A][..], frame, &crc.to_le_bytes()].concat()
    };
    let summed = |frame: &[u8]| -> Vec<u8> {
        let sum = frame.iter().fold(0xAA_u8, |sum, byte| sum.wrapping_add(*byte));
        [&[0xAA][..], frame, &[sum]].concat()
    };
    type Written<'a> = &'a dyn Fn(&[u8]) -> Vec<u8>;
    let forms: [(&str, Written<'_>); 7] = [
        ("kind = \"bytes\"\nhead = \"AA\"\nvalue = \"u8\"\ncheck = \"sum8\"", &summed),
        ("kind = \"bytes\"\nhead = \"AA 55\"\nvalue = \"u8\"", &|frame| [&[0xAA, 0x55], frame].concat()),
        ("kind = \"bytes\"\ntail = \"00 00 80 7F\"\nvalue = \"u8\"", &|frame| {
            [frame, &[0, 0, 0x80, 0x7F]].concat()
        }),
        (
            "kind = \"bytes\"\nhead = \"A5 5A\"\nvalue = \"u8\"\ncheck = \"crc16-ccitt\"\nover = \"before..after\"",
            &crc,
        ),
        ("kind = \"lines\"", &|frame| numbers(frame, [" ", "\r\n"])),
        ("kind = \"rows\"", &|frame| numbers(frame, ["\n", "\n\n"])),
        ("kind = \"zeros\"", &zeros),
    ];
    forms.map(|(form, written)| (described(form), (0..40).flat_map(|_| written(&frame())).collect())).into()
}

#[test]
fn cuts_change_nothing() {
    let mut random = Noise(61);
    for (description, stream) in streams(&mut random) {
        let whole = decoded(&description, [&stream[..]]);
        assert!(whole.0.len() >= 37, "{description:?}: {}", whole.0.len());
        for _ in 0..1000 {
            let mut pieces = Vec::new();
            let mut rest = &stream[..];
            while !rest.is_empty() {
                let (piece, after) = rest.split_at(1 + random.below(rest.len().min(40) as u64) as usize);
                pieces.push(piece);
                rest = after;
            }
            let cut = decoded(&description, pieces);
            let values = |frames: &[taxel::source::array::ArrayFrame]| -> Vec<Vec<f64>> {
                frames.iter().map(|frame| frame.values.clone()).collect()
            };
            assert_eq!((values(&cut.0), cut.1), (values(&whole.0), whole.1), "{description:?}");
        }
    }
}

/// A byte of a stream is lost, inserted or changed: at most two frames are, and after a 16-bit sum none is wrong.
#[test]
fn damage_stays_where_it_is() {
    let mut random = Noise(62);
    for (description, stream) in streams(&mut random) {
        let whole = decoded(&description, [&stream[..]]).0;
        let has_sum = format!("{description:?}").contains("Crc16");
        let (mut wrong, mut lost) = (0, 0);
        for _ in 0..1000 {
            let (at, byte) = (random.below(stream.len() as u64) as usize, random.below(256) as u8);
            let mut damaged = stream.clone();
            match random.below(3) {
                0 => drop(damaged.remove(at)),
                1 => damaged.insert(at, byte),
                _ => damaged[at] = byte,
            }
            let (frames, _) = decoded(&description, [&damaged[..]]);
            let strange =
                frames.iter().filter(|frame| whole.iter().all(|known| known.values != frame.values));
            wrong += strange.count();
            lost = lost.max(whole.len().saturating_sub(frames.len()));
        }
        assert!(lost <= 3, "{lost} frames are lost in {description:?}");
        // A candidate in 256 passes one byte of sum; damage makes a few.
        let has_byte = format!("{description:?}").contains("Sum8");
        assert!(!has_byte || wrong <= 20, "{wrong} frames are wrong in {description:?}");
        assert!(!has_sum || wrong == 0, "{wrong} frames are wrong in {description:?}");
        assert!(wrong <= 1000, "{wrong} frames are wrong in {description:?}");
    }
}
