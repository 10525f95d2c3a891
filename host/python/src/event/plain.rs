//! Events whose attributes are the keys of their line, and nothing else.

use super::base::Event;
use super::fact::Note;
use pyo3::prelude::*;

/// A log message of the board.
#[pyclass(frozen, subclass, extends = Event, module = "taxel")]
pub struct Log;

/// The link to the board is lost, and waited for; `text` says why.
#[pyclass(frozen, extends = Log, module = "taxel")]
pub struct Lost;

/// The board is back, and its settings are restored; `text` says which.
#[pyclass(frozen, extends = Log, module = "taxel")]
pub struct Back;

/// Classes without methods of their own, by the type of their lines.
macro_rules! classes {
    ($($kind:literal => $name:ident, $doc:literal;)*) => {
        $(
            #[doc = $doc]
            #[pyclass(frozen, extends = Event, module = "taxel")]
            pub struct $name;
        )*

        fn of_kind(py: Python<'_>, kind: &str, event: Event) -> PyResult<Py<PyAny>> {
            let event = PyClassInitializer::from(event);
            match kind {
                $($kind => Ok(Py::new(py, event.add_subclass($name))?.into_any()),)*
                _ => Ok(Py::new(py, event)?.into_any()),
            }
        }

        fn add_kinds(module: &Bound<'_, PyModule>) -> PyResult<()> {
            $(module.add_class::<$name>()?;)*
            Ok(())
        }
    };
}

classes! {
    "hello" => Hello, "Garment, scene and firmware of the board.";
    "boot" => Boot, "Cause of the board's start.";
    "unusable" => Unusable, "A `Hello` that this version cannot use; `why` says why.";
    "symbols" => Symbols, "Words for each contact, and the state of each region.";
    "intent" => Intent, "The announced intention, `intent[\"leading\"]`, and the activation of each concept.";
    "gesture" => Gesture, "The gesture of a touch.";
    "confidence" => Confidence, "Confidence of the gesture that follows.";
    "unsure" => Unsure, "Ids of the contacts that may be drift.";
    "forms" => Forms, "Ages of the forms of contacts.";
    "pressing" => Pressing, "What presses on the robot: contacts on links, and the force on each link.";
    "folds" => Folds, "What the garment's folds are expected to press.";
    "regions" => Regions, "What each region of the robot's surface feels.";
    "shapes" => Shapes, "The base of shapes in use.";
    "reaction" => Reaction, "A reaction that began or ended.";
    "reflex" => Reflex, "A reaction that began within a frame.";
    "health" => Health, "Counters of the board.";
    "budget" => Budget, "Time spent on frames.";
    "temperature" => Temperature, "Temperature of the board's converter.";
    "health_map" => HealthMap, "Faulty taxels.";
    "self_test" => SelfTest, "Faults of lines and inputs.";
    "sync" => Sync, "Answer to a request for the board's time.";
    "start_of_frame" => StartOfFrame, "When a frame of the USB began.";
    "answer" => Answer, "Answer to a request: `refusal` is None if it was carried out.";
    "board" => BoardState, "How a board of a robot is: `state`, and why.";
    "robot_intent" => RobotIntent, "What touches on all boards together mean to the robot.";
    "refused" => Refused, "Bytes that are not a message.";
}

/// The Python object of an event of this kind.
pub fn object(py: Python<'_>, kind: &str, note: Option<Note>, event: Event) -> PyResult<Py<PyAny>> {
    let log = |event| PyClassInitializer::from(event).add_subclass(Log);
    match (note, kind) {
        (Some(Note::Lost), _) => Ok(Py::new(py, log(event).add_subclass(Lost))?.into_any()),
        (Some(Note::Back), _) => Ok(Py::new(py, log(event).add_subclass(Back))?.into_any()),
        (None, "log") => Ok(Py::new(py, log(event))?.into_any()),
        (None, kind) => of_kind(py, kind, event),
    }
}

/// Adds the classes to the module.
pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Log>()?;
    module.add_class::<Lost>()?;
    module.add_class::<Back>()?;
    add_kinds(module)
}
