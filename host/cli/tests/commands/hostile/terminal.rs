//! Terminals of any size.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use taxel::client::Client;
use taxel::source::{self, SourceOptions};
use taxel_cli::terminal::View;

#[test]
fn a_picture_fits_a_terminal_of_no_rows_and_of_any_others() {
    let mut source = source::open(&"sim:box".parse().unwrap(), &SourceOptions::default()).unwrap();
    let (mut client, mut view) = (Client::new(), View::new(&source));
    let draw = |view: &View, client: &Client| {
        let heights = (0..=30).chain([40, 80]);
        for (height, width) in
            heights.flat_map(|height| (0..=130).step_by(3).map(move |width| (height, width)))
        {
            let mut buffer = Buffer::empty(Rect::new(0, 0, width, height));
            view.draw(client, &mut buffer);
        }
    };
    draw(&view, &client);
    client.start(source.tare).unwrap();
    source.port.write(&client.take_requests()).unwrap();
    let mut buffer = [0; 4096];
    while client.contacts().is_empty() {
        let count = source.port.read(&mut buffer).unwrap().unwrap();
        for byte in &buffer[..count] {
            if let Some(event) = client.push(*byte) {
                view.event(&client, &event);
            }
        }
    }
    draw(&view, &client);
    view.pause(&client);
    draw(&view, &client);
}
