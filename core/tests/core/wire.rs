//! Frames and images of the wire: golden bytes, round trips, hostile bytes.

use proptest::collection::vec;
use proptest::prelude::*;
use taxel_core::wire::{
    Receiver, WireError, decode, decode_image, encode, encode_image, frame_bound, image_bound, image_sum,
    open,
};

/// Room for every message of these tests.
type TestReceiver = Receiver<700>;

fn frame(message: &[u8]) -> Vec<u8> {
    let mut out = [0; 700];
    encode(message, &mut out).unwrap().to_vec()
}

/// The messages that are received, and how many frames were refused.
fn receive(link: &mut TestReceiver, bytes: &[u8]) -> (Vec<Vec<u8>>, usize) {
    let (mut messages, mut errors) = (Vec::new(), 0);
    for byte in bytes {
        match link.push(*byte).map(|end| end.and_then(decode::<&[u8]>)) {
            Some(Ok(message)) => messages.push(message.to_vec()),
            Some(Err(_)) => errors += 1,
            None => {}
        }
    }
    (messages, errors)
}

/// CRC-32/ISO-HDLC, bit by bit, from its definition.
fn crc(bytes: &[u8]) -> u32 {
    let bits = |crc: u32, _| crc >> 1 ^ if crc & 1 == 1 { 0xedb8_8320 } else { 0 };
    !bytes.iter().fold(!0, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), bits))
}

fn coded(values: &[u16], base: Option<&[u16]>) -> Vec<u8> {
    let mut out = vec![0xaa; image_bound(values.len(), 16)];
    let length = encode_image(values, base, &mut out).unwrap();
    out.truncate(length);
    out
}

fn decoded(data: &[u8], base: Option<&[u16]>, taxels: usize) -> Result<Vec<u16>, String> {
    let mut out = vec![7; taxels];
    decode_image(data, base, &mut out).map(|()| out).map_err(|error| error.to_string())
}

/// The code of a difference as its prose says, taxel by taxel.
fn described(values: &[u16], base: &[u16]) -> Vec<u8> {
    let numbers: Vec<i32> =
        values.iter().zip(base).map(|(value, base)| i32::from(*value) - i32::from(*base)).collect();
    let varint = |mut value: u32| {
        let mut bytes = Vec::new();
        while value > 127 {
            bytes.push(value as u8 | 128);
            value >>= 7;
        }
        bytes.push(value as u8);
        bytes
    };
    let (mut code, mut encoded, mut at) = (Vec::new(), 0, 0);
    while at < numbers.len() {
        let window = &numbers[at..numbers.len().min(at + 127)];
        let end = window.windows(2).position(|two| two == [0, 0]).unwrap_or(window.len());
        let run = window[..end].iter().rposition(|number| *number != 0).map_or(0, |last| last + 1);
        if window[0] == 0 {
            at += 1;
            continue;
        }
        code.extend([varint((at - encoded) as u32), varint(run as u32)].concat());
        code.extend(window[..run].iter().flat_map(|number| varint((number << 1 ^ number >> 31) as u32)));
        at += run;
        encoded = at;
    }
    code
}

#[test]
fn golden_frames() {
    let mut out = [0xaa; 64];
    let frame = encode(&(1u32, "ab"), &mut out).unwrap();
    // 1, length 2, "ab"; CRC-32 0x45263685.
    assert_eq!(frame, [9, 1, 2, 0x61, 0x62, 0x85, 0x36, 0x26, 0x45, 0]);
    // A zero of the message is the code byte of the next group.
    let frame = encode(&(0u32, 300u16, -1i8), &mut out).unwrap();
    assert_eq!(crc(&[0, 0xac, 2, 0xff]).to_le_bytes(), frame[5..9]);
    assert_eq!(frame[..5], [1, 8, 0xac, 2, 0xff]);
    assert_eq!(crc(b"123456789"), 0xcbf4_3926);
    assert_eq!(frame[9..], [0]);
}

