//! Examples under the help of each subcommand, and the exit status.

pub(super) const TAXEL: &str = "Examples:
  taxel
  taxel live --source sim:lash
  taxel config touches

Exit status:
  0  done
  1  failed: a file, the disk, a result that is not good enough
  2  wrong use: another command line is needed
  3  the board is at fault: no answer, a refusal, faulty lines or taxels";

pub(super) const LIVE: &str = "Examples:
  taxel live
  taxel live sim:lash --frames 200 --json
  taxel live /dev/ttyACM0
  taxel live touch.mcap
  taxel live touch.mcap@0.25
  taxel live robot.toml --json
  taxel live robot.toml#hand";

pub(super) const VIEW: &str = "Examples:
  taxel view --open
  taxel view --source sim:five
  taxel view walk.mcap --open
  taxel view robot.toml --open
  taxel view --source sim:five --body reference --robot reference --open
  taxel view --source serial:/dev/ttyACM0 --garment block-4x16 --tare 32";

pub(super) const FOXGLOVE: &str = if cfg!(feature = "foxglove") { SERVED } else { NO_FOXGLOVE };

/// The example of a build without the feature.
const NO_FOXGLOVE: &str = "Example, in the folder of taxel:
  cargo run --release --features foxglove -- foxglove --source sim:pat";

const SERVED: &str = "Examples:
  taxel foxglove --source sim:pat
  taxel foxglove --source serial:/dev/ttyACM0 --garment block-4x16 --tare 32";

pub(super) const ROS2: &str = if cfg!(feature = "ros2") { NODE } else { NO_ROS2 };

/// The example of a build without the feature.
const NO_ROS2: &str = "Example, in the folder of taxel:
  cargo run --release --features ros2 -- ros2 --source sim:pat";

const NODE: &str = "Examples:
  taxel ros2 --source sim:pat
  taxel ros2 --source serial:/dev/ttyACM0 --garment block-4x16 --tare 32 --namespace /left
  taxel ros2 --source sim:five --body reference --robot reference";

pub(super) const SERVE: &str = if cfg!(feature = "zenoh") { OFFERED } else { NO_SERVE };

/// The example of a build without the feature.
const NO_SERVE: &str = "Example, in the folder of taxel:
  cargo run --release --features zenoh -- serve --source sim:pat --name arm/left";

const OFFERED: &str = "Examples:
  taxel serve --source sim:pat --name arm/left
  taxel serve --source usb --name arm/left --zenoh router.json5
  taxel live --source zenoh:arm/left@router.json5";

pub(super) const RECORD: &str = "Examples:
  taxel record -o touch.mcap
  taxel record --source sim:pat -o pat.mcap --ros2
  taxel record -o day.mcap --rotate 10min
  taxel record -o touch.mcap --view --open";

pub(super) const INFO: &str = "Examples:
  taxel info touch.mcap
  taxel info touch.mcap --repair";

pub(super) const EXPORT: &str = "Examples:
  taxel export touch.mcap --to npz -o touch.npz
  taxel export touch.mcap --to csv --touched -o touch.csv
  taxel export touch.mcap --to png -o images";

pub(super) const REPORT: &str = "Examples:
  taxel report touch.mcap -o report.html
  taxel report --source sim:source -o source.html";

pub(super) const PROCESS: &str = "Examples:
  taxel process subject_01.npz --array posture_03 --rate 1 --json
  taxel process frames.npy --full-scale 1000 --tare 16";

pub(super) const FEATURES: &str = "Examples:
  taxel features image.npy
  taxel features subject_01.npz --array posture_03 --frame 20 --json";

pub(super) const FCM: &str = "Examples:
  taxel fcm map.json --rule mkosko --transfer sigmoid --lambda 1 --steps 50 --json
  taxel fcm tactile --input press=0.8 --input time=0.1
  taxel fcm why tactile --input press=0.8 --input time=0.1 --set shape=1
  taxel fcm why --source sim:lash
  taxel fcm check my-map.toml
  taxel fcm combine anna.toml ben.toml carla.toml -o ours.toml
  taxel fcm draw tactile --input shape=1 -o tactile.dot";

pub(super) const GESTURES: &str = "Examples:
  taxel gestures eval --frames train.npz --labels train.csv --cross participant --json
  taxel gestures train --frames train.npz --labels train.csv -o my.model
  taxel gestures eval --model my.model --frames test.npz --labels test.csv";

pub(super) const INTENT: &str = "Examples:
  taxel intent eval --frames frames.npz --labels labels.csv --cross day --json
  taxel intent train --frames frames.npz --labels labels.csv -o my.model";

pub(super) const SETUP: &str = "Examples:
  taxel setup --garment reference -o garment.toml
  taxel setup --source serial:/dev/ttyACM0 --garment mine.toml -o garment.toml
  taxel setup --simulate 7 --json";

pub(super) const CALIBRATE: &str = "Examples:
  taxel calibrate --simulate 7
  taxel calibrate --source usb --over block --weights 0.5,1,2,5,10 --kg --by Anna --save -o anna.toml
  taxel calibrate check anna.toml
  taxel calibrate settle --garment garment.toml -o settled.toml";

pub(super) const HEALTH: &str = "Examples:
  taxel health
  taxel health --source sim:press
  taxel health --source serial:/dev/ttyACM0 --tare 32 --json";

pub(super) const SAVE: &str = "Examples:
  taxel save
  taxel save --source serial:/dev/ttyACM0 --garment block-4x16 --tare 32";

pub(super) const RESET_SETTINGS: &str = "Examples:
  taxel reset-settings
  taxel reset-settings --source usb --undo";

pub(super) const SHAPES: &str = "Examples:
  taxel shapes list
  taxel shapes learn mug -o mine.json
  taxel live --shapes mine.json
  taxel shapes train --images images.npz --labels labels.csv -o objects.json
  taxel shapes eval --images images.npz --labels labels.csv --cross 5 --json
  taxel shapes eval --images shapes.npz --set 32x64_C_n3 --classes three
  taxel shapes card objects";

pub(super) const DOCTOR: &str = "Examples:
  taxel doctor
  taxel doctor --source serial:/dev/ttyACM0 --seconds 20 --json";

pub(super) const PORTS: &str = "Examples:
  taxel ports
  taxel ports --json";

pub(super) const FLASH: &str = "Examples:
  taxel flash taxel.uf2
  taxel flash taxel.elf";

pub(super) const CONFIG: &str = "Examples:
  taxel config new mine.toml --like block-4x16
  taxel config check mine.toml --scene scene.toml
  taxel config schema
  taxel config touches";

pub(super) const BODY: &str = "Examples:
  taxel body check reference
  taxel body check mine.body.toml --garment mine.toml --json
  taxel body show reference -o body.svg
  taxel body places reference -o places.csv
  taxel body places reference --robot reference --joints left_elbow=30deg --frame base -o places.csv
  taxel body drape torso.stl --scale 0.001 --panel chest --at 0.06,0,0.2 -o chest.txt
  taxel body fit reference --marks marks.txt -o worn.toml";

pub(super) const COMPLETIONS: &str = "Examples:
  taxel completions bash > ~/.local/share/bash-completion/completions/taxel
  taxel completions zsh > ~/.zfunc/_taxel
  taxel completions fish > ~/.config/fish/completions/taxel.fish";
