//! A `Hello` with an impossible garment or scene.

use super::stage::{events, hello, hello_of};
use crate::sink::Sink;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use std::sync::Arc;
use taxel::client::{Client, Event, Stamp};
use taxel::json::MessagePrinter;
use taxel::session::Observer;
use taxel::source::{self, Source, SourceOptions};
use taxel_cli::terminal::{Lines, View};
use taxel_cli::view::{PageHub, Viewer};
use taxel_core::format::Micros;
use taxel_core::garment::Garment;
use taxel_core::scene::Scene;

/// Some time.
const STAMP: Stamp = Stamp { board_us: 5, host_us: 7, uncertainty_us: None };

fn idle() -> Source {
    source::open(&"sim:idle".parse().unwrap(), &SourceOptions::default()).unwrap()
}

#[test]
fn a_map_with_an_edge_to_a_concept_that_is_not_there_is_refused() {
    let mut scene = Scene::shipped();
    scene.intent.as_mut().unwrap().map.edges[0].to = 200;
    let mut client = Client::new();
    let heard = events(&mut client, &hello(0, &Garment::reference(), &scene, "taxel"));
    let [Event::Unusable(why)] = heard.as_slice() else { panic!("{heard:?}") };
    assert!(why.starts_with("scene in Hello: "), "{why}");
    assert!(client.description().is_none());
    Viewer::new(Arc::new(PageHub::default()), None).event(&client, &heard[0], STAMP).unwrap();
}

/// All ways to show a board.
struct Shows {
    page: Viewer,
    lines: Lines<Sink>,
    json: MessagePrinter<Sink>,
    picture: View,
}

#[test]
fn whatever_a_hello_says_the_page_and_the_terminal_stand_it() {
    let source = idle();
    let mut shows = Shows {
        page: Viewer::new(Arc::new(PageHub::default()), None),
        lines: Lines::new(Sink::default()),
        json: MessagePrinter::new(true, Sink::default()),
        picture: View::new(&source),
    };
    shows.page.opened(&source).unwrap();
    shows.lines.opened(&source).unwrap();
    let good = [
        postcard::to_allocvec(&Garment::reference()).unwrap(),
        postcard::to_allocvec(&Scene::shipped()).unwrap(),
    ];
    let mut noise = fastrand::Rng::with_seed(19);
    let (mut client, mut known, mut refused) = (Client::new(), 0, 0);
    for seq in 0..4000 {
        let mut bytes = good.clone();
        let which = &mut bytes[noise.usize(..2)];
        for _ in 0..noise.usize(1..4) {
            let at = noise.usize(..which.len());
            which[at] = if noise.bool() { noise.u8(..) } else { which[at].wrapping_add(1) };
        }
        let frame = hello_of(seq, &bytes[0], &bytes[1], "taxel", Micros(noise.u64(..)));
        for event in events(&mut client, &frame) {
            *(if event == Event::Hello { &mut known } else { &mut refused }) += 1;
            shows.page.event(&client, &event, STAMP).unwrap();
            shows.lines.event(&client, &event, STAMP).unwrap();
            shows.json.event(&client, &event, STAMP).unwrap();
            shows.picture.event(&client, &event);
        }
        let mut buffer = Buffer::empty(Rect::new(0, 0, 100, 30));
        shows.picture.draw(&client, &mut buffer);
    }
    assert!(known > 100 && refused > 1000, "{known} known, {refused} refused");
}
