//! Reasons why a map means what it means: `cargo run --example map -- press=0.8 time=-0.9`.

use taxel::fcm::load;
use taxel::fcm::why::{explain, text};

fn main() -> taxel::Result<()> {
    let map = load::map("tactile")?;
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words = if words.is_empty() { vec!["press=0.8".into(), "time=-0.9".into()] } else { words };
    let inputs: Result<Vec<_>, String> = words.iter().map(|word| load::assignment(word)).collect();
    let inputs = inputs.map_err(taxel::Error::other)?;
    print!("{}", text(&map, &explain(&map, &inputs, None)?, None, 5));
    Ok(())
}
