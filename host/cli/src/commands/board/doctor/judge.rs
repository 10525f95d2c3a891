//! Judges the facts.

use super::facts::Facts;
use super::finding::Finding;
use taxel::json::pins;
use taxel::text::date::days_between;
use taxel::text::starts;
use taxel_core::boot::{Aside, Boot};
use taxel_core::wire::Health;

/// Share of taxels that may be faulty before the garment counts as faulty.
const FAULTY_SHARE: f64 = 0.05;
/// Days after which a calibration is old.
const OLD: u64 = 180;
/// Tolerated uncertainty of the host's time, us.
const CLOCK_US: u64 = 5_000;

/// Frame rate from which a blow of 20 ms is seen in two frames, so that its rise is seen.
const RESOLVING: f64 = 100.0;

/// Returns all findings, given the host's version and today's date (year-month-day).
pub fn judge(facts: &Facts, version: &str, today: &str) -> Vec<Finding> {
    let Some(firmware) = &facts.firmware else {
        let what = facts.unusable.clone().unwrap_or_else(|| "no Hello of a board came".into());
        return vec![Finding::bad(
            "link",
            what,
            "flash the firmware of this version: `cargo xtask firmware`, then `taxel flash`",
        )];
    };
    let mut found = Vec::new();
    if facts.simulated {
        found.push(Finding::weak(
            "link",
            "this is a simulated board",
            "`taxel ports` lists what is plugged in",
        ));
    }
    found.push(match firmware.split(' ').nth(1) == Some(version) {
        true => Finding::good("version", firmware.clone()),
        false => Finding::weak(
            "version",
            format!("the board runs {firmware}, this program is {version}"),
            "flash the firmware of this version: `cargo xtask firmware`, then `taxel flash`",
        ),
    });
    found.extend(facts.boot.as_ref().map(start));
    found.push(link(facts));
    found.push(rate(facts));
    found.extend(facts.health.map(|[first, last]| scans(&first, &last)));
    found.push(taxels(facts));
    found.extend(facts.clock_us.map(clock));
    found.push(calibration(&facts.calibration, today));
    found.extend(self_test(facts));
    let reported = |text: &String| Finding::weak("board", text.clone(), "see docs/guides/troubleshooting.md");
    found.extend(facts.logged.iter().map(reported));
    found
}

fn start(boot: &Boot) -> Finding {
    let cause = format!("started by: {}", starts::cause(boot));
    let resets = match boot.resets {
        0 => String::new(),
        resets => format!("; {resets} resets without running for a minute"),
    };
    let what = match starts::aside(boot) {
        Some(why) => {
            format!("{cause}{resets}; it runs the shipped settings and keeps the saved ones aside: {why}")
        }
        None => format!("{cause}{resets}"),
    };
    match boot.aside {
        Aside::Resets => Finding::bad(
            "start",
            what,
            "set garment and scene anew and `taxel save`; a power-up tries what was saved once more; `taxel \
             reset-settings` leaves it aside",
        ),
        Aside::Pin => Finding::weak(
            "start",
            what,
            "take the wire off the pin; `taxel save` replaces what was saved, a power-up uses it again",
        ),
        Aside::Request => Finding::weak(
            "start",
            what,
            "`taxel save` replaces what was saved, `taxel reset-settings --undo` uses it again",
        ),
        Aside::No if starts::is_fault(boot) => Finding::weak(
            "start",
            what,
            "supply and wires first; then report it with the garment and the scene that were in force",
        ),
        Aside::No => Finding::good("start", what),
    }
}

fn link(facts: &Facts) -> Finding {
    let [lost, refused] = facts.lost;
    if lost + refused > 0 {
        let what = format!("{lost} messages lost, {refused} frames damaged");
        return Finding::bad(
            "link",
            what,
            "shorter or better cable; over a UART check the ground wire and the speed",
        );
    }
    Finding::good("link", "nothing lost, nothing damaged")
}

