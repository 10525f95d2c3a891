//! A garment, its image and the stage of contacts, frame by frame.

use taxel_core::condition::{Image, Rows};
use taxel_core::contact::{Contact, ContactConfig, ContactState, Contacts, Moments, Quartic, Touches};
use taxel_core::format::{Fixed16, Micros};
use taxel_core::garment::{Garment, Layout, Place};

pub type RigState = ContactState<16, 1024>;

/// A garment, its image and the stage, at 195 frames/s.
pub struct ContactRig {
    pub layout: Layout,
    pub values: Vec<u16>,
    pub stage: Contacts,
    pub state: Box<RigState>,
    pub now: u64,
}

/// What one frame gave.
pub struct MeasuredContacts {
    pub present: Vec<Contact>,
    pub moments: Vec<Moments>,
    /// Whether the form of each is of this frame.
    pub looked: Vec<bool>,
    pub ages: Vec<u8>,
    /// Of those whose form is of this frame.
    pub quartics: Vec<Quartic>,
    pub released: Vec<Contact>,
    pub dropped: u16,
    pub overflow: u16,
}

impl ContactRig {
    pub fn new(garment: &Garment) -> ContactRig {
        let layout = Layout::build(garment, 2048, u16::MAX).unwrap();
        ContactRig {
            values: vec![0; layout.taxels()],
            stage: ContactConfig::default().build().unwrap(),
            state: Box::default(),
            now: 1_000_000,
            layout,
        }
    }

    pub fn mat() -> ContactRig {
        ContactRig::new(&Garment::mat())
    }

    pub fn clear(&mut self) -> &mut ContactRig {
        self.values.fill(0);
        self
    }

    pub fn set(&mut self, panel: u8, row: u16, column: u16, value: u16) -> &mut ContactRig {
        let taxel = self.layout.taxel(Place { panel, row, column }).expect("on the panel");
        self.values[taxel] = value;
        self
    }

    /// Fills a rectangle of panel 0: rows and columns, last included.
    pub fn fill(&mut self, [top, bottom]: [u16; 2], [left, right]: [u16; 2], value: u16) -> &mut ContactRig {
        for (row, column) in (top..=bottom).flat_map(|row| (left..=right).map(move |c| (row, c))) {
            self.set(0, row, column, value);
        }
        self
    }

    /// Fills a piece of a row.
    pub fn bar(&mut self, panel: u8, row: u16, columns: std::ops::Range<u16>, value: u16) {
        for column in columns {
            self.set(panel, row, column, value);
        }
    }

    /// Sets what `inside(x, y)` says on panel 0.
    pub fn draw(&mut self, inside: impl Fn(i32, i32) -> bool, value: u16) -> &mut ContactRig {
        let (rows, columns) = (self.layout.areas()[0].rows, self.layout.areas()[0].columns);
        for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |c| (row, c))) {
            if inside(column.into(), row.into()) {
                self.set(0, row, column, value);
            }
        }
        self
    }

    pub fn frame(&mut self) -> MeasuredContacts {
        self.now += 5128;
        let rows = Rows::of(&self.layout, &self.values);
        let image = Image { values: &self.values, rows: &rows };
        let touches = self.stage.process(&mut self.state, &self.layout, &image, Micros(self.now));
        let moments: Vec<Moments> = touches.moments().copied().collect();
        let Touches { present, ages, quartics, released, dropped, overflow, .. } = touches;
        assert_eq!([moments.len(), ages.len(), quartics.len()], [present.len(); 3]);
        for (contact, moments) in present.iter().zip(&moments) {
            assert_eq!(u64::from(contact.total), moments.m);
        }
        MeasuredContacts {
            present: present.to_vec(),
            moments,
            looked: ages.iter().map(|age| *age == 0).collect(),
            ages: ages.to_vec(),
            quartics: quartics.to_vec(),
            released: released.to_vec(),
            dropped,
            overflow,
        }
    }

    pub fn only(&mut self) -> Contact {
        let frame = self.frame();
        assert_eq!((frame.present.len(), frame.dropped, frame.overflow), (1, 0, 0));
        frame.present[0].clone()
    }
}

pub fn taxels(value: f64) -> Fixed16 {
    Fixed16((value * 65536.0).round() as i32)
}