#[test]
fn each_error_has_its_cause() {
    let bad = |mut bytes: Vec<u8>| open(&mut bytes).map(<[u8]>::to_vec);
    let good = frame(b"abc");
    let end = good.len() - 1;
    assert_eq!(bad(good[..end].to_vec()).as_deref(), Ok(&b"\x03abc"[..]));
    assert_eq!(bad(vec![]), Err(WireError::TooShort));
    assert_eq!(bad(vec![1; 5]), Err(WireError::TooShort), "an empty message with its CRC, 0");
    for length in 0..=5 {
        assert_eq!(bad(vec![9; length]), Err(WireError::TooShort), "{length} bytes, whatever they are");
    }
    assert_eq!(bad(good[..end - 1].to_vec()), Err(WireError::Cobs));
    assert_eq!(bad(good.clone()), Err(WireError::Cobs), "with its 0x00");
    let mut wrong = good[..end].to_vec();
    wrong[2] ^= 1;
    assert_eq!(bad(wrong), Err(WireError::Crc));
    assert_eq!(decode::<&str>(&[2, 0x61]), Err(WireError::Message));
    assert_eq!(decode::<bool>(&[2]), Err(WireError::Message));
    let short = |room: usize| encode(b"abc", &mut vec![0; room]).map(<[u8]>::len);
    assert_eq!(short(9), Ok(9));
    for room in 0..9 {
        assert_eq!(short(room), Err(WireError::NoRoom));
    }
    assert_eq!(encode(&(), &mut [0; 9]), Err(WireError::TooShort));
    assert_eq!(WireError::Cobs.to_string(), "the frame is not valid COBS");
}

#[test]
fn each_flipped_bit_is_found() {
    let message: Vec<u8> = (0..600u32).map(|i| (i * i % 7 * i % 251) as u8).collect();
    let good = frame(&message);
    let mut link = TestReceiver::new();
    for bit in 0..8 * good.len() {
        let mut bytes = good.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        // The next frame is lost only where the 0x00 before it is.
        bytes.extend([0]);
        bytes.extend(&good);
        let (messages, errors) = receive(&mut link, &bytes);
        assert!(errors > 0, "bit {bit}");
        assert_eq!(messages, [&message[..]], "bit {bit}");
    }
}

proptest! {
    #[test]
    fn any_message_arrives(message in vec(prop_oneof![Just(0), any::<u8>(), 1u8..], 0..600)) {
        let bytes = frame(&message);
        prop_assert_eq!(bytes.iter().position(|byte| *byte == 0), Some(bytes.len() - 1));
        let prefix = if message.len() < 128 { 1 } else { 2 };
        prop_assert!(bytes.len() <= frame_bound(prefix + message.len()));
        prop_assert_eq!(receive(&mut TestReceiver::new(), &bytes), (vec![message], 0));
    }

    #[test]
    fn any_bytes_are_survived(garbage in vec(prop_oneof![Just(0), Just(1), any::<u8>()], 0..2000)) {
        let mut link = TestReceiver::new();
        let _ = receive(&mut link, &garbage);
        let _ = receive(&mut link, &[0]);
        prop_assert_eq!(receive(&mut link, &frame(b"good")), (vec![b"good".to_vec()], 0));
        let _ = open(&mut garbage.clone());
        let _ = decode::<(u32, &str, Option<i16>)>(&garbage);
        let _ = decode_image(&garbage, None, &mut [0; 300]);
        let _ = decode_image(&garbage, Some(&[9; 300]), &mut [0; 300]);
    }

    #[test]
    fn garbage_between_frames_loses_no_frame(
        garbage in vec(vec(any::<u8>(), 0..900), 4),
        message in vec(any::<u8>(), 0..300),
    ) {
        let mut bytes = Vec::new();
        for piece in &garbage {
            bytes.extend(piece);
            bytes.extend([0]);
            bytes.extend(frame(&message));
        }
        prop_assert_eq!(receive(&mut TestReceiver::new(), &bytes).0, vec![message; 4]);
    }

    #[test]
    fn flipped_bits_are_found(message in vec(any::<u8>(), 1..300), bits in vec(any::<u16>(), 1..8)) {
        let good = frame(&message);
        let mut bytes = good.clone();
        for bit in bits {
            let bit = usize::from(bit) % (8 * bytes.len());
            bytes[bit / 8] ^= 1 << (bit % 8);
        }
        bytes.extend([0]);
        let (messages, errors) = receive(&mut TestReceiver::new(), &bytes);
        let same = bytes[..good.len()] == good;
        prop_assert_eq!((messages.is_empty(), errors == 0), (!same, same));
    }

    #[test]
    fn any_image_comes_back(pairs in vec((0u16..4096, 0u16..4096, 0u8..8), 0..600), wide: bool) {
        let scale = if wide { 16 } else { 1 };
        let quiet = |kind: u8, of: u8| kind & of != 0;
        let base: Vec<u16> = pairs.iter().map(|(_, v, k)| if quiet(*k, 1) { 0 } else { v * scale }).collect();
        let now = pairs.iter().zip(&base).map(|((v, _, kind), base)| match kind {
            2 | 3 => *base,
            4 | 5 => 0,
            6 | 7 => base.wrapping_add(v % 7),
            _ => v * scale,
        });
        let now: Vec<u16> = now.collect();
        for base in [None, Some(&base[..])] {
            let code = coded(&now, base);
            if !wide && now.iter().all(|value| *value < 4096) {
                prop_assert!(code.len() <= image_bound(now.len(), 12));
            }
            prop_assert_eq!(decoded(&code, base, now.len()), Ok(now.clone()));
            if let Some(base) = base {
                prop_assert_eq!(&code, &described(&now, base));
            }
            for room in 0..code.len() {
                prop_assert_eq!(encode_image(&now, base, &mut vec![0; room]), None);
            }
        }
    }
}

