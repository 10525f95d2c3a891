//! Prints each touch's intention: `cargo run --example intentions -- usb`, or without a board `-- sim:lash`.

use taxel::client::Event;
use taxel::session::Session;
use taxel_core::intent::Leading;

fn main() -> taxel::Result<()> {
    let source = std::env::args().nth(1).unwrap_or("sim:pat".into());
    let mut session = Session::open(&source)?;
    let mut leading = Leading::None;
    while let Some(event) = session.wait()? {
        let Event::Intent(report) = event else { continue };
        if report.leading != leading {
            leading = report.leading;
            println!(
                "{:.3} s: {leading:?} ({} contacts)",
                report.time.0 as f64 / 1e6,
                session.client().contacts().len()
            );
        }
    }
    Ok(())
}
