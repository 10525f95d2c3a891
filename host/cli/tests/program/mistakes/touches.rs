//! The keys of a script of touches.

use super::keys;
use taxel::files::scripts;
use taxel_cli::commands::garment::config::FileKind;

/// A script with every key.
const BASE: &str = r#"
name = "all"
title = "all keys"
description = "Every key of a script."
duration_s = 2
garment = "reference"
seed = 7
tare_frames = 8
scene = {}

[idle]
base_code = 90
spread_counts = 10
noise_counts = 3
drift_counts_per_s = 1

[faults]
from_s = 0.5
dead = [1]
dead_count = 1
open = [2]
shorted = [3]
stuck = [{ taxel = 4, code = 100 }]
noisy = [{ taxel = 5, counts = 40 }]
pins = [{ pin = 9, fault = { bridged = 10 } }]

[wiring]
source_kohm = 3
line_pf = 80
crosstalk = 0.01
passive = false

[sensor]
gain_spread = 0.1
hysteresis = 0.03
noise = 0.02
half_n = 5

[converter]
dnl = true
noise_counts = 1

[[touch]]
panel = "back"
shape = "palm"
force_n = 8
at = [7.5, 11]
size_mm = [100, 85]
angle_deg = 20
start_s = 0.2
rise_s = 0.06
hold_s = 0.08
fall_s = 0.06
levels = [0.5, 1]
velocity = [1, 0]
repeat = 2
period_s = 0.5

[[touch]]
panel = "back"
shape = "finger"
force_n = 3
at_mm = [40, 50]
start_s = 0.3

[[trace]]
panel = "back"
shape = "palm"
size_mm = 80
angle_deg = 20
path = [[0.2, 7.5, 11, 0], [0.3, 7.5, 12, 8]]

[[joint]]
name = "left_elbow"
from_deg = 0
to_deg = 90
start_s = 0.2
rise_s = 0.5
hold_s = 0.1
fall_s = 0.5
"#;

#[test]
fn the_schema_has_the_keys_of_a_script_and_no_others() {
    keys::assert_all(&scripts::parse(BASE, "all.toml").unwrap(), FileKind::Touches.schema());
}

/// The document explains each key of the schema.
#[test]
fn the_document_names_every_key() {
    let document = include_str!("../../../../../docs/guides/touches.md");
    for key in keys::of(FileKind::Touches.schema()) {
        let key = key.rsplit('/').next().unwrap();
        assert!(document.contains(&format!("`{key}`")) || document.contains(&format!("[{key}]")), "{key}");
    }
}
