//! The images of a recording: `cargo run --example recording -- touch.mcap` (`taxel record -o touch.mcap` makes one).

use std::path::PathBuf;
use taxel::client::{Event, ImageNews};
use taxel::record::Play;

fn main() -> taxel::Result<()> {
    let file = PathBuf::from(std::env::args().nth(1).unwrap_or("touch.mcap".into()));
    let mut play = Play::open(&file.into())?;
    while let Some((header, event)) = play.next_event()? {
        let Event::Frame { frame, image: ImageNews::Whole, .. } = event else { continue };
        let peak = play.client().image().and_then(|(_, image)| image.iter().max().copied());
        println!("{} ns: image {frame}, at most {} counts", header.log_time, peak.unwrap_or(0));
    }
    Ok(())
}
