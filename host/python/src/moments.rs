//! Recent news of the boards of a robot, by the time that they share.

use crate::array::Panels;
use crate::contact;
use crate::event::Fact;
use pyo3::prelude::*;
use serde_json::{Value, json};
use std::time::Duration;
use taxel::client::Stamp;
use taxel::robot::{BoardContact, BoardMoment, RobotMoments};

/// Images and contacts of all boards, as long as they are kept.
pub struct KeptMoments {
    frames: RobotMoments<Fact>,
    contacts: RobotMoments<Vec<BoardContact>>,
    /// Panels of the garment of each board, and whether its stream has ended.
    boards: Vec<(Panels, bool)>,
}

impl KeptMoments {
    /// Makes room for so many boards, each for so long.
    pub fn new(boards: usize, kept: Duration) -> KeptMoments {
        KeptMoments {
            frames: RobotMoments::new(boards, kept),
            contacts: RobotMoments::new(boards, kept),
            boards: (0..boards).map(|_| (Panels::from([]), false)).collect(),
        }
    }

    /// Takes what a board has said.
    pub fn take(&mut self, board: usize, stamp: Stamp, fact: &Fact, contacts: Option<&[BoardContact]>) {
        if let Some((panels, _)) = self.boards.get_mut(board) {
            *panels = fact.panels.clone();
        }
        if fact.line["type"] == "frame" {
            self.frames.take(board, stamp, fact.clone());
        }
        if let Some(contacts) = contacts {
            self.contacts.take(board, stamp, contacts.to_vec());
        }
    }

    /// A board is lost: what it has said is forgotten.
    pub fn forget(&mut self, board: usize) {
        self.frames.forget(board);
        self.contacts.forget(board);
    }

    /// The stream of a board has ended: the others go on.
    pub fn end(&mut self, board: usize) {
        self.boards.get_mut(board).into_iter().for_each(|(_, is_over)| *is_over = true);
    }

    /// The newest time, us, until which all boards have said `what`; those whose stream has ended do not count
    /// unless all have.
    fn newest<T>(&self, what: &RobotMoments<T>) -> Option<u64> {
        let live = (0..self.boards.len()).filter(|board| !self.boards[*board].1);
        what.reported_by_all(live).or_else(|| what.reported_by_all(0..self.boards.len()))
    }

    /// The newest image of each board until a time of the host, us; without one, until all boards have sent
    /// theirs.
    pub fn frames(&self, host_us: Option<u64>) -> Vec<Option<Fact>> {
        let at_us = host_us.or_else(|| self.newest(&self.frames));
        let latest = |board: usize| Some(self.frames.latest(board, at_us?)?.what.clone());
        (0..self.boards.len()).map(latest).collect()
    }

    /// The contacts of each board at a time of the host, us, interpolated; without one, until all boards have sent
    /// theirs.
    pub fn contacts(&self, host_us: Option<u64>) -> Vec<Option<MomentFact>> {
        let at_us = host_us.or_else(|| self.newest(&self.contacts));
        let found = |board: usize| {
            let BoardMoment { stamp, what } = self.contacts.contacts(board, at_us?)?;
            let panels = &self.boards[board].0;
            Some(MomentFact { stamp, contacts: what.iter().map(|contact| line(contact, panels)).collect() })
        };
        (0..self.boards.len()).map(found).collect()
    }
}

/// Contacts of a board at a time, without Python.
pub struct MomentFact {
    stamp: Stamp,
    contacts: Value,
}

/// A contact as JSON, with the keys of a board's contacts.
fn line(contact: &BoardContact, panels: &Panels) -> Value {
    let [[x, y], [vx, vy]] = [contact.centroid, contact.velocity];
    let bounds = contact.bounds;
    json!({
        "id": contact.id, "panel": contact.panel,
        "panel_name": panels.get(usize::from(contact.panel)).map(|panel| panel.name.as_str()),
        "total": contact.total, "force_n": contact.newtons_per_count.map(|newtons| newtons * f64::from(contact.total)),
        "peak": contact.peak, "area": contact.area, "column": x, "row": y, "columns_per_s": vx, "rows_per_s": vy,
        "top": bounds.top, "bottom": bounds.bottom, "left": bounds.left, "right": bounds.right,
    })
}

/// Contacts of a board at a time.
#[pyclass(frozen, module = "taxel")]
pub struct Moment {
    stamp: Stamp,
    contacts: Py<PyAny>,
}

impl Moment {
    /// The Python object.
    pub fn object(py: Python<'_>, fact: &MomentFact) -> PyResult<Moment> {
        Ok(Moment { stamp: fact.stamp, contacts: contact::moment_contacts(py, &fact.contacts)?.unbind() })
    }
}

#[pymethods]
impl Moment {
    /// Returns its host time, ns since 1970: the time that was asked for, or that of the newest list.
    #[getter]
    fn host_ns(&self) -> u64 {
        self.stamp.host_ns()
    }

    /// The most by which that is off, us; None if the board has not answered yet.
    #[getter]
    fn host_time_uncertainty_us(&self) -> Option<u64> {
        self.stamp.uncertainty_us
    }

    /// The board's own time, us.
    #[getter]
    fn time_us(&self) -> u64 {
        self.stamp.board_us
    }

    /// Contacts, of dtype `taxel.MOMENT`.
    #[getter]
    fn contacts<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        self.contacts.bind(py).clone()
    }
}
