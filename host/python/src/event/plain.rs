//! Events whose attributes are the keys of their line, and nothing else.

use super::base::Event;
use pyo3::prelude::*;

/// Classes without methods of their own, by the type of their lines.
macro_rules! classes {
    ($($kind:literal => $name:ident, $doc:literal;)*) => {
        $(
            #[doc = $doc]
            #[pyclass(frozen, extends = Event, module = "taxel")]
            pub struct $name;
        )*

        /// The Python object of an event of this kind.
        pub fn object(py: Python<'_>, kind: &str, event: Event) -> PyResult<Py<PyAny>> {
            let event = PyClassInitializer::from(event);
            match kind {
                $($kind => Ok(Py::new(py, event.add_subclass($name))?.into_any()),)*
                _ => Ok(Py::new(py, event)?.into_any()),
            }
        }

        /// Adds the classes to the module.
        pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
            $(module.add_class::<$name>()?;)*
            Ok(())
        }
    };
}

classes! {
    "hello" => Hello, "Garment, scene and firmware of the board.";
    "unusable" => Unusable, "A `Hello` that this version cannot use; `why` says why.";
    "symbols" => Symbols, "Words for each contact, and the state of each region.";
    "intent" => Intent, "The announced intention, `intent[\"leading\"]`, and the activation of each concept.";
    "gesture" => Gesture, "The gesture of a touch.";
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
    "log" => Log, "A log message of the board, or a remark of the host about the link.";
    "lost" => Lost, "The link to the board is lost, and waited for; `why` says why. What was present has ended just before.";
    "back" => Back, "The lost board is back after `after_s` seconds, and its settings are restored; `how` says which.";
    "sync" => Sync, "Answer to a request for the board's time.";
    "start_of_frame" => StartOfFrame, "When a frame of the USB began.";
    "answer" => Answer, "Answer to a request: `refusal` is None if it was carried out.";
    "board" => BoardState, "How a board of a robot is: `state`, and why.";
    "robot_intent" => RobotIntent, "What touches on all boards together mean to the robot.";
    "refused" => Refused, "Bytes that are not a message.";
}
