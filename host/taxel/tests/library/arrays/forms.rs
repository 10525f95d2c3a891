//! Forms of frames, each by frames written by hand.

use super::{decoded, described, values};
use taxel::source::array::{ArrayDescription, ArrayLoss};

const MARKED: &str = "kind = \"bytes\"\nhead = \"AA 55\"\nvalue = \"u8\"";

#[test]
fn a_frame_counts_once_the_next_marker_stands_behind_it() {
    let marked = described(MARKED);
    let stream = b"junk\xAA\x55\x01\x02\x03\x04\x05\x06\xAA\x55\x07\x08\x09\x0A\x0B\x0C";
    assert_eq!(values(&marked, stream), [[1., 2., 3., 4., 5., 6.]]);
    let (frames, loss) = decoded(&marked, [&stream[..], b"\xAA", b"\x55"]);
    assert_eq!(frames[1].values, [7., 8., 9., 10., 11., 12.]);
    assert_eq!(frames.iter().map(|frame| frame.arrival_us).collect::<Vec<_>>(), [0, 0], "of its last byte");
    assert_eq!(loss, ArrayLoss::default());
}

#[test]
fn a_marker_within_constant_frames_is_told_apart_once_they_change() {
    let marked = described(MARKED);
    let frame = |last: u8| [0xAA, 0x55, 1, 2, 0xAA, 0x55, 3, last];
    let still = frame(4).repeat(5);
    // Begun within a frame: both places repeat.
    assert_eq!(values(&marked, &still[3..]), Vec::<Vec<f64>>::new());
    let changed = [&still[3..], &[0xAA, 0x55, 1, 2, 9, 9, 3, 4], &frame(4), &frame(5), &frame(6)].concat();
    let seen = values(&marked, &changed);
    assert_eq!(seen.first(), Some(&vec![1., 2., 9., 9., 3., 4.]), "{seen:?}");
    assert_eq!(seen.len(), 3);
}

#[test]
fn a_tail_ends_frames_and_the_start_of_the_stream_counts_as_one() {
    let tailed = described("kind = \"bytes\"\ntail = \"0D 0A\"\nvalue = \"u8\"");
    let whole = b"abcdef\r\nghi\r\nj\r\nklmnop\r\n";
    let seen: Vec<String> = values(&tailed, whole)
        .iter()
        .map(|values| values.iter().map(|value| *value as u8 as char).collect())
        .collect();
    assert_eq!(seen, ["abcdef", "ghi\r\nj", "klmnop"]);
    assert_eq!(values(&tailed, &whole[3..]).len(), 2);
}

#[test]
fn sequence_time_and_sum_are_read() {
    let form = "kind = \"bytes\"\nhead = \"A5\"\nbefore = 3\nvalue = \"u8\"\ncheck = \"sum8\"\n\
                sequence = { at = 1, type = \"u8\" }\ntime = { at = 2, type = \"u16be\", unit = \"ms\" }";
    let frame = |sequence: u8, ms: u16| {
        let [high, low] = ms.to_be_bytes();
        let mut frame = vec![0xA5, sequence, high, low, 1, 2, 3, 4, 5, 6];
        frame.push(frame.iter().fold(0u8, |sum, byte| sum.wrapping_add(*byte)));
        frame
    };
    let mut stream = [frame(254, 65_500), frame(255, 65_520), frame(0, 4), frame(3, 64)].concat();
    let (frames, loss) = decoded(&described(form), [&stream[..]]);
    let times: Vec<_> =
        frames.iter().map(|frame| (frame.sequence.unwrap(), frame.time_us.unwrap())).collect();
    assert_eq!(times, [(254, 65_500_000), (255, 65_520_000), (0, 65_540_000), (3, 65_600_000)]);
    assert_eq!(loss, ArrayLoss { dropped: 0, missed: 2 });
    // A damaged one is dropped, and not missing as well.
    stream[15] ^= 1;
    let (frames, loss) = decoded(&described(form), [&stream[..]]);
    assert_eq!((frames.len(), loss), (3, ArrayLoss { dropped: 1, missed: 2 }));
}

#[test]
fn answers_are_cut_by_quiet_times() {
    let text = "rows = 1\ncolumns = 3\n[link]\npoll = \"A\"\n[frame]\nkind = \"bytes\"\nvalue = \"u16le\"\n";
    let description = ArrayDescription::parse(text, "mat.toml").unwrap();
    let mut decoder = taxel::source::array::ArrayDecoder::new(&description);
    let mut frames = Vec::new();
    for answer in [
        &b"ready"[..],
        b"\x01\x00\x02\x00\x03\x01",
        b"\x01\x00\x02\x00\x03\x01\x00",
        b"\x00\x00\x00\x00\xFF\xFF",
    ] {
        decoder.push(answer, 0, &mut |frame| frames.push(frame.values));
        decoder.quiet(&mut |frame| frames.push(frame.values));
    }
    assert_eq!(frames, [[1., 2., 259.], [0., 0., 65535.]]);
    assert_eq!(decoder.loss(), ArrayLoss { dropped: 2, missed: 0 });
}

