//! A panel laid over a mesh: the list of its taxels.

use crate::fault::Fault;
use crate::watch::Overwrite;
use anyhow::{Result, anyhow};
use clap::Args;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use taxel::body::mesh::{self, Drape};
use taxel::body::{DVec3, Pose};
use taxel::files::garments;
use taxel::files::output::Output;
use taxel::tell::words;

/// A mesh, a panel, and where its middle lies.
#[derive(Debug, Clone, Args)]
pub struct DrapeArgs {
    /// The link's mesh: an STL or OBJ file, in the link's frame
    mesh: PathBuf,
    /// The panel
    #[arg(long, value_name = "NAME")]
    panel: String,
    /// The garment that has the panel: a TOML file or a preset
    #[arg(long, value_name = "G", default_value = "reference")]
    garment: String,
    /// Metres of one unit of the mesh: 0.001 for millimetres
    #[arg(long, value_name = "M", default_value_t = 1.0)]
    scale: f64,
    /// Where the middle of the panel lies, m: the nearest point of the mesh is taken
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
    let inputs = [args.mesh.as_path(), Path::new(&args.garment)];
    let output = Output::stream(&args.output, args.force, inputs)?;
    let garment = garments::read(&args.garment)?.garment;
    let panel = garment.panels.iter().find(|panel| *panel.name == *args.panel).ok_or_else(|| {
        let known = garment.panels.iter().map(|panel| panel.name.as_str());
        Fault::usage(words::unknown("panel", &args.panel, known))
    })?;
    let mesh = mesh::read(&args.mesh)?.placed(DVec3::splat(args.scale), &Pose::IDENTITY);
    let drape = Drape {
        rows: panel.rows.into(),
        columns: panel.columns.into(),
        pitch: panel.pitch_um.map(|um| f64::from(um) * 1e-6),
        at: args.at,
        down: args.down,
    };
    let file = args.mesh.display();
    let taxels = drape.over(&mesh).map_err(|error| anyhow!("{file}, panel {}: {error}", args.panel))?;
    let mut text = format!("# {} over {file}: x y z nx ny nz\n", args.panel);
    for (at, normal) in taxels {
        let numbers = [at.to_array(), normal.to_array()].concat();
        let numbers: Vec<String> = numbers.iter().map(|number| format!("{number:.6}")).collect();
        let _ = writeln!(text, "{}", numbers.join(" "));
    }
    Ok(output.write(text.as_bytes())?)
}

/// Reads three numbers with commas between them.
fn vector(text: &str) -> Result<DVec3, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|number| number.trim().parse()).collect();
    match numbers.as_deref() {
        Ok([x, y, z]) if [x, y, z].iter().all(|number| number.is_finite()) => Ok(DVec3::new(*x, *y, *z)),
        _ => Err("write three numbers: 0.06,0,0.2".into()),
    }
}