fn rate(facts: &Facts) -> Finding {
    let Some([(first, from), (last, to)]) = facts.frames.filter(|[first, last]| last.1 > first.1) else {
        return Finding::bad(
            "images",
            "no images came",
            "the scene may send none (`stream.frames_hz`), or the scan fails",
        );
    };
    let scans = f64::from(last.wrapping_sub(first)) / ((to - from) as f64 / 1e6);
    let [images, thinned, undecoded] = facts.images;
    let what = format!("{scans:.1} frames/s scanned; {images} images came, {thinned} were left out");
    if undecoded > 0 {
        let what = format!("{what}, {undecoded} could not be decoded");
        return Finding::bad("images", what, "a better cable, then report it");
    }
    if scans < RESOLVING {
        let shortest = 2000.0 / scans;
        return Finding::weak(
            "images",
            format!("{what}; a touch shorter than {shortest:.0} ms, as a slap or a lash, may be missed"),
            "a higher `rate_hz`, a plainer `plan.depth`, or a shorter `settle_ns`",
        );
    }
    Finding::good("images", what)
}

fn scans(first: &Health, last: &Health) -> Finding {
    let more = |of: fn(&Health) -> u32| of(last).wrapping_sub(of(first));
    let (failed, overruns, lost) = (more(|h| h.failed), more(|h| h.overruns), more(|h| h.lost));
    let what = format!(
        "a scan takes {} us, perception {} us; {failed} scans failed, {overruns} overrun, {lost} messages without room",
        last.scan_us, last.process_us
    );
    if failed > 0 {
        return Finding::bad(
            "scan",
            what,
            "check pins and converter inputs: `taxel config check`, `taxel setup`",
        );
    }
    if overruns + lost > 0 {
        return Finding::weak("scan", what, "a scene with fewer stages, or a lower `rate_hz`");
    }
    Finding::good("scan", what)
}

fn taxels(facts: &Facts) -> Finding {
    let what = format!("{} of {} taxels are faulty", facts.faulty, facts.taxels);
    match facts.faulty {
        0 => Finding::good("taxels", what),
        faulty if (faulty as f64) < FAULTY_SHARE * facts.taxels as f64 => {
            Finding::weak("taxels", what, "`taxel health` lists them; the filter bridges single ones")
        }
        _ => {
            Finding::bad("taxels", what, "`taxel health` lists them: a whole row, column or block is a wire")
        }
    }
}

fn clock(uncertainty_us: u64) -> Finding {
    let what = format!("the host's time of a frame is within {uncertainty_us} us");
    match uncertainty_us <= CLOCK_US {
        true => Finding::good("clock", what),
        false => {
            Finding::weak("clock", what, "a hub or a busy host delays the link: plug the board in directly")
        }
    }
}

fn calibration(reported: &str, today: &str) -> Finding {
    if reported.is_empty() {
        return Finding::weak(
            "calibration",
            "none: pressure is in counts",
            "`taxel calibrate`, if forces are wanted",
        );
    }
    let days = reported.split(", ").nth(1).and_then(|date| days_between(date, today));
    match days {
        Some(days) if days > OLD => Finding::weak(
            "calibration",
            format!("{reported}: {days} days old"),
            "`taxel calibrate check FILE` checks whether it still holds",
        ),
        _ => Finding::good("calibration", reported),
    }
}

