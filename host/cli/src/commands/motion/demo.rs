//! `taxel motion --demo`: an arm that is patted, pushed, clamped and led. No garment and no physics: each hand is a
//! point on a spring, and the arm goes where its velocities lead it.

use anyhow::Result;
use std::sync::Arc;
use taxel::body::DVec3;
use taxel::body::robot::{self, Robot};
use taxel::mind::{BodyPlace, Mover};
use taxel::motion::{
    Behaviour, MotionBoard, MotionCommand, MotionControl, MotionInput, MotionPosture, MotionState,
    MotionTouch,
};
use taxel_core::intent::Leading;

/// Time of a cycle, us.
const CYCLE_US: u64 = 5000;
/// Cycles between two lines.
const LINE: u64 = 20;
/// Stiffness of a hand, N/m.
const STIFFNESS: f64 = 2000.0;
/// Height of the touched places on the forearm, m.
const HEIGHT: f64 = -0.18;

/// A hand: on which side of the forearm it presses, and how deep into it at a time of the scene, m, if it stood still.
struct DemoHand {
    side: DVec3,
    depth: fn(f64) -> f64,
}

/// A scene: what is done, for how long, and by which hands.
struct DemoScene {
    name: &'static str,
    seconds: f64,
    hands: &'static [DemoHand],
}

const SCENES: [DemoScene; 4] = [
    DemoScene {
        name: "pat: short and light; the robot's own motion slows down, and no joint moves",
        seconds: 1.0,
        hands: &[DemoHand { side: DVec3::X, depth: |at| if at % 0.3 < 0.12 { 0.003 } else { -1.0 } }],
    },
    DemoScene {
        name: "push: hard and held; the forearm gives way along the normal, for as long as it is pressed",
        seconds: 1.0,
        hands: &[DemoHand { side: DVec3::X, depth: |at| if at < 0.6 { 0.02 } else { -1.0 } }],
    },
    DemoScene {
        name: "clamp: from both sides; it stands still, and says so",
        seconds: 0.8,
        hands: &[
            DemoHand { side: DVec3::X, depth: |at| if at < 0.5 { 0.01 } else { -1.0 } },
            DemoHand { side: DVec3::NEG_X, depth: |at| if at < 0.5 { 0.008 } else { -1.0 } },
        ],
    },
    DemoScene {
        name: "lead: a hand that stays leads the arm, and leaves it at rest",
        seconds: 2.0,
        hands: &[DemoHand {
            side: DVec3::X,
            depth: |at| if at < 1.5 { 0.001 + 0.1 * (at - 0.3).max(0.0) } else { -1.0 },
        }],
    },
];

/// The arm.
struct DemoArm {
    control: MotionControl,
    state: MotionState,
    positions: Vec<f64>,
    forearm: usize,
    now_us: u64,
}

/// Runs the demonstration.
pub fn run() -> Result<()> {
    let robot = Arc::new(robot::read("reference")?);
    let behaviour = Behaviour::read("people", &robot)?;
    let lifted =
        "left_shoulder_pitch=45deg,left_shoulder_roll=40deg,left_shoulder_yaw=20deg,left_elbow=70deg";
    let (positions, forearm) =
        (robot.posture_of(lifted)?, robot.link("left_forearm").map_err(taxel::Error::from)?);
    let control = MotionControl::new(robot, behaviour);
    for scene in &SCENES {
        let state = control.start();
        let (control, positions) = (control.clone(), positions.clone());
        let mut arm = DemoArm { control, state, positions, forearm, now_us: CYCLE_US };
        println!("\n{}", scene.name);
        arm.play(scene)?;
    }
    println!("\nThe behaviour is `people`; docs/guides/motion.md says how to write your own.");
    Ok(())
}

impl DemoArm {
    fn play(&mut self, scene: &DemoScene) -> Result<()> {
        let begun_us = self.now_us;
        let robot = self.control.robot().clone();
        let armed = with(self.now_us, &self.positions, &[], |input| self.control.arm(&mut self.state, input));
        armed.map_err(|fault| anyhow::anyhow!("not armed: {}", fault.as_str()))?;
        let at_start: Vec<DVec3> = scene.hands.iter().filter_map(|hand| self.place(&robot, hand)).collect();
        let mut moved = 0.0;
        for cycle in 1..=(scene.seconds * 1e6) as u64 / CYCLE_US {
            self.now_us += CYCLE_US;
            let at_s = (self.now_us - begun_us) as f64 * 1e-6;
            let touches: Vec<MotionTouch> = (0u64..)
                .zip(scene.hands.iter().zip(&at_start))
                .filter_map(|(number, (hand, start))| self.touch(&robot, number, hand, *start, at_s))
                .collect();
            let command = with(self.now_us, &self.positions, &touches, |input| {
                self.control.step(&mut self.state, input)
            });
            let before = self.place(&robot, &scene.hands[0]);
            for (position, velocity) in self.positions.iter_mut().zip(&command.velocities) {
                *position += velocity * CYCLE_US as f64 * 1e-6;
            }
            moved += before.zip(self.place(&robot, &scene.hands[0])).map_or(0.0, |(a, b)| a.distance(b));
            if cycle % LINE == 1 {
                println!("  {at_s:.2} s  {:68}  moved {:5.1} mm", said(&command), 1e3 * moved);
            }
        }
        Ok(())
    }

    /// Place in the base at which a hand touches.
    fn place(&self, robot: &Robot, hand: &DemoHand) -> Option<DVec3> {
        let pose = robot.poses(&self.positions).of(self.forearm, 0)?;
        Some(pose.point(0.03 * hand.side + DVec3::Z * HEIGHT))
    }

    /// The touch of a hand at a time of the scene: how deep the place has been pressed, less how far it has gone.
    fn touch(
        &self,
        robot: &Robot,
        number: u64,
        hand: &DemoHand,
        start: DVec3,
        at_s: f64,
    ) -> Option<MotionTouch> {
        let pose = robot.poses(&self.positions).of(self.forearm, 0)?;
        let gone = (start - self.place(robot, hand)?).dot(pose.direction(hand.side));
        let newtons = STIFFNESS * ((hand.depth)(at_s) - gone);
        (newtons > 0.1).then(|| MotionTouch {
            touch: 1 + number,
            place: Arc::new(BodyPlace { region: "left forearm".into(), link: "left_forearm".into() }),
            link: self.forearm,
            at: 0.03 * hand.side + DVec3::Z * HEIGHT,
            normal: hand.side,
            newtons,
            mover: Mover::Other,
        })
    }
}

/// Does something with the input of a cycle.
fn with<T>(
    now_us: u64,
    positions: &[f64],
    touches: &[MotionTouch],
    act: impl FnOnce(&MotionInput<'_>) -> T,
) -> T {
    let boards = [MotionBoard { scanned_us: Some(now_us), period_us: 5120, is_calibrated: true, begun: 1 }];
    let posture = Some(MotionPosture { at_us: now_us, positions });
    act(&MotionInput { now_us, posture, boards: &boards, touches, leading: Leading::None })
}

/// Deed of a command, and speed of the fastest joint.
fn said(command: &MotionCommand) -> String {
    let fastest = command.velocities.iter().fold(0.0, |most: f64, velocity| most.max(velocity.abs()));
    let fastest = if fastest > 0.0 { format!(", {fastest:.2} rad/s") } else { String::new() };
    command.text() + &fastest
}
