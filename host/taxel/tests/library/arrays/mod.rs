//! Arrays of others: their frames, however the stream is cut or damaged.

mod damage;
mod descriptions;
mod forms;
mod limits;
mod sources;

use taxel::source::array::{ArrayDecoder, ArrayDescription, ArrayFrame, ArrayLoss};

/// A description of two rows and three columns, with this form of frames.
fn described(form: &str) -> ArrayDescription {
    let text = format!("rows = 2\ncolumns = 3\nrange = [0, 255]\n[frame]\n{form}\n");
    ArrayDescription::parse(&text, "mat.toml").unwrap()
}

/// The frames of a stream that comes in these pieces, one a millisecond, and what was lost.
fn decoded<'a>(
    description: &ArrayDescription,
    pieces: impl IntoIterator<Item = &'a [u8]>,
) -> (Vec<ArrayFrame>, ArrayLoss) {
    let (mut decoder, mut frames) = (ArrayDecoder::new(description), Vec::new());
    for (at, piece) in pieces.into_iter().enumerate() {
        decoder.push(piece, at as u64 * 1000, &mut |frame| frames.push(frame));
    }
    decoder.quiet(&mut |frame| frames.push(frame));
    (frames, decoder.loss())
}

/// The values of the frames of a stream in one piece.
fn values(description: &ArrayDescription, stream: &[u8]) -> Vec<Vec<f64>> {
    decoded(description, [stream]).0.into_iter().map(|frame| frame.values).collect()
}