#[test]
fn an_image_is_coded_alike_wherever_it_stands() {
    let now: Vec<u16> = (0..200u16).map(|i| i % 5 + u16::from(i % 90 > 60 && i % 7 != 3)).collect();
    let base: Vec<u16> = (0..200).map(|i| i % 5).collect();
    let code = coded(&now, Some(&base));
    let moved = |values: &[u16], by: usize| [vec![9; by], values.to_vec()].concat();
    for (a, b) in [(0, 1), (1, 0), (1, 1)] {
        let (now, base) = (moved(&now, a), moved(&base, b));
        assert_eq!(coded(&now[a..], Some(&base[b..])), code, "{a} {b}");
    }
    assert_eq!(decoded(&code, Some(&base), 200), Ok(now));
}

#[test]
fn golden_images() {
    let golden = |values: &[u16], base: Option<&[u16]>, code: &[u8]| {
        assert_eq!(coded(values, base), code);
        assert_eq!(decoded(code, base, values.len()).as_deref(), Ok(values));
    };
    golden(&[], None, &[]);
    golden(&[0; 2048], None, &[]);
    golden(&[5; 2048], Some(&[5; 2048]), &[]);
    // skip 2, 3 taxels: +1, +1, -2 (zigzag 2, 2, 3)
    golden(&[0, 0, 1, 2, 0, 0], None, &[2, 2, 2, 2]);
    golden(&[0, 0, 1, 2, 0, 3], None, &[2, 4, 2, 2, 3, 6]);
    golden(&[0, 0, 1, 2, 0, 0, 3], None, &[2, 2, 2, 2, 2, 1, 6]);
    // +64 is the first that needs two bytes; 4095 and 65535
    golden(&[63, 127, 63], None, &[0, 3, 126, 0x80, 1, 127]);
    golden(&[4095, 65535], None, &[0, 2, 0xfe, 0x3f, 0x80, 0xc0, 7]);
    // 9 - 10, 10 - 10, 11 - 10
    golden(&[10, 9, 10, 11, 10], Some(&[10; 5]), &[1, 3, 1, 0, 2]);
    let mut far = [0; 300];
    far[299] = 1;
    golden(&far, None, &[0xab, 2, 1, 2]);
    assert_eq!(image_sum(&[3, 0, 5]), 3 + 15);
    assert_eq!(image_sum(&[65535; 65536]), (65535u64 * 65536 * 65537 / 2) as u32);
}

