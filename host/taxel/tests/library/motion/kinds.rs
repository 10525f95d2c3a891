//! Each behaviour by its row, and the speed of the robot's own motion.

use super::rig::{LIFTED, Rig};
use taxel::motion::MotionDeed;
use taxel_core::intent::Leading;

#[test]
fn the_first_row_that_fits_counts() {
    let behaviour = "name = \"x\"\nresume.after_s = 0.1\nresume.over_s = 0.2\n\
        [[when]]\npart = [\"forearm\"]\nmeaning = \"threat\"\ndo = \"stop\"\n\
        [[when]]\npart = [\"forearm\"]\nnewtons = 10\ndo = \"slow\"\nfactor = 0.2\n\
        [[when]]\npart = [\"forearm\"]\ndo = \"slow\"\nfactor = 0.6\n\
        [[when]]\npart = [\"torso\"]\ndo = \"ignore\"\n";
    let mut rig = Rig::armed(behaviour, &LIFTED);
    let forearm =
        |rig: &Rig, newtons| rig.touch(1, "left_forearm", [0.03, 0.0, -0.1], [1.0, 0.0, 0.0], newtons);
    rig.touches = vec![rig.touch(1, "torso", [0.06, 0.0, 0.2], [1.0, 0.0, 0.0], 30.0)];
    let command = rig.cycle();
    assert_eq!((command.deed, command.speed, command.causes.len()), (MotionDeed::Free, Some(1.0), 0));
    rig.touches = vec![forearm(&rig, 5.0)];
    assert_eq!((rig.cycle().speed, rig.cycle().causes[0].row), (Some(0.6), Some(2)));
    rig.touches = vec![forearm(&rig, 12.0)];
    assert_eq!((rig.cycle().speed, rig.cycle().causes[0].row), (Some(0.2), Some(1)));
    rig.leading = Leading::Threat;
    assert_eq!((rig.cycle().deed, rig.cycle().speed), (MotionDeed::Stop, Some(0.0)));
    // Back at full speed after a tenth of a second, within a fifth.
    (rig.touches, rig.leading) = (Vec::new(), Leading::None);
    assert_eq!(rig.run(0.095).speed, Some(0.0));
    let half = rig.run(0.1).speed.unwrap();
    assert!((half - 0.5).abs() < 0.06, "{half}");
    assert_eq!((rig.run(0.15).deed, rig.cycle().speed), (MotionDeed::Free, Some(1.0)));
}
