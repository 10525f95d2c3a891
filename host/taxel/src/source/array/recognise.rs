//! Recognises an array by its bytes.

use super::decoder::ArrayDecoder;
use super::sensor::described;
use super::spec::ArraySpec;

/// Formats that are tried, with the keys of their usual sizes.
const TRIED: [&str; 8] = [
    "flexitac:-,rows=16,columns=32",
    "flexitac:-,rows=12,columns=32",
    "vitac:-",
    "wiresens:-",
    "m1616:-",
    "anyskin:-,chips=5,range=0..1000",
    "anyskin:-,chips=10,range=0..1000",
    "m0404s:-,range=0..4095",
];
/// Fewest numbers of a line that may be an array's.
const NUMBERS: usize = 4;
/// Fewest frames, and the share of the bytes that they must take.
const FRAMES: usize = 3;
const SHARE: f64 = 0.7;

/// An array that a stream is likely to come from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KnownArray {
    source: ArraySpec,
    /// Words on how sure that is.
    sure: String,
}

impl KnownArray {
    /// Recognises a sample of a stream.
    pub fn of(sample: &[u8]) -> Option<KnownArray> {
        numbers(sample).and_then(lines_of).or_else(|| TRIED.iter().find_map(|source| tried(source, sample)))
    }

    /// Sentence on the command that reads it from a link, and on how sure that is.
    pub fn advice(&self, link: &str) -> String {
        let source = self.source.to_string().replacen(":-", &format!(":{link}"), 1);
        format!("`taxel live {source}` reads it as {}: {}", self.source.format, self.sure)
    }
}

/// Numbers in each line of a text; none if lines hold something else, or not equally many.
pub fn numbers(sample: &[u8]) -> Option<usize> {
    let text = String::from_utf8_lossy(sample);
    // The first line may have begun before, and the last has not ended.
    let mut whole = text.lines();
    whole.next();
    whole.next_back();
    let count = |line: &str| {
        let words = line.split(|c: char| c.is_whitespace() || matches!(c, ',' | ';'));
        let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
        words.iter().all(|word| word.parse::<f64>().is_ok()).then_some(words.len())
    };
    let first = count(whole.next()?)?;
    whole.all(|line| count(line) == Some(first)).then_some(first).filter(|count| *count > 0)
}

/// The source of lines of this many numbers.
fn lines_of(count: usize) -> Option<KnownArray> {
    if count < NUMBERS {
        return None;
    }
    let mut shapes: Vec<[usize; 2]> = (1..=count)
        .take_while(|rows| rows * rows <= count)
        .filter(|rows| count.is_multiple_of(*rows))
        .map(|rows| [rows, count / rows])
        .collect();
    let [rows, columns] = shapes.pop()?;
    let others: Vec<String> =
        shapes.iter().rev().take(3).map(|[rows, columns]| format!("{rows} x {columns}")).collect();
    let source = format!("numbers:-,rows={rows},columns={columns}");
    let sure = match others.as_slice() {
        [] => "the shape is a guess".into(),
        others => format!("the shape is a guess, {} are as many", others.join(", ")),
    };
    Some(KnownArray { source: ArraySpec::read(&source)?.ok()?, sure })
}

/// The source, if its format takes most of the bytes.
fn tried(source: &str, sample: &[u8]) -> Option<KnownArray> {
    let source = ArraySpec::read(source)?.ok()?;
    let mut decoder = ArrayDecoder::new(&described(&source).ok()?);
    let mut ends = Vec::new();
    for (at, byte) in sample.iter().enumerate() {
        decoder.push(&[*byte], at as u64, &mut |frame| ends.push(frame.arrival_us));
    }
    let (first, last) = (ends.first()?, ends.last()?);
    let frames = ends.len();
    let length = (last - first) as f64 / (frames.max(2) - 1) as f64;
    let share = length * frames as f64 / sample.len() as f64;
    let damaged = decoder.loss().dropped;
    (frames >= FRAMES && share >= SHARE && damaged <= frames as u64 / 4).then(|| {
        let percent = (share * 100.0).min(100.0) as u64;
        let sure = format!("{frames} frames in {percent} % of the bytes, {damaged} damaged");
        KnownArray { source, sure }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn advice(sample: &[u8]) -> Option<String> {
        KnownArray::of(sample).map(|known| known.advice("/dev/ttyACM0"))
    }

    #[test]
    fn formats_are_told_by_their_frames() {
        let noise: Vec<u8> = (0..9000u32).map(|n| (n.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
        assert_eq!(advice(&noise), None);
        let frames = |frame: &dyn Fn(&[u8]) -> Vec<u8>, length| -> Vec<u8> {
            noise.chunks_exact(length).flat_map(frame).skip(99).collect()
        };
        let flexitac = frames(&|values| [&[0xAA, 0x55], values].concat(), 384);
        assert_eq!(
            advice(&flexitac).unwrap(),
            "`taxel live flexitac:/dev/ttyACM0,rows=12,columns=32` reads it as flexitac: 21 frames in 92 % of the bytes, \
             0 damaged"
        );
        let summed = |values: &[u8]| {
            let frame = [&[0xAA], values].concat();
            let sum = frame.iter().fold(0u8, |sum, byte| sum.wrapping_add(*byte));
            [frame, vec![sum]].concat()
        };
        assert!(advice(&frames(&summed, 33)).unwrap().contains("live m0404s:/dev/ttyACM0,range=0..4095`"));
        let skin = |values: &[u8]| {
            let floats = values.iter().flat_map(|value| f32::from(*value).to_le_bytes());
            floats.chain(*b"\r\n").collect()
        };
        assert!(advice(&frames(&skin, 20)).unwrap().contains("live anyskin:/dev/ttyACM0,chips=5,"));
    }

    #[test]
    fn lines_of_numbers_have_a_guessed_shape() {
        let lines = |count: usize| vec!["7"; count].join(",") + "\r\n";
        assert_eq!(
            advice(lines(252).repeat(9).as_bytes()).unwrap(),
            "`taxel live numbers:/dev/ttyACM0,rows=14,columns=18` reads it as numbers: the shape is a guess, 12 x 21, \
             9 x 28, 7 x 36 are as many"
        );
        assert_eq!(advice(lines(3).repeat(9).as_bytes()), None);
        assert_eq!(advice(b"boot ok\n> 1 2\nboot ok\n> 1 2\n"), None);
    }
}
