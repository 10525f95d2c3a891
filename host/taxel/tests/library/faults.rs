//! Faults of lines and inputs, and the self-test of the simulated board; shared by the targets that test
//! health.

use taxel::sim::{PINS, Script, SimBoard};
use taxel_core::acquire::MuxScan;
use taxel_core::garment::{Circuit, Garment, Layout, Pins};
use taxel_core::selftest::{Examine, Fault, Findings, PinFault};

/// Findings of a self-test of the simulated board.
pub fn examine(garment: &Garment, script: &Script) -> Findings {
    let layout = Layout::build(garment, 2048, 4095).unwrap();
    let circuit = Circuit::build(garment, &layout, Pins::ANY).unwrap();
    let SimBoard { mut lines, delay, adc, clock, .. } = SimBoard::new(garment, script, script.seed).unwrap();
    let mut scan = MuxScan::<_, _, _, _, PINS, 2048>::new(&mut lines, delay, adc, clock.clone());
    let findings = scan.examine(&circuit).unwrap();
    assert!(clock.now_ns() < 12_000_000, "{} ns", clock.now_ns());
    findings
}

/// Every fault of one line or input of a garment; bridges are to the next line.
pub fn pin_faults(garment: &Garment) -> Vec<PinFault> {
    let wiring = &garment.wiring;
    let groups = [&wiring.block, &wiring.row, &wiring.column];
    let lines: Vec<u8> = groups.iter().flat_map(|group| &group.lines).map(|line| line.pin).collect();
    let mut faults: Vec<PinFault> =
        lines.windows(2).map(|pair| PinFault { pin: pair[0], fault: Fault::Bridged(pair[1]) }).collect();
    for pin in lines {
        faults.extend([Fault::StuckHigh, Fault::StuckLow].map(|fault| PinFault { pin, fault }));
    }
    for pin in 26..30 {
        faults.extend([Fault::Open, Fault::Grounded, Fault::Supplied].map(|fault| PinFault { pin, fault }));
    }
    faults
}