fn self_test(facts: &Facts) -> Option<Finding> {
    if let Some((garment, findings)) = &facts.pins {
        let lines = pins::table(garment, Some(findings));
        let what = lines.lines().collect::<Vec<_>>().join("; ");
        return Some(match findings.faults.is_empty() {
            true => Finding::good("self-test", what),
            false => Finding::bad(
                "self-test",
                what,
                "mend these wires and solder joints with the power off, then `taxel health --self-test`",
            ),
        });
    }
    facts.self_test.as_ref().map(|answer| match answer {
        Ok(()) => Finding::good("self-test", "passed"),
        Err(why) => Finding::weak(
            "self-test",
            format!("not done: {why}"),
            "with nothing else under way: `taxel health --self-test`",
        ),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::board::doctor::Grade;
    use taxel_core::boot::BootCause;
    use taxel_core::garment::Garment;
    use taxel_core::selftest::{Fault, Findings, PinFault};

    fn examined(faults: &[PinFault]) -> Option<(Garment, Findings)> {
        let faults = faults.iter().copied().collect();
        Some((Garment::reference(), Findings { lines: 9, inputs: 4, faults }))
    }

    fn boot(cause: BootCause, aside: Aside) -> Option<Boot> {
        Some(Boot { cause, resets: 3, aside })
    }

    fn well() -> Facts {
        Facts {
            firmware: Some("taxel-rp2040 0.1.0".into()),
            taxels: 2048,
            boot: Some(Boot::default()),
            calibration: "id 3fa9c21b, 2026-11-21, 1.25 %".into(),
            frames: Some([(1, 1_000_000), (196, 2_000_000)]),
            images: [195, 0, 0],
            health: Some([Health::default(); 2]),
            clock_us: Some(400),
            self_test: Some(Ok(())),
            pins: examined(&[]),
            ..Facts::default()
        }
    }

    fn grade(facts: &Facts, of: &str) -> Grade {
        let found = judge(facts, "0.1.0", "2026-12-01");
        found.iter().filter(|finding| finding.of == of).map(|finding| finding.grade).max().unwrap()
    }

    #[test]
    fn a_board_that_is_well_has_only_good_findings() {
        let found = judge(&well(), "0.1.0", "2026-12-01");
        assert!(
            found.iter().all(|finding| finding.grade == Grade::Good && finding.cure.is_empty()),
            "{found:?}"
        );
        assert!(found.iter().any(|finding| finding.what.starts_with("195.0 frames/s")), "{found:?}");
    }

    #[test]
    fn each_fault_is_graded_and_has_a_cure() {
        let failed = Health { failed: 2, ..Health::default() };
        let overrun = Health { overruns: 1, ..Health::default() };
        let stuck = PinFault { pin: 8, fault: Fault::StuckHigh };
        let cases = [
            (Facts { firmware: None, ..well() }, "link", Grade::Bad),
            (Facts { lost: [1, 0], ..well() }, "link", Grade::Bad),
            (Facts { simulated: true, ..well() }, "link", Grade::Weak),
            (Facts { firmware: Some("taxel-rp2040 0.0.9".into()), ..well() }, "version", Grade::Weak),
            (Facts { boot: boot(BootCause::Watchdog, Aside::No), ..well() }, "start", Grade::Weak),
            (Facts { boot: boot(BootCause::Panic, Aside::Resets), ..well() }, "start", Grade::Bad),
            (Facts { boot: boot(BootCause::Power, Aside::Pin), ..well() }, "start", Grade::Weak),
            (Facts { boot: boot(BootCause::Request, Aside::Request), ..well() }, "start", Grade::Weak),
            (Facts { boot: boot(BootCause::Other, Aside::No), ..well() }, "start", Grade::Good),
            (Facts { frames: None, ..well() }, "images", Grade::Bad),
            (Facts { images: [9, 0, 1], ..well() }, "images", Grade::Bad),
            (Facts { frames: Some([(1, 0), (26, 1_000_000)]), ..well() }, "images", Grade::Weak),
            (Facts { health: Some([Health::default(), failed]), ..well() }, "scan", Grade::Bad),
            (Facts { health: Some([Health::default(), overrun]), ..well() }, "scan", Grade::Weak),
            (Facts { faulty: 1, ..well() }, "taxels", Grade::Weak),
            (Facts { faulty: 512, ..well() }, "taxels", Grade::Bad),
            (Facts { clock_us: Some(50_000), ..well() }, "clock", Grade::Weak),
            (Facts { calibration: String::new(), ..well() }, "calibration", Grade::Weak),
            (Facts { calibration: "id 0, 2025-11-21, 1 %".into(), ..well() }, "calibration", Grade::Weak),
            (Facts { pins: examined(&[stuck]), ..well() }, "self-test", Grade::Bad),
            (Facts { pins: None, self_test: Some(Err("busy".into())), ..well() }, "self-test", Grade::Weak),
            (Facts { logged: vec!["scan: no signal".into()], ..well() }, "board", Grade::Weak),
        ];
        for (facts, of, want) in cases {
            assert_eq!(grade(&facts, of), want, "{of}: {facts:?}");
            let found = judge(&facts, "0.1.0", "2026-12-01");
            assert!(found.iter().all(|finding| (finding.grade == Grade::Good) == finding.cure.is_empty()));
        }
    }
}
