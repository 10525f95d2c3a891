//! A panel laid over a mesh: the list of its taxels.

use crate::fault::Fault;
use crate::watch::Overwrite;
use anyhow::{Result, anyhow, ensure};
use clap::Args;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use taxel::body::mesh::{self, Drape, Mesh, OfLink};
use taxel::body::robot::LinkShape;
use taxel::body::{DVec3, Pose};
use taxel::files::garments;
use taxel::files::output::Output;
use taxel::text::words;

/// A mesh, a panel, and where its middle lies.
#[derive(Debug, Clone, Args)]
pub struct DrapeArgs {
    /// The link's mesh: an STL or OBJ file, in the link's frame
    #[arg(required_unless_present = "robot", conflicts_with = "robot")]
    mesh: Option<PathBuf>,
    /// The robot whose link has the mesh: a URDF file, which says where the mesh is, its scale and its place
    #[arg(long, value_name = "URDF", requires = "link")]
    robot: Option<String>,
    /// The link
    #[arg(long, value_name = "NAME", requires = "robot")]
    link: Option<String>,
    /// Take the link's collision shape, not how it looks
    #[arg(long, requires = "robot")]
    collision: bool,
    /// Folder of the files of package://NAME/ [default: sought in the folders above the URDF]
    #[arg(long, value_name = "NAME=DIR", value_parser = package, requires = "robot")]
    package: Vec<(String, PathBuf)>,
    /// The panel
    #[arg(long, value_name = "NAME")]
    panel: String,
    /// The garment that has the panel: a TOML file or a preset
    #[arg(long, value_name = "G", default_value = "reference")]
    garment: String,
    /// Metres of one unit of the mesh: 0.001 for millimetres
    #[arg(long, value_name = "M", default_value_t = 1.0, conflicts_with = "robot")]
    scale: f64,
    /// Middle of the panel, m: the nearest point of the mesh is taken
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true)]
    at: DVec3,
    /// The direction in which the panel's rows are counted
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true, default_value = "0,0,-1")]
    down: DVec3,
    /// The list to write, for `on.taxels` of a body file; - for the standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Whether an existing file is replaced.
    #[command(flatten)]
    force: Overwrite,
}

/// Lays the panel over the mesh, and writes `x y z nx ny nz` of each taxel.
pub fn run(args: &DrapeArgs) -> Result<()> {
    let (mesh, file, files) = mesh(args)?;
    let named = [Some(&args.garment), args.robot.as_ref()].into_iter().flatten().map(Path::new);
    let output = Output::stream(&args.output, args.force, named.chain(files.iter().map(PathBuf::as_path)))?;
    let garment = garments::read(&args.garment)?.garment;
    let panel = garment.panels.iter().find(|panel| *panel.name == *args.panel).ok_or_else(|| {
        let known = garment.panels.iter().map(|panel| panel.name.as_str());
        Fault::usage(words::unknown("panel", &args.panel, known))
    })?;
    let drape = Drape {
        rows: panel.rows.into(),
        columns: panel.columns.into(),
        pitch: panel.pitch_um.map(|um| f64::from(um) * 1e-6),
        at: args.at,
        down: args.down,
    };
    let taxels = drape.over(&mesh).map_err(|error| anyhow!("{file}, panel {}: {error}", args.panel))?;
    let mut text = format!("# {} over {file}: x y z nx ny nz\n", args.panel);
    for (at, normal) in taxels {
        let numbers = [at.to_array(), normal.to_array()].concat();
        let numbers: Vec<String> = numbers.iter().map(|number| format!("{number:.6}")).collect();
        let _ = writeln!(text, "{}", numbers.join(" "));
    }
    Ok(output.write(text.as_bytes())?)
}

/// The mesh, what it is called, and its files.
fn mesh(args: &DrapeArgs) -> Result<(Mesh, String, Vec<PathBuf>)> {
    if let (Some(robot), Some(link)) = (&args.robot, &args.link) {
        let shape = if args.collision { LinkShape::Collision } else { LinkShape::Visual };
        let OfLink { mesh, files } = mesh::of_link(robot, link, shape, &args.package)?;
        return Ok((mesh, format!("{robot}, link {link}"), files));
    }
    ensure!(args.scale.is_finite() && args.scale > 0.0, Fault::usage("--scale must be above 0"));
    let file = args.mesh.clone().unwrap_or_default();
    let mesh = mesh::read(&file)?.placed(DVec3::splat(args.scale), &Pose::IDENTITY);
    Ok((mesh, file.display().to_string(), vec![file]))
}

/// Reads the folder of a package.
fn package(text: &str) -> Result<(String, PathBuf), String> {
    match text.split_once('=') {
        Some((name, folder)) if !name.is_empty() && !folder.is_empty() => Ok((name.into(), folder.into())),
        _ => Err("write NAME=DIR".into()),
    }
}

/// Reads three numbers with commas between them.
fn vector(text: &str) -> Result<DVec3, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|number| number.trim().parse()).collect();
    match numbers.as_deref() {
        Ok([x, y, z]) if [x, y, z].iter().all(|number| number.is_finite()) => Ok(DVec3::new(*x, *y, *z)),
        _ => Err("write three numbers: 0.06,0,0.2".into()),
    }
}
