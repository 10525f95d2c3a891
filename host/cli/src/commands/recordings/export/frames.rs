//! Images of a recording, with the data that belongs to each.

use super::units::Units;
use anyhow::{Context, Result, bail};
use std::cell::Cell;
use std::num::NonZeroU64;
use std::rc::Rc;
use taxel::client::{Client, Event, ImageNews};
use taxel::record::Play;
use taxel::recording::{BoardRecording, Skipped};
use taxel::text::progress::{Progress, Unit};
use taxel_core::body::Placed;
use taxel_core::format::{Name, Q15};
use taxel_core::garment::{Area, Layout};

/// Selected images of a recording.
#[derive(Debug)]
pub struct Frames<'a> {
    recording: &'a BoardRecording,
    every: NonZeroU64,
    /// True for counts even if newtons are known.
    counts: bool,
    /// Damage found in the last pass.
    skipped: Cell<Skipped>,
}

/// Properties that hold for all images.
#[derive(Debug)]
pub struct RecordedGarment {
    /// Geometry of the garment.
    pub layout: Layout,
    /// Units of its panels.
    pub units: Units,
    /// Concepts of the scene's map.
    pub concepts: Vec<Name>,
    /// Calibration, as described by the board.
    calibration: String,
}

/// One image.
#[derive(Debug)]
pub struct Frame {
    /// Number of the scan.
    pub number: u32,
    /// Start of the scan in board time, us.
    pub board_us: u64,
    /// Host time of the start, us since 1970.
    pub host_us: u64,
    /// Properties of the board.
    pub recorded: Rc<RecordedGarment>,
    /// Pressure by taxel number, counts.
    pub values: Vec<u16>,
    /// Raw code by taxel number; empty if none were recorded for this scan.
    pub codes: Vec<u16>,
    /// Present contacts.
    pub contacts: Vec<Placed>,
    /// Activation of each concept.
    pub activations: Vec<Q15>,
}

impl<'a> Frames<'a> {
    /// Every N-th image of a recording, in counts or in the unit that the file knows.
    pub fn new(recording: &'a BoardRecording, every: NonZeroU64, counts: bool) -> Result<Frames<'a>> {
        Ok(Frames { recording, every, counts, skipped: Cell::default() })
    }

    /// The recording.
    pub fn recording(&self) -> &BoardRecording {
        self.recording
    }

    /// Damage found in the last pass.
    pub fn skipped(&self) -> Skipped {
        self.skipped.get()
    }

    /// Iterates over the images, with progress shown as `what`. Returns their number. Changes of garment, map
    /// or unit are refused, because the formats have one of each. Memory is that of one image, whatever the
    /// recording's length.
    pub fn each(&self, what: &str, mut take: impl FnMut(&Frame) -> Result<()>) -> Result<u64> {
        let mut play = Play::open(self.recording)?;
        let total = play.passed()[1];
        let mut progress = Progress::of(format!("{what} {}", self.recording), Unit::Bytes, Some(total));
        let (mut seen, mut count) = (0u64, 0);
        let mut current = Current::default();
        let place = || self.recording.to_string();
        while let Some((header, event)) = play.next_event()? {
            let client = play.client();
            match event {
                Event::Raw { frame, whole: true, .. } => {
                    if let Some(image) = current.waiting().filter(|image| image.number == frame) {
                        image.codes.extend_from_slice(client.raw());
                        current.give(&mut take)?;
                    }
                }
                Event::Frame { frame, time, image: ImageNews::Whole, .. } => {
                    current.give(&mut take)?;
                    let Some(recorded) =
                        self.recorded(client, current.recorded(), frame).with_context(place)?
                    else {
                        continue;
                    };
                    seen += 1;
                    if (seen - 1) % self.every == 0 {
                        count += 1;
                        current.put(client, recorded, frame, [time.0, header.log_time / 1000]);
                        progress.at(play.passed()[0]);
                    }
                }
                _ => {}
            }
        }
        current.give(&mut take)?;
        self.skipped.set(play.skipped());
        if count == 0 {
            bail!("{} holds no image", self.recording);
        }
        Ok(count)
    }

    fn recorded(
        &self,
        client: &Client,
        known: Option<&Rc<RecordedGarment>>,
        frame: u32,
    ) -> Result<Option<Rc<RecordedGarment>>> {
        let Some(now) = client.description() else { return Ok(None) };
        match known {
            Some(known) if known.layout != now.layout => bail!("the garment changes at frame {frame}"),
            Some(known) if known.concepts != client.concepts() => bail!("the map changes at frame {frame}"),
            Some(known) if !self.counts && known.calibration != now.calibration => {
                bail!("the calibration changes at frame {frame}: --counts exports counts")
            }
            Some(known) => Ok(Some(known.clone())),
            None => {
                let low = now.scene.contact.low;
                let units = Units::new(&now.layout, low, client.newtons().filter(|_| !self.counts).cloned());
                let concepts = client.concepts().to_vec();
                let (layout, calibration) = (now.layout.clone(), now.calibration.clone());
                Ok(Some(Rc::new(RecordedGarment { layout, units, concepts, calibration })))
            }
        }
    }
}

/// The image being assembled, in reused memory. Raw codes, if any, follow their image.
/// come.
#[derive(Default)]
struct Current {
    image: Option<Frame>,
    waits: bool,
}

impl Current {
    fn recorded(&self) -> Option<&Rc<RecordedGarment>> {
        self.image.as_ref().map(|image| &image.recorded)
    }

    /// The image whose raw codes may follow.
    fn waiting(&mut self) -> Option<&mut Frame> {
        self.image.as_mut().filter(|_| self.waits)
    }

    fn give(&mut self, take: &mut impl FnMut(&Frame) -> Result<()>) -> Result<()> {
        let waits = std::mem::take(&mut self.waits);
        self.image.as_ref().filter(|_| waits).map_or(Ok(()), take)
    }

    fn put(
        &mut self,
        client: &Client,
        recorded: Rc<RecordedGarment>,
        number: u32,
        [board_us, host_us]: [u64; 2],
    ) {
        let image = self.image.get_or_insert_with(|| Frame {
            number,
            board_us,
            host_us,
            recorded,
            values: Vec::new(),
            codes: Vec::new(),
            contacts: Vec::new(),
            activations: Vec::new(),
        });
        (image.number, image.board_us, image.host_us) = (number, board_us, host_us);
        image.values.clear();
        image.values.extend_from_slice(client.image().map_or(&[], |(_, values)| values));
        image.codes.clear();
        image.contacts.clear();
        image.contacts.extend_from_slice(client.contacts());
        image.activations = client.activations();
        self.waits = true;
    }
}

/// Values of a panel, row by row.
pub fn panel<'v>(area: &Area, values: &'v [u16]) -> &'v [u16] {
    let start = usize::from(area.base);
    values.get(start..start + usize::from(area.rows) * usize::from(area.columns)).unwrap_or(&[])
}
