//! From touch to motion: velocities of the joints from what touches the robot.

use crate::array;
use crate::error::{argument, raised, usage};
use crate::value;
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use taxel::body::DVec3;
use taxel::body::robot::{self, Robot};
use taxel::mind::{BodyPlace, Mover};
use taxel::motion::{
    self, Behaviour, MotionBoard, MotionControl, MotionFault, MotionInput, MotionPosture, MotionState,
};
use taxel::robot::ReadRobot;
use taxel_core::intent::Leading;

/// A contact on a robot, for `Motion`.
#[pyclass(frozen, get_all, module = "taxel")]
pub struct MotionTouch {
    /// Name of its link.
    link: String,
    /// Place in the frame of the link, m.
    at: [f64; 3],
    /// Direction away from the robot there, of any length.
    normal: [f64; 3],
    /// Force along the normal, N.
    newtons: f64,
    /// Number from onset to release, among all contacts of the robot.
    touch: u64,
    /// Name of its region.
    region: String,
    /// Whose motion has caused it: `own`, `other` or `unsure`.
    mover: String,
}

#[pymethods]
impl MotionTouch {
    #[new]
    #[pyo3(signature = (link, at, normal, newtons, *, touch=0, region="", mover="other"))]
    fn new(
        link: String,
        at: [f64; 3],
        normal: [f64; 3],
        newtons: f64,
        touch: u64,
        region: &str,
        mover: &str,
    ) -> PyResult<MotionTouch> {
        by(mover)?;
        Ok(MotionTouch { link, at, normal, newtons, touch, region: region.into(), mover: mover.into() })
    }

    fn __repr__(&self) -> String {
        format!("MotionTouch({:?}, {:.1} N, touch={})", self.link, self.newtons, self.touch)
    }
}

fn by(mover: &str) -> PyResult<Mover> {
    match mover {
        "own" => Ok(Mover::Own),
        "other" => Ok(Mover::Other),
        "unsure" => Ok(Mover::Unsure),
        _ => Err(usage(format!("mover must be own, other or unsure, not {mover:?}"))),
    }
}

/// Command of a robot at a cycle.
#[pyclass(frozen, get_all, module = "taxel")]
pub struct MotionCommand {
    /// `disarmed`, `armed` or `stopped`.
    phase: &'static str,
    /// Name of the deed.
    deed: &'static str,
    /// The fault that has stopped it; None if none has.
    fault: Option<&'static str>,
    /// Factor on the speed of the robot's own motion, 0 to 1; None while it is disarmed.
    speed: Option<f64>,
    /// Velocities in the order of `Motion.joints`, rad/s or m/s.
    velocities: Py<PyAny>,
    /// Energy that is left in the tank, J.
    tank_j: f64,
    /// Share to which the tank or a pair of links has cut the velocities.
    share: f64,
    /// Touches about which something is done.
    causes: Py<PyAny>,
}

#[pymethods]
impl MotionCommand {
    fn __repr__(&self) -> String {
        format!("MotionCommand(phase={:?}, deed={:?}, speed={:?})", self.phase, self.deed, self.speed)
    }
}

/// A robot and its behaviour.
#[pyclass(frozen, subclass, module = "taxel")]
pub struct Motion {
    control: MotionControl,
    state: Mutex<MotionState>,
}

/// Positions of joints, by name or in their order.
#[derive(FromPyObject)]
enum Positions {
    Named(BTreeMap<String, f64>),
    Listed(Vec<f64>),
}

/// Posture, contacts and meaning at a cycle.
struct Cycle {
    now_us: u64,
    posture_us: u64,
    scanned_us: u64,
    positions: Vec<f64>,
    touches: Vec<motion::MotionTouch>,
    leading: Leading,
}

