//! `taxel motion`: from touch to motion: velocities of a robot's joints and the speed of its own motion, as lines of
//! JSON and, with `--ros2`, as a ROS 2 node.

mod demo;
mod follow;
mod lines;
#[cfg(feature = "ros2")]
mod node;

#[cfg(feature = "ros2")]
use crate::commands::views::ros2::RosNodeArgs;
use crate::fault::Fault;
use crate::watch::{BoardArgs, RequestLines, run_limit, stop, time, watch_robot};
use anyhow::{Context, Result};
use clap::Args;
use follow::{Face, MotionFollower};
use lines::MotionLines;
use taxel::mind::MindReader;
use taxel::motion::{Behaviour, MotionControl, MotionNews};
use taxel::robot::{RobotStream, WhenFull};

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel motion --demo
  my_robot | taxel motion robot.toml --behaviour people --requests - --arm
  taxel motion robot.toml --behaviour behaviour.toml --ros2

`my_robot` prints the positions of the joints, a line each time: {\"positions\": {\"left_elbow\": 0.5}}. Without --arm
nothing is commanded until the service ~/arm is called.";

/// Move a robot by touch: velocities of its joints, and the speed of its own motion
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct MotionArgs {
    /// The robot: its file, whose boards have a body and whose `urdf` describes it.
    #[command(flatten)]
    pub board: BoardArgs,
    /// Behaviour when the robot is touched: a TOML file, or `people`
    #[arg(long, value_name = "FILE", default_value = "people")]
    pub behaviour: String,
    /// Show what it does: a simulated arm is patted, pushed, clamped and led. Nothing else is read
    #[arg(long, exclusive = true)]
    pub demo: bool,
    /// Arm it once, as soon as all boards scan and all joints are told
    #[arg(long)]
    pub arm: bool,
    /// Stop after this time of the boards, such as 2s or 10min [default: never; simulated scenes are repeated]
    #[arg(long = "for", value_name = "TIME", value_parser = time, allow_negative_numbers = true)]
    pub seconds: Option<f64>,
    /// Also run a ROS 2 node: it takes /joint_states, and publishes what is commanded
    #[cfg(feature = "ros2")]
    #[arg(long)]
    pub ros2: bool,
    /// Link whose velocity is published as a twist, by the node
    #[cfg(feature = "ros2")]
    #[arg(long, value_name = "LINK", requires = "ros2")]
    pub tip: Option<String>,
    /// The node.
    #[cfg(feature = "ros2")]
    #[command(flatten)]
    pub node: RosNodeArgs,
}

/// Runs the command.
pub fn run(args: MotionArgs) -> Result<()> {
    if args.demo {
        return demo::run();
    }
    let robot =
        args.board.robot()?.ok_or_else(|| Fault::usage("name a robot's file: taxel motion robot.toml"))?;
    let described = robot.robot.clone();
    let described =
        described.ok_or_else(|| Fault::usage(format!("{}: the robot needs a `urdf`", robot.file)))?;
    let behaviour = Behaviour::read(&args.behaviour, &described)?;
    let control = MotionControl::new(described, behaviour);
    let requests = RequestLines::of(args.board.requests.as_deref())?;
    #[cfg_attr(not(feature = "ros2"), allow(unused_mut, reason = "the node is one more"))]
    let mut faces: Vec<Box<dyn Face>> = vec![Box::new(MotionLines::new(&control))];
    #[cfg(feature = "ros2")]
    if args.ros2 {
        faces.push(Box::new(node(&args, &control)?));
    }
    let mut follower = MotionFollower::new(&robot, control, args.arm, faces)?;
    let options = args.board.at_real_time(args.seconds);
    let plans = robot.plans(&options, &run_limit(None, args.seconds));
    stop::catch()?;
    let session = RobotStream::start(plans, WhenFull::DropImages, |number, queue| {
        let mut reader = MindReader::new(&robot, number);
        queue.make(move |client, event, _| MotionNews::of(&mut reader, client, event))
    })
    .context("the boards cannot be followed")?;
    watch_robot(&robot, session, requests, &mut follower)
}

#[cfg(feature = "ros2")]
fn node(args: &MotionArgs, control: &MotionControl) -> Result<node::NodeFace> {
    use crate::ros2::{MotionNode, RosNode, RosParameters};
    let robot = control.robot().clone();
    let tip = args.tip.as_deref().map(|tip| robot.link(tip)).transpose().map_err(taxel::Error::from)?;
    let parameters = RosParameters { source: args.board.source().to_string(), image_hz: args.node.image_hz };
    let node = MotionNode::open(RosNode::open(args.node.place()?, &parameters)?, control, tip)?;
    Ok(node::NodeFace { node, robot })
}
