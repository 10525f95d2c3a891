//! Time of a cycle: seven joints, sixteen contacts, told as a figure.

use super::rig::Rig;
use std::fmt::Write;
use std::sync::Arc;
use std::time::Instant;
use taxel::body::robot;

/// An arm of so many joints, 0.15 m apart, that turn about z and y in turn.
fn arm(joints: usize) -> String {
    let mut urdf = String::from("<robot name=\"arm\"><link name=\"l0\"/>");
    for number in 0..joints {
        let axis = if number % 2 == 0 { "0 0 1" } else { "0 1 0" };
        let _ = write!(
            urdf,
            "<joint name=\"j{number}\" type=\"revolute\"><parent link=\"l{number}\"/><child link=\"l{}\"/>\
             <origin xyz=\"0 0 0.15\"/><axis xyz=\"{axis}\"/>\
             <limit lower=\"-2.8\" upper=\"2.8\" effort=\"1\" velocity=\"2\"/></joint><link name=\"l{}\"/>",
            number + 1,
            number + 1
        );
    }
    urdf + "</robot>"
}

#[test]
fn a_cycle_costs_little() {
    let robot = Arc::new(robot::parse("arm.urdf", &arm(7)).unwrap());
    let joints: Vec<(String, f64)> = (0..7).map(|number| (format!("j{number}"), 0.4)).collect();
    let joints: Vec<(&str, f64)> = joints.iter().map(|(name, at)| (name.as_str(), *at)).collect();
    // All sixteen lead or are left at once.
    let behaviour = "name = \"x\"\nclamp.cosine = -1\n[[when]]\nnewtons = 20\ndo = \"retreat\"\n[[when]]\ndo = \"yield\"\n\
        [[apart]]\nlinks = [\"l6\", \"l1\"]\nmetres = 0.05\n";
    let mut rig = Rig::of(robot, behaviour, &joints);
    rig.arm().unwrap();
    let touches = (0..16u32).map(|number| {
        let newtons = if number < 8 { 30.0 } else { 5.0 };
        let link = format!("l{}", 1 + number % 7);
        rig.touch(number.into(), &link, [0.05, 0.0, 0.05], [1.0, f64::from(number) * 0.05, 0.1], newtons)
    });
    rig.touches = touches.collect();
    rig.run(0.5);
    let mut times: Vec<f64> = (0..400)
        .map(|_| {
            let begun = Instant::now();
            rig.cycle();
            begun.elapsed().as_secs_f64() * 1e6
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!("a cycle, 7 joints, 16 contacts: median {:.1} us, p99 {:.1} us", times[200], times[395]);
    // Of a build for tests on a machine with other work: 100 us are the aim of a release.
    assert!(times[200] < 2000.0, "{} us", times[200]);
}