impl Cycle {
    fn with<T>(&self, act: impl FnOnce(&MotionInput<'_>) -> T) -> T {
        let boards =
            [MotionBoard { scanned_us: Some(self.scanned_us), period_us: 0, is_calibrated: true, begun: 1 }];
        act(&MotionInput {
            now_us: self.now_us,
            posture: Some(MotionPosture { at_us: self.posture_us, positions: &self.positions }),
            boards: &boards,
            touches: &self.touches,
            leading: self.leading,
        })
    }
}

impl Motion {
    fn lock(&self) -> MutexGuard<'_, MotionState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn cycle(
        &self,
        positions: Positions,
        now_us: u64,
        touches: &[PyRef<'_, MotionTouch>],
        (leading, posture_us, scanned_us): (&str, Option<u64>, Option<u64>),
    ) -> PyResult<Cycle> {
        let robot = self.control.robot();
        let positions = match positions {
            Positions::Listed(positions) => positions,
            Positions::Named(named) => {
                let mut posture = robot.rest();
                for (name, position) in named {
                    let joint = robot.joint(&name).map_err(taxel::Error::from).map_err(raised)?;
                    // Joints that mimic others are told, too.
                    if let Some(free) = robot.free().iter().position(|free| *free == joint) {
                        posture[free] = position;
                    }
                }
                posture
            }
        };
        let touches = touches.iter().map(|touch| {
            let link = robot.link(&touch.link).map_err(taxel::Error::from).map_err(raised)?;
            let place = BodyPlace { region: touch.region.clone(), link: touch.link.clone() };
            Ok(motion::MotionTouch {
                touch: touch.touch,
                place: Arc::new(place),
                link,
                at: DVec3::from(touch.at),
                normal: DVec3::from(touch.normal).normalize_or_zero(),
                newtons: touch.newtons,
                mover: by(&touch.mover)?,
            })
        });
        let touches = touches.collect::<PyResult<Vec<_>>>()?;
        let named = [Leading::None, Leading::Kindness, Leading::Threat, Leading::Attack];
        let leading = named.into_iter().find(|it| it.as_str() == leading);
        let leading = leading.ok_or_else(|| usage("leading must be none, kindness, threat or attack"))?;
        let (posture_us, scanned_us) = (posture_us.unwrap_or(now_us), scanned_us.unwrap_or(now_us));
        Ok(Cycle { now_us, posture_us, scanned_us, positions, touches, leading })
    }
}

fn open(robot: &Path, behaviour: &str) -> anyhow::Result<MotionControl> {
    let robot: Arc<Robot> = if robot.extension().is_some_and(|end| end == "toml") {
        let read = ReadRobot::read(robot)?;
        read.robot.ok_or_else(|| argument(format!("{}: the robot's file names no `urdf`", read.file)))?
    } else {
        Arc::new(robot::read(&robot.display().to_string())?)
    };
    let behaviour = Behaviour::read(behaviour, &robot)?;
    Ok(MotionControl::new(robot, behaviour))
}

#[pymethods]
impl Motion {
    #[new]
    #[pyo3(signature = (robot, behaviour=PathBuf::from("people")))]
    fn new(py: Python<'_>, robot: PathBuf, behaviour: PathBuf) -> PyResult<Motion> {
        let control = py.detach(|| open(&robot, &behaviour.display().to_string())).map_err(raised)?;
        Ok(Motion { state: Mutex::new(control.start()), control })
    }

    /// Names of the joints that have a position of their own.
    #[getter]
    fn joints(&self) -> Vec<String> {
        let robot = self.control.robot();
        robot.free().iter().map(|joint| robot.joints()[*joint].name.clone()).collect()
    }

    /// `disarmed`, `armed` or `stopped`.
    #[getter]
    fn phase(&self) -> &'static str {
        self.lock().phase().as_str()
    }

    /// Times that each fault has stopped it.
    #[getter]
    fn faults(&self) -> BTreeMap<&'static str, u64> {
        let state = self.lock();
        MotionFault::ALL.into_iter().map(|fault| (fault.as_str(), state.count(fault))).collect()
    }

    /// Arms it, from standstill. Raises `Error` while what is known would stop it.
    #[pyo3(signature = (positions, time_us, *, posture_us=None, frame_us=None))]
    fn arm(
        &self,
        positions: Positions,
        time_us: u64,
        posture_us: Option<u64>,
        frame_us: Option<u64>,
    ) -> PyResult<()> {
        let cycle = self.cycle(positions, time_us, &[], ("none", posture_us, frame_us))?;
        let armed = cycle.with(|input| self.control.arm(&mut self.lock(), input));
        armed.map_err(|fault| raised(anyhow::anyhow!("not armed: {}", fault.as_str())))
    }

    /// Disarms it: it says nothing more.
    fn disarm(&self) {
        self.lock().disarm();
    }

    /// Advances to a cycle.
    #[pyo3(signature = (positions, time_us, touches=Vec::new(), *, leading="none", posture_us=None, frame_us=None))]
    #[allow(clippy::too_many_arguments)] // keywords in Python
    fn __call__(
        &self,
        py: Python<'_>,
        positions: Positions,
        time_us: u64,
        touches: Vec<PyRef<'_, MotionTouch>>,
        leading: &str,
        posture_us: Option<u64>,
        frame_us: Option<u64>,
    ) -> PyResult<MotionCommand> {
        let cycle = self.cycle(positions, time_us, &touches, (leading, posture_us, frame_us))?;
        let command = cycle.with(|input| self.control.step(&mut self.lock(), input));
        let line = command.line(self.control.robot(), time_us);
        Ok(MotionCommand {
            phase: command.phase.as_str(),
            deed: command.deed.as_str(),
            fault: command.fault.map(MotionFault::as_str),
            speed: command.speed,
            velocities: array::frozen(py, command.velocities)?.unbind(),
            tank_j: command.tank_j,
            share: command.share,
            causes: value::object(py, &line["causes"])?.unbind(),
        })
    }
}
