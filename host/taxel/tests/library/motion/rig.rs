//! A robot that goes where its velocities lead it, cycle by cycle, with a board that scans each time.

use std::sync::Arc;
use taxel::body::DVec3;
use taxel::body::robot::{self, Robot};
use taxel::mind::{BodyPlace, Mover};
use taxel::motion::{
    Behaviour, MotionBoard, MotionCommand, MotionControl, MotionFault, MotionInput, MotionPosture,
    MotionState, MotionTouch,
};
use taxel_core::intent::Leading;

/// Time of a cycle, us.
pub const CYCLE_US: u64 = 5000;

pub struct Rig {
    pub control: MotionControl,
    pub state: MotionState,
    pub now_us: u64,
    /// Age of the posture, us.
    pub old_us: u64,
    pub positions: Vec<f64>,
    pub boards: Vec<MotionBoard>,
    pub touches: Vec<MotionTouch>,
    pub leading: Leading,
    /// Greatest velocity and acceleration so far, as shares of the limits.
    pub most: [f64; 2],
    before: Vec<f64>,
}

impl Rig {
    pub fn new(behaviour: &str, joints: &[(&str, f64)]) -> Rig {
        Rig::of(Arc::new(robot::read("reference").unwrap()), behaviour, joints)
    }

    pub fn of(robot: Arc<Robot>, behaviour: &str, joints: &[(&str, f64)]) -> Rig {
        let behaviour = match behaviour {
            "people" => Behaviour::read("people", &robot),
            text => Behaviour::parse("behaviour.toml", text, &robot),
        };
        let positions = robot.posture(joints.iter().copied()).unwrap();
        let control = MotionControl::new(robot, behaviour.unwrap());
        let state = control.start();
        Rig {
            state,
            control,
            now_us: 1_000_000,
            old_us: 0,
            boards: vec![MotionBoard {
                scanned_us: Some(1_000_000),
                period_us: 5120,
                is_calibrated: true,
                begun: 1,
            }],
            touches: Vec::new(),
            leading: Leading::None,
            most: [0.0; 2],
            before: vec![0.0; positions.len()],
            positions,
        }
    }

    pub fn armed(behaviour: &str, joints: &[(&str, f64)]) -> Rig {
        let mut rig = Rig::new(behaviour, joints);
        rig.arm().unwrap();
        rig
    }

    pub fn arm(&mut self) -> Result<(), MotionFault> {
        let Rig { control, state, now_us, old_us, positions, boards, touches, leading, .. } = self;
        let posture = MotionPosture { at_us: *now_us - *old_us, positions };
        let input =
            MotionInput { now_us: *now_us, posture: Some(posture), boards, touches, leading: *leading };
        control.arm(state, &input)
    }

    /// A cycle in which the boards scan, and the robot goes where it is led.
    pub fn cycle(&mut self) -> MotionCommand {
        self.now_us += CYCLE_US;
        self.boards.iter_mut().for_each(|board| board.scanned_us = board.scanned_us.map(|_| self.now_us));
        let command = self.look();
        let seconds = CYCLE_US as f64 * 1e-6;
        for (joint, limit) in self.control.behaviour().joints.iter().enumerate() {
            let velocity = command.velocities[joint];
            self.positions[joint] += velocity * seconds;
            if velocity != 0.0 {
                let change = (velocity - self.before[joint]).abs() / seconds;
                self.most[0] = self.most[0].max(velocity.abs() / limit.velocity);
                self.most[1] = self.most[1].max(change / limit.acceleration);
            }
        }
        self.before.clone_from(&command.velocities);
        command
    }

    /// The command of what is known now; nothing goes on.
    pub fn look(&mut self) -> MotionCommand {
        let Rig { control, state, now_us, old_us, positions, boards, touches, leading, .. } = self;
        let posture = MotionPosture { at_us: *now_us - *old_us, positions };
        let input =
            MotionInput { now_us: *now_us, posture: Some(posture), boards, touches, leading: *leading };
        control.step(state, &input)
    }

    /// The last command of so many seconds.
    pub fn run(&mut self, seconds: f64) -> MotionCommand {
        let cycles = (seconds * 1e6 / CYCLE_US as f64).round() as u64;
        (1..cycles).for_each(|_| _ = self.cycle());
        self.cycle()
    }

    pub fn touch(&self, touch: u64, link: &str, at: [f64; 3], normal: [f64; 3], newtons: f64) -> MotionTouch {
        MotionTouch {
            touch,
            place: Arc::new(BodyPlace { region: link.replace('_', " "), link: link.into() }),
            link: self.control.robot().link(link).unwrap(),
            at: at.into(),
            normal: DVec3::from(normal).normalize(),
            newtons,
            mover: Mover::Other,
        }
    }

    /// Place and normal of a touch in the base.
    pub fn in_base(&self, touch: &MotionTouch) -> (DVec3, DVec3) {
        let pose = self.control.robot().poses(&self.positions).of(touch.link, 0).unwrap();
        (pose.point(touch.at), pose.direction(touch.normal))
    }

    /// Velocity of a touched point in the base with these velocities.
    pub fn velocity(&self, touch: &MotionTouch, velocities: &[f64]) -> DVec3 {
        let robot = self.control.robot();
        let (at, _) = self.in_base(touch);
        let columns = robot.jacobian(&robot.poses(&self.positions), touch.link, at);
        columns.iter().zip(velocities).map(|(column, velocity)| *column * *velocity).sum()
    }
}

/// The reference robot's left arm, lifted and bent: far from limits and singular postures.
pub const LIFTED: [(&str, f64); 4] = [
    ("left_shoulder_pitch", 0.8),
    ("left_shoulder_roll", 0.7),
    ("left_shoulder_yaw", 0.3),
    ("left_elbow", 1.2),
];
