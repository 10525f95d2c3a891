//! Which board is which.

use super::{BoardDescription, cleaned};
use taxel_core::garment::Garment;

/// Most garments that are remembered of a board.
const GARMENTS: usize = 32;

/// Marks by which a board is recognised when it answers again: after its link was open anew, and after it has
/// restarted.
///
/// - What is stated, a serial number on USB or a garment, must agree.
/// - The id of its chip, which it says on every link, or else the serial number of its link on USB decides alone, where
///   it had one before and has one now: the board may have been dressed otherwise meanwhile.
/// - Else the name of its firmware must be the same, without its version, and its garment one that it has had since it
///   was met, or was sent: the one that it had first, to which it returns if it restarts; that of `--garment`; any that
///   another program has dressed it with under our eyes. A garment that nobody has seen on it is another board's.
///
/// Nothing else is compared: scene, calibration and gains are settings, and boards on one supply have one uptime.
#[derive(Debug, Default, Clone)]
pub struct Identity {
    usb_serial: Option<String>,
    /// Id of the chip; none before the board was met, or if it has none.
    chip: Option<String>,
    /// The stated garment.
    garment: Option<Garment>,
    /// Name of the firmware; none before the board was met.
    firmware: Option<String>,
    /// Garments that it has had, or was sent.
    garments: Vec<Garment>,
}

impl Identity {
    /// A board with this serial number on USB and this garment; none: any, and learned from the board that is met
    /// first.
    pub fn new(usb_serial: Option<String>, garment: Option<Garment>) -> Identity {
        // The garment of a `Hello` is cleaned, too.
        let garment = garment.map(|mut garment| {
            cleaned::garment(&mut garment);
            garment
        });
        Identity { usb_serial, garment, ..Identity::default() }
    }

    /// True if a garment is stated, in which the board must always be.
    pub(super) fn states_garment(&self) -> bool {
        self.garment.is_some()
    }

    /// Returns how a board differs, on a link with this serial number on USB; none if it is the one.
    pub fn differs(&self, usb_serial: Option<&str>, description: &BoardDescription) -> Option<String> {
        let chips = self.chip.as_deref().zip(chip(description));
        let serials = chips.or(self.usb_serial.as_deref().zip(usb_serial));
        if let Some((known, found)) = serials.filter(|(known, found)| known != found) {
            return Some(format!("its serial number is {found}, not {known}"));
        }
        if let Some(stated) = &self.garment {
            return (*stated != description.garment).then(|| other_garment(stated, &description.garment));
        }
        let known = self.firmware.as_deref().filter(|_| serials.is_none())?;
        let found = firmware(description);
        if known != found {
            return Some(format!("its firmware is {found}, not {known}"));
        }
        let last = self.garments.last().filter(|_| !self.garments.contains(&description.garment))?;
        Some(other_garment(last, &description.garment))
    }

    /// Learns from a `Hello` of the board.
    pub(super) fn learn(&mut self, usb_serial: Option<&str>, description: &BoardDescription) {
        self.usb_serial = self.usb_serial.take().or_else(|| usb_serial.map(String::from));
        self.chip = self.chip.take().or_else(|| chip(description).map(String::from));
        self.firmware.get_or_insert_with(|| firmware(description).into());
        self.learn_garment(&description.garment);
    }

    /// Learns that the board is sent this garment.
    pub(super) fn learn_garment(&mut self, garment: &Garment) {
        if let Some(at) = self.garments.iter().position(|known| known == garment) {
            // The last one is the one that is named.
            return self.garments[at..].rotate_left(1);
        }
        if self.garments.len() >= GARMENTS {
            // The first one is what the board returns to.
            self.garments.remove(1);
        }
        self.garments.push(garment.clone());
    }
}

fn chip(description: &BoardDescription) -> Option<&str> {
    Some(description.chip.as_str()).filter(|chip| !chip.is_empty())
}

fn firmware(description: &BoardDescription) -> &str {
    description.firmware.split(' ').next().unwrap_or_default()
}

fn other_garment(known: &Garment, found: &Garment) -> String {
    match known.name == found.name {
        true => format!("its garment {} differs from the one known by this name", found.name),
        false => format!("it has the garment {}, not {}", found.name, known.name),
    }
}