#[test]
fn a_wrong_image_is_refused_with_its_byte() {
    let fault = |data: &[u8], error: &str| assert_eq!(decoded(data, None, 4), Err(error.into()));
    fault(&[1], "byte 1: the image ends within a run");
    fault(&[1, 0x80], "byte 2: the image ends within a run");
    fault(&[1, 2, 8], "byte 3: the image ends within a run");
    fault(&[0, 0], "byte 2: a run has no taxels");
    fault(&[5, 1, 2], "byte 2: a run ends after the last taxel");
    fault(&[2, 3, 2, 2, 2], "byte 2: a run ends after the last taxel");
    fault(&[0, 4, 2, 2, 2, 2, 0, 1, 2], "byte 8: a run ends after the last taxel");
    fault(&[0, 0xff, 0xff, 0x7f], "byte 4: a run ends after the last taxel");
    fault(&[0x80, 0x80, 0x80, 1], "byte 3: a varint is too long");
    fault(&[0x81, 0], "byte 2: a varint is too long");
    fault(&[0, 1, 1], "byte 3: a value is outside 0 ..= 65535");
    fault(&[0, 1, 0x80, 0x80, 8], "byte 5: a value is outside 0 ..= 65535");
    let base = "byte 0: the base image has another number of taxels";
    assert_eq!(decoded(&[], Some(&[0; 3]), 4), Err(base.into()));
    for base in [3, 5] {
        assert_eq!(encode_image(&[0; 4], Some(&vec![0; base]), &mut [0; 9]), None);
    }
}

/// Quiet taxels are looked at in blocks, in which two values must not cancel each other.
#[test]
fn two_taxels_that_are_alike_are_reported_wherever_they_lie() {
    for (first, second) in (0..24).flat_map(|first| (first + 1..24).map(move |second| (first, second))) {
        let mut values = [0u16; 24];
        (values[first], values[second]) = (0x0a5f, 0x0a5f);
        assert_eq!(decoded(&coded(&values, None), None, 24).unwrap(), values);
        for base in [[0; 24], [0x0a5f; 24]] {
            assert_eq!(decoded(&coded(&values, Some(&base)), Some(&base), 24).unwrap(), values);
        }
    }
}

/// Five contacts of 30 to 50 taxels on four panels of 32 x 16, with noise of 3 counts; they move `speed`
/// taxels a frame.
fn scene(frame: u32, speed: f64) -> Vec<u16> {
    let blobs = [
        (0, 8.0, 7.0, 4.4),
        (0, 24.0, 8.0, 3.8),
        (1, 15.5, 8.0, 4.0),
        (2, 10.0, 6.5, 3.6),
        (3, 20.0, 9.0, 3.4),
    ];
    let mut state = frame.wrapping_mul(2_654_435_769) | 1;
    let mut noise = || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        f64::from(state % 7) - 3.0
    };
    let mut image = vec![0; 2048];
    for (i, value) in image.iter_mut().enumerate() {
        let (panel, x, y) = (i / 512, (i % 32) as f64 - f64::from(frame) * speed, (i % 512 / 32) as f64);
        for (on, cx, cy, r) in blobs {
            let far = ((x - cx).powi(2) + (y - cy).powi(2)) / (r * r);
            if on == panel && far < 1.0 {
                *value = (40.0 + 2200.0 * (1.0 - far) + noise()) as u16;
            }
        }
    }
    image
}

/// Bytes of the scene alone, and of its differences (mean of 8 frames): the table of the wire's cost. Raw:
/// 4096.
#[test]
fn sizes() {
    let mut table = Vec::new();
    for speed in [0.0, 0.03, 0.3] {
        let images: Vec<_> = (0..9).map(|frame| scene(frame, speed)).collect();
        let touched = images[0].iter().filter(|value| **value > 0).count();
        let pairs = images.windows(2);
        let bytes: usize = pairs.map(|pair| coded(&pair[1], Some(&pair[0])).len()).sum();
        table.push((speed, touched, coded(&images[0], None).len(), bytes / 8));
    }
    let worst: Vec<u16> = (0..2048).map(|i| if i % 2 == 0 { 4095 } else { 1 }).collect();
    assert_eq!(coded(&worst, None).len(), 4122);
    assert_eq!(image_bound(2048, 12), 4132);
    let want = [(0.0, 231, 534, 297), (0.03, 231, 534, 313), (0.3, 231, 534, 510)];
    assert_eq!(table, want, "taxels a frame, touched taxels, bytes alone, bytes of the difference");
}
