//! `taxel ros2`: a ROS 2 node that publishes a board's stream, and takes joint states and concepts.

mod robot;

use crate::fault::Fault;
use crate::ros2::{DOMAINS, RosNode, RosParameters, RosPlace, RosShow};
use crate::watch::{self, BoardArgs, WatchOptions, stop, time};
use anyhow::Result;
use clap::Args;
use taxel::body;
use taxel::source::SourceOptions;

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel ros2 --source sim:pat
  taxel ros2 --source serial:/dev/ttyACM0 --garment block-4x16 --tare 32 --namespace /left
  taxel ros2 --source sim:five --body reference --robot reference";

/// Run a ROS 2 node that publishes a board's stream, live
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct Ros2Args {
    /// The board.
    #[command(flatten)]
    pub board: BoardArgs,
    /// The node.
    #[command(flatten)]
    pub node: RosNodeArgs,
    /// Stamp messages with the board's time, and report it on /clock: other nodes set use_sim_time
    #[arg(long)]
    pub clock: bool,
    /// Stop after this time of the board, such as 2s or 10min [default: never; simulated scenes are repeated]
    #[arg(long = "for", value_name = "TIME", value_parser = time, allow_negative_numbers = true)]
    pub seconds: Option<f64>,
}

/// Names of the nodes, and what they publish.
#[derive(Debug, Clone, Args)]
pub struct RosNodeArgs {
    /// Domain of ROS, 0 to 232 [default: ROS_DOMAIN_ID, else 0]
    #[arg(long, value_name = "N")]
    pub domain: Option<u16>,
    /// Namespace of the node
    #[arg(long, value_name = "NAMESPACE", default_value = "/")]
    pub namespace: String,
    /// Name of the node
    #[arg(long, value_name = "NAME", default_value = "taxel")]
    pub name: String,
    /// Images, points and forces of a panel per second; 0: none. The parameter image_hz changes it
    #[arg(long, value_name = "HZ", default_value = "10", value_parser = hz, allow_negative_numbers = true)]
    pub image_hz: f64,
}

/// Parses a rate of images.
fn hz(text: &str) -> Result<f64, String> {
    let rate = text.parse().ok().filter(|rate: &f64| (0.0..=1000.0).contains(rate));
    rate.ok_or_else(|| "must be 0 to 1000".into())
}

impl RosNodeArgs {
    /// Returns where the node is. Error if a name or the domain is invalid.
    pub fn place(&self) -> Result<RosPlace> {
        let domain = match (self.domain, std::env::var("ROS_DOMAIN_ID").ok().filter(|text| !text.is_empty()))
        {
            (Some(domain), _) => Some(domain),
            (None, Some(text)) => text.trim().parse().ok(),
            (None, None) => Some(0),
        };
        let domain = domain.filter(|domain| DOMAINS.contains(domain));
        let must = "the domain of ROS (--domain, ROS_DOMAIN_ID) must be a whole number from 0 to 232";
        let domain = domain.ok_or_else(|| Fault::usage(must))?;
        let (namespace, name) = (self.namespace.clone(), self.name.clone());
        let place = RosPlace { domain, namespace, name, board: None };
        place.check()?;
        Ok(place)
    }
}

/// Runs the command.
pub fn run(args: Ros2Args) -> Result<()> {
    if let Some(robot) = args.board.robot()? {
        return robot::run(&args, &robot);
    }
    let place = args.node.place()?;
    let options = SourceOptions { realtime: true, repeat: true, ..SourceOptions::default() };
    let body = args.board.config.body.as_deref().map(body::read).transpose()?;
    let (source, _) = args.board.open(options)?;
    let parameters = RosParameters { source: source.label.clone(), image_hz: args.node.image_hz };
    let at = format!("{} as node {} in domain {}", source.label, place.absolute(&place.name), place.domain);
    let mut show = RosShow::new(RosNode::open(place, &parameters)?, args.clock, body);
    // The node leaves the network before the program ends.
    stop::catch()?;
    println!("{at} (Ctrl-C ends)");
    watch::watch(&WatchOptions { seconds: args.seconds, ..WatchOptions::on(args.board) }, source, &mut show)
}
