//! A host that is sent whatever a board could say behind a valid CRC, and every way to show it.

use crate::bytes::Bytes;
use crate::plain::framed;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use std::io;
use std::sync::Arc;
use taxel::client::{Client, Event, Stamps};
use taxel::json::MessagePrinter;
use taxel::session::Observer;
use taxel::source::{Port, Source};
use taxel_cli::terminal::{Lines, View};
use taxel_cli::view::{PageHub, Viewer};
use taxel_core::capacity::TAXELS;
use taxel_core::format::Micros;
use taxel_core::garment::Garment;
use taxel_core::scene::Scene;
use taxel_core::wire::{Frame, Hello, MAGIC, PROTOCOL, Raw, Report, encode_image, image_bound, image_sum};

/// Most values of an image of an input.
const VALUES: usize = TAXELS;

/// Sends a client what the bytes say, and shows what it makes of it.
pub fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let mut shown = Shown::new();
    while !bytes.is_empty() {
        shown.act(&mut bytes);
    }
    let mut buffer = Buffer::empty(Rect::new(0, 0, 100, 30));
    shown.picture.draw(&shown.client, &mut buffer);
    assert!(shown.client.released().len() <= 1024, "what has gone takes bounded memory");
}

/// A link on which nothing comes by itself.
struct Silent;

impl Port for Silent {
    fn read(&mut self, _: &mut [u8]) -> io::Result<Option<usize>> {
        Ok(None)
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        Ok(bytes.len())
    }
}

/// A client, and who looks at it.
struct Shown {
    client: Client,
    observers: Vec<Box<dyn Observer>>,
    stamps: Stamps,
    picture: View,
    seq: u32,
    /// Number and values of the last image.
    image: (u32, Vec<u16>),
    time: u64,
}

impl Shown {
    fn new() -> Shown {
        let source = Source::new("fuzz", Silent);
        let mut client = Client::new();
        // A request of a byte fits.
        let _ = client.start(0);
        let mut observers: Vec<Box<dyn Observer>> = vec![
            Box::new(Viewer::new(Arc::new(PageHub::default()), None)),
            Box::new(Lines::new(io::sink())),
            Box::new(MessagePrinter::new(true, io::sink())),
        ];
        observers.opened(&source).expect("it can be shown");
        Shown {
            client,
            observers,
            stamps: Stamps::start(),
            picture: View::new(&source),
            seq: 0,
            image: (0, Vec::new()),
            time: 0,
        }
    }

    /// One action.
    fn act(&mut self, bytes: &mut Bytes<'_>) {
        match bytes.byte() % 10 {
            0 => self.push(bytes.piece()),
            1 => self.push(&framed(bytes.piece())),
            // A report, as a number of its variant and its fields.
            2 => self.report_of(bytes.piece()),
            3 => self.hello(bytes),
            4 => self.image(bytes, false),
            5 => self.image(bytes, true),
            6 => self.raw(bytes),
            7 => self.seq = self.seq.wrapping_add(bytes.word()),
            8 => self.time = self.time.wrapping_add(1 << (bytes.byte() % 64)),
            _ => _ = self.client.take_requests(),
        }
        self.observers.idle(&mut self.client).expect("it can be shown");
    }

    /// Bytes come.
    fn push(&mut self, said: &[u8]) {
        for byte in said {
            if let Some(event) = self.client.push(*byte) {
                self.show(&event);
            }
        }
    }

    fn show(&mut self, event: &Event) {
        let stamp = self.stamps.of(&self.client, event);
        self.observers.event(&self.client, event, stamp).expect("it can be shown");
        self.picture.event(&self.client, event);
    }

    fn report_of(&mut self, body: &[u8]) {
        let mut message = postcard::to_allocvec(&self.next()).unwrap_or_default();
        message.extend_from_slice(body);
        self.push(&framed(&message));
    }

    fn report(&mut self, report: &Report<'_>) {
        self.report_of(&postcard::to_allocvec(report).unwrap_or_default());
    }

    fn next(&mut self) -> u32 {
        self.seq = self.seq.wrapping_add(1);
        self.seq
    }

    /// A `Hello` whose garment and scene are good but for some bytes.
    fn hello(&mut self, bytes: &mut Bytes<'_>) {
        let garment = match bytes.byte() % 3 {
            0 => Garment::block(),
            1 => Garment::reference(),
            _ => Garment::mat(),
        };
        let garment = bytes.change(postcard::to_allocvec(&garment).unwrap_or_default());
        let scene = bytes.change(postcard::to_allocvec(&Scene::shipped()).unwrap_or_default());
        let clock = postcard::to_allocvec(&Micros(self.time)).unwrap_or_default();
        self.report(&Report::Hello(Hello {
            magic: MAGIC,
            protocol: PROTOCOL,
            garment: &garment,
            firmware: bytes.piece(),
            clock: &clock,
            scene: &scene,
            calibration: b"",
            chip: b"",
            boot: None,
        }));
    }

    /// An image, coded as a board does.
    fn image(&mut self, bytes: &mut Bytes<'_>, alone: bool) {
        let taxels = self.client.layout().map_or(8, |layout| layout.taxels()).min(VALUES);
        let mut values = self.image.1.clone();
        values.resize(taxels, 0);
        for _ in 0..bytes.byte() % 8 {
            let (first, count, value) = (usize::from(bytes.short()), bytes.byte(), bytes.short());
            values.iter_mut().skip(first % taxels.max(1)).take(count.into()).for_each(|to| *to = value);
        }
        let base = (!alone && self.image.1.len() == taxels).then_some(&self.image);
        let mut data = vec![0; image_bound(taxels, u16::BITS)];
        let length = encode_image(&values, base.map(|(_, values)| values.as_slice()), &mut data)
            .expect("an image fits its bound");
        let frame = Frame {
            frame: self.image.0.wrapping_add(1),
            time: Micros(self.time),
            base: base.map(|(number, _)| *number),
            sum: image_sum(&values).wrapping_add((bytes.byte() / 255).into()),
            data: &data[..length],
        };
        self.image = (frame.frame, values);
        self.report(&Report::Frame(frame));
    }

    /// Raw codes, coded however the bytes are.
    fn raw(&mut self, bytes: &mut Bytes<'_>) {
        self.report(&Report::Raw(Raw { frame: self.image.0, time: Micros(self.time), data: bytes.piece() }));
    }
}