#[test]
fn a_line_of_numbers_is_a_frame() {
    let lines = described("kind = \"lines\"");
    let stream = b"4 5 6\n1, 2;3\t4  5 -6.5\r\n\r\nboot ok\n1 2 3 4 5\n1 2 3 4 5 6\n1 2 3 4 nan 6\n7 8";
    let (frames, loss) = decoded(&lines, [&stream[..]]);
    let seen: Vec<_> = frames.into_iter().map(|frame| frame.values).collect();
    assert_eq!(seen, [[1., 2., 3., 4., 5., -6.5], [1., 2., 3., 4., 5., 6.]]);
    assert_eq!(loss, ArrayLoss { dropped: 3, missed: 0 }, "words, a number too few, a value that is none");
    let form =
        "kind = \"lines\"\nseparator = \",\"\nprefix = \"F\"\ntime = { field = 1, unit = \"ms\" }\nskip = 1";
    let (frames, loss) =
        decoded(&described(form), [&b"\nCFG,2,3\nF,9,12,1,2,3,4,5,6\nF,9,13,1,2,,4,5,6\n"[..]]);
    assert_eq!((frames.len(), frames[0].time_us, loss.dropped), (1, Some(12_000), 1));
}

#[test]
fn an_empty_line_ends_rows() {
    let rows = described("kind = \"rows\"");
    let stream = b"3\n4 5 6\n\n1 2 3\r\n4 5 6 \r\n\r\n1 2 3\n\n1 2 3\n4 5 6\n7 8 9\n\n\n7 8 9\n0 1 2\n\n";
    let (frames, loss) = decoded(&rows, [&stream[..]]);
    let seen: Vec<_> = frames.into_iter().map(|frame| frame.values).collect();
    assert_eq!(seen, [[1., 2., 3., 4., 5., 6.], [7., 8., 9., 0., 1., 2.]]);
    assert_eq!(loss.dropped, 2, "a row too few, a row too many");
}

#[test]
fn zeros_are_counted() {
    let zeros = described("kind = \"zeros\"");
    let stream = [9, 9, 255, 1, 0, 4, 2, 255, 0, 6, 255, 0, 7, 255, 1, 2, 0, 255, 1, 2, 3, 4, 5, 254, 255];
    let (frames, loss) = decoded(&zeros, [&stream[..]]);
    let seen: Vec<_> = frames.into_iter().map(|frame| frame.values).collect();
    assert_eq!(seen, [[1., 0., 0., 0., 0., 2.], [0.; 6], [1., 2., 3., 4., 5., 254.]]);
    assert_eq!(loss.dropped, 2);
}

/// A packet of WiReSens of four values.
fn packet(id: u8, number: u32, trailer: &[u8]) -> Vec<u8> {
    let start = (number * 4 % 6) as u16;
    let values = (0..4u16).flat_map(|value| (number as u16 * 4 + value).to_le_bytes());
    [&[id][..], &start.to_le_bytes(), &values.collect::<Vec<_>>(), &number.to_le_bytes(), trailer].concat()
}

#[test]
fn packets_make_images_only_if_they_follow_each_other() {
    let image = |number: u32| (0..6).map(|value| f64::from(number * 6 + value)).collect::<Vec<_>>();
    for (trailer, text) in [(&b"wr"[..], "true"), (b"", "false")] {
        let wiresens = described(&format!("kind = \"wiresens\"\nnodes = 4\ntrailer = {text}"));
        let all: Vec<u8> = (0..9).flat_map(|number| packet(1, number, trailer)).collect();
        assert_eq!(values(&wiresens, &all), (0..6).map(image).collect::<Vec<_>>(), "{trailer:?}");
        // Without packet 3 there is no image 2; packets of another sensor change nothing.
        let kept = (0..9).filter(|number| *number != 3);
        let some: Vec<u8> = kept
            .flat_map(|number| [packet(1, number, trailer), packet(2, number, trailer)].concat())
            .collect();
        let (frames, loss) = decoded(&wiresens, [&some[..]]);
        let seen: Vec<_> = frames.into_iter().map(|frame| frame.values).collect();
        assert_eq!(seen, [0, 1, 3, 4, 5].map(image), "{trailer:?}");
        assert_eq!(loss.missed, 1);
    }
}
