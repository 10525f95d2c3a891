//! A board's own code on codes of one's own, without a clock: `cargo run --example virtual_board`.

use taxel::client::Event;
use taxel::taxel_core::format::Micros;
use taxel::taxel_core::garment::Garment;
use taxel::taxel_core::scene::Scene;
use taxel::taxel_core::wire::Request;
use taxel::virtual_board::VirtualBoard;

fn main() -> taxel::Result<()> {
    let mut board = VirtualBoard::new(Garment::block(), Scene::shipped())?;
    board.client().request(&Request::Tare { frames: 8 })?;
    for scan in 0..60 {
        let mut codes = vec![100; board.taxels()];
        if (20..40).contains(&scan) {
            codes[20..24].fill(900);
        }
        board.step(&codes, Micros(scan * 5_000), &mut |client, event| {
            if let Event::Frame { time, .. } = event {
                println!("{} us: {} contacts", time.0, client.contacts().len());
            }
            Ok(())
        })?;
    }
    Ok(())
}
