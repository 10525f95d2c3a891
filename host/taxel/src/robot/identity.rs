//! Which board is which: by its serial number on USB, and by its garment.

use crate::client::Worn;
use crate::client::cleaned;
use crate::source::Source;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use taxel_core::garment::Garment;

/// What a board is recognised by. What is not stated is learned from the board that is met first.
#[derive(Debug, Clone, Default)]
pub struct Identity(Arc<Mutex<KnownBoard>>);

#[derive(Debug, Default)]
struct KnownBoard {
    usb_serial: Option<String>,
    garment: Option<Garment>,
    /// Why the board that answered last is another one, unless told already.
    other: Option<String>,
}

impl Identity {
    /// A board with this serial number on USB and this garment; none: any.
    pub fn new(usb_serial: Option<String>, garment: Option<Garment>) -> Identity {
        // The garment of a `Hello` is cleaned, too.
        let garment = garment.map(|mut garment| {
            cleaned::garment(&mut garment);
            garment
        });
        Identity(Arc::new(Mutex::new(KnownBoard { usb_serial, garment, other: None })))
    }

    /// Compares a board with what is known of it. The error says how it differs.
    pub fn check(&self, source: &Source, worn: &Worn) -> Result<(), String> {
        let mut known = self.lock();
        let differs = known.differs(source.usb_serial.as_deref(), &worn.garment);
        match differs {
            Some(how) => {
                let why = format!("{} answers with another board: {how}", source.label);
                known.other = Some(why.clone());
                Err(why)
            }
            None => {
                known.usb_serial = known.usb_serial.take().or_else(|| source.usb_serial.clone());
                known.garment.get_or_insert_with(|| worn.garment.clone());
                Ok(())
            }
        }
    }

    /// Why the board that answered last is another one, once.
    pub(super) fn other(&self) -> Option<String> {
        self.lock().other.take()
    }

    fn lock(&self) -> MutexGuard<'_, KnownBoard> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl KnownBoard {
    fn differs(&self, usb_serial: Option<&str>, garment: &Garment) -> Option<String> {
        if let (Some(known), Some(found)) = (self.usb_serial.as_deref(), usb_serial)
            && known != found
        {
            return Some(format!("its serial number is {found}, not {known}"));
        }
        let known = self.garment.as_ref().filter(|known| *known != garment)?;
        Some(match known.name == garment.name {
            true => format!("its garment {} differs from the one known by this name", garment.name),
            false => format!("it wears the garment {}, not {}", garment.name, known.name),
        })
    }
}
