//! Streams of arrays of others: any description, any bytes, any cuts.

use crate::bytes::Bytes;
use taxel::source::array::{
    ArrayDecoder, ArrayDescription, ArrayFrame, ArrayLoss, ArraySpec, CodeMap, described,
};

/// Forms of frames besides those of the formats with a name.
const FORMS: [&str; 5] = [
    "kind = \"bytes\"\nhead = \"AA\"\ntail = \"55\"\nvalue = \"u12be\"",
    "kind = \"bytes\"\nhead = \"A5 5A\"\nbefore = 6\nvalue = \"i16le\"\ncheck = \"crc16-modbus\"\nover = \"before..after\"\n\
     sequence = { at = 2, type = \"u16be\" }\ntime = { at = 4, type = \"u32be\", unit = \"s\" }",
    "kind = \"bytes\"\ntail = \"00 00 80 7F\"\nvalue = \"f32be\"\ncheck = \"lrc8\"",
    "kind = \"lines\"\nprefix = \"F\"\ntime = { field = 0, unit = \"s\" }\nskip = 1",
    "kind = \"zeros\"",
];

/// Sources of the formats with a name.
const SOURCES: [&str; 8] = [
    "numbers:-,rows=2,columns=3",
    "flexitac:-,rows=2,columns=2",
    "vitac:-",
    "wiresens:-,rows=2,columns=3,nodes=4",
    "wiresens:tcp:a:1,rows=2,columns=3,nodes=4",
    "anyskin:-,chips=1,range=0..100",
    "m0404s:-,range=0..100",
    "m1616:-",
];

/// Reads a name and a description of any bytes, or a stream of any bytes.
pub fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let at = usize::from(bytes.byte()) % (SOURCES.len() + FORMS.len() + 2);
    let text = |form: &str| format!("rows = 2\ncolumns = 4\nsnake = true\n[frame]\n{form}\n");
    if let Some(source) = SOURCES.get(at) {
        let spec = ArraySpec::read(source).expect("it has a format").expect("a link");
        stream(&described(&spec).expect("it is right"), &mut bytes);
    } else if let Some(form) = FORMS.get(at - SOURCES.len()) {
        stream(&ArrayDescription::parse(&text(form), "").expect("it is right"), &mut bytes);
    } else if at.is_multiple_of(2) {
        let name = String::from_utf8_lossy(bytes.rest()).into_owned();
        if let Some(Ok(spec)) = ArraySpec::read(&name) {
            assert_eq!(ArraySpec::read(&spec.to_string()), Some(Ok(spec)));
        }
    } else {
        let text = String::from_utf8_lossy(bytes.piece()).into_owned();
        if let Ok(description) = ArrayDescription::parse(&text, "") {
            stream(&description, &mut bytes);
        }
    }
}

/// Decodes the rest of the bytes in pieces as they say, and byte by byte.
fn stream(description: &ArrayDescription, bytes: &mut Bytes<'_>) {
    let mut pieces = Vec::new();
    while !bytes.is_empty() {
        pieces.push(bytes.piece());
    }
    let whole = pieces.concat();
    let (frames, loss) = decoded(description, pieces.into_iter());
    let (again, same) = decoded(description, whole.chunks(1));
    assert_eq!((frames.len(), loss), (again.len(), same));
    let (mut map, mut codes) = (CodeMap::new(description), Vec::new());
    for (frame, again) in frames.iter().zip(again) {
        assert_eq!(
            (&frame.values, frame.sequence, frame.time_us),
            (&again.values, again.sequence, again.time_us)
        );
        assert_eq!(frame.values.len(), description.values());
        if map.codes(frame, &mut codes) {
            let [rows, columns] = description.shape();
            assert_eq!(codes.len(), usize::from(rows) * usize::from(columns));
            assert!(codes.iter().all(|code| *code <= 4095));
        }
    }
}

fn decoded<'a>(
    description: &ArrayDescription,
    pieces: impl Iterator<Item = &'a [u8]>,
) -> (Vec<ArrayFrame>, ArrayLoss) {
    let (mut decoder, mut frames) = (ArrayDecoder::new(description), Vec::new());
    for piece in pieces {
        decoder.push(piece, 0, &mut |frame| frames.push(frame));
    }
    decoder.quiet(&mut |frame| frames.push(frame));
    (frames, decoder.loss())
}
