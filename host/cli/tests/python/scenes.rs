//! Every scene, frame by frame.

use super::read;
use super::stage::{Seen, file, plan, record};
use serde_json::{Value, json};
use taxel::sim;
use taxel_core::garment::Garment;

const PANELS: [&str; 4] = ["chest", "back", "left arm", "right arm"];

/// CRC-32 of a panel's images, one after the other, 16 bits per taxel.
fn sums(seen: &Seen, rename: fn(&str) -> String) -> Value {
    let sum = |panel: usize| {
        let bytes = seen.frames.iter().flat_map(|(_, _, image)| &image[512 * panel..][..512]);
        crc32fast::hash(&bytes.flat_map(|value| value.to_le_bytes()).collect::<Vec<u8>>())
    };
    PANELS.iter().enumerate().map(|(index, name)| (rename(name), json!(sum(index)))).collect()
}

#[test]
fn python_reads_every_scene_bit_for_bit() {
    for scene in sim::list() {
        let name = format!("python-{}.mcap", scene.name);
        let seen = record(&format!("sim:{}", scene.name), plan(&name, "sim", None, true));
        let found = read("mcap", &file(&name));
        assert_eq!(found["panels"], sums(&seen, |panel| panel.into()), "{name}");
        assert_eq!(found["wire"], json!(crc32fast::hash(&seen.wire)), "{name}");
        assert_eq!(found["counts"]["/taxel/frames"], json!(seen.frames.len()), "{name}");
        assert_eq!(found["metadata"]["taxel"]["garment"], "reference", "{name}");
        assert!(found["attachments"]["garment.toml"].as_u64().unwrap() > 1000, "{name}");
        let ros2 = read("ros2", &file(&name).with_extension("ros2.mcap"));
        let topic = |panel: &str| panel.replace(' ', "_");
        let counts: u64 =
            seen.frames.iter().flat_map(|(_, _, image)| image).map(|value| u64::from(*value)).sum();
        for reader in ["mcap_ros2", "rosbags"] {
            let found = &ros2[reader];
            assert_eq!(found["images"], sums(&seen, topic), "{name}, {reader}");
            assert_eq!(found["points"], sums(&seen, topic), "{name}, {reader}");
            for (panel, name) in Garment::reference().panels.iter().zip(PANELS) {
                assert_eq!(found["pitch_um"][topic(name)], json!(panel.pitch_um), "{name}, {reader}");
            }
            let newtons = found["newtons"].as_f64().unwrap();
            assert!(
                (newtons - counts as f64 / 1000.0).abs() < 1e-6 * (1.0 + newtons),
                "{name}, {reader}: {newtons}"
            );
            assert!(found["counts"]["/diagnostics"].as_u64().unwrap() > 0, "{name}, {reader}");
        }
    }
    println!("Python's mcap, mcap-ros2-support and rosbags read {} scenes bit for bit", sim::list().len());
}

#[test]
fn rerun_reads_a_scene_bit_for_bit() {
    let seen = record("sim:pat", plan("rerun.mcap", "sim", None, true));
    let found = read("rerun", &file("rerun.mcap"));
    assert_eq!(found["counts"]["/taxel/frames"], json!(seen.frames.len()));
    assert_eq!(found["panels"], sums(&seen, |panel| panel.into()));
    let ros2 = read("rerun", &file("rerun.ros2.mcap"));
    assert_eq!(ros2["images"], sums(&seen, |panel| panel.replace(' ', "_")));
    println!("Rerun's reader finds a recording's images as images, and ROS 2's as depth images, bit for bit");
}
