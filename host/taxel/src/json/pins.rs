//! Lines and inputs found faulty by a self-test: their place, and the consequence for the garment.

use serde::Serialize;
use taxel_core::garment::{Coding, Garment, Group};
use taxel_core::selftest::{Fault, Findings, PinFault};

/// Result of a self-test.
#[derive(Debug, Clone, Serialize)]
pub struct PinReport {
    /// Select lines that were examined.
    pub lines: u8,
    /// Converter inputs that were examined.
    pub inputs: u8,
    /// The faults.
    pub faults: Vec<PinFaultReport>,
}

/// A fault, for people.
#[derive(Debug, Clone, Serialize)]
pub struct PinFaultReport {
    /// GPIO number.
    pub gpio: u8,
    /// The fault.
    pub what: String,
    /// Use of the pin.
    #[serde(rename = "where")]
    pub place: String,
    /// The consequence for the garment.
    pub means: String,
}

/// Reports a self-test; none without one.
pub fn report(garment: &Garment, findings: Option<&Findings>) -> Option<PinReport> {
    let fault = |found: &PinFault| PinFaultReport {
        gpio: found.pin,
        what: found.fault.to_string(),
        place: place(garment, found.pin),
        means: meaning(garment, found),
    };
    findings.map(|findings| PinReport {
        lines: findings.lines,
        inputs: findings.inputs,
        faults: findings.faults.iter().map(fault).collect(),
    })
}

/// A line for each fault, or one that says that there is none.
pub fn table(garment: &Garment, findings: Option<&Findings>) -> String {
    let Some(findings) = findings else {
        return format!("{}: the board has not tested its lines and inputs yet.\n", garment.name);
    };
    if findings.faults.is_empty() {
        let Findings { lines, inputs, .. } = findings;
        return format!("{}: no faults on {lines} select lines and {inputs} inputs.\n", garment.name);
    }
    let line = |found: &PinFault| {
        let (place, meaning) = (place(garment, found.pin), meaning(garment, found));
        format!("GPIO {} ({place}) {}: {meaning}\n", found.pin, found.fault)
    };
    findings.faults.iter().map(line).collect()
}

/// Groups of select lines: what they select, and their lines.
fn groups(garment: &Garment) -> [(&'static str, &Group); 3] {
    let wiring = &garment.wiring;
    [("block", &wiring.block), ("row", &wiring.row), ("column", &wiring.column)]
}

/// Group of a select line, and its bit in it.
fn line(garment: &Garment, pin: u8) -> Option<(&'static str, usize, Coding)> {
    groups(garment).into_iter().find_map(|(name, group)| {
        let bit = group.lines.iter().position(|line| line.pin == pin)?;
        Some((name, bit, group.coding))
    })
}

fn place(garment: &Garment, pin: u8) -> String {
    match line(garment, pin) {
        Some((name, bit, Coding::Binary)) => format!("{name} line, bit {bit}"),
        Some((name, bit, Coding::OneHot)) => format!("line of {name} {bit}"),
        None if garment.wiring.enable.iter().any(|line| line.pin == pin) => "enable line".into(),
        None => format!("input of {}", panels(garment, pin)),
    }
}

/// Names of the panels read by an input.
fn panels(garment: &Garment, pin: u8) -> String {
    let read = |panel: usize| garment.blocks.iter().any(|b| usize::from(b.panel) == panel && b.input == pin);
    let names: Vec<&str> =
        (0..).zip(&garment.panels).filter(|(i, _)| read(*i)).map(|(_, panel)| panel.name.as_str()).collect();
    names.join(", ")
}

fn meaning(garment: &Garment, found: &PinFault) -> String {
    match found.fault {
        Fault::StuckHigh | Fault::StuckLow => match line(garment, found.pin) {
            Some((name, bit, Coding::Binary)) => {
                format!("of two {name}s that differ only in bit {bit}, one is read twice, the other never")
            }
            Some((name, bit, Coding::OneHot)) => format!("{name} {bit} is always chosen, or never"),
            None => "the multiplexers are always enabled, or never".into(),
        },
        Fault::Bridged(other) => format!(
            "the two cannot be distinguished; whatever distinguishes it from GPIO {other} ({}) is misread",
            place(garment, other)
        ),
        Fault::Open => "nothing is connected to it: its codes are not pressure".into(),
        Fault::Grounded => "its wire touches ground: nothing is read there".into(),
        Fault::Supplied => "its wire touches the supply: nothing is read there".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn findings(faults: &[(u8, Fault)]) -> Findings {
        let faults = faults.iter().map(|(pin, fault)| PinFault { pin: *pin, fault: *fault }).collect();
        Findings { lines: 9, inputs: 4, faults }
    }

    #[test]
    fn a_fault_is_named_by_pin_and_by_what_it_does() {
        let garment = Garment::reference();
        let found = findings(&[(8, Fault::StuckHigh), (2, Fault::Bridged(3)), (27, Fault::Open)]);
        let text = table(&garment, Some(&found));
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(
            lines[0],
            "GPIO 8 (row line, bit 1) stuck high: of two rows that differ only in bit 1, one is read twice, the \
             other never"
        );
        assert!(lines[1].starts_with("GPIO 2 (block line, bit 0) bridged to GPIO 3: "), "{}", lines[1]);
        assert!(lines[1].ends_with("GPIO 3 (block line, bit 1) is misread"), "{}", lines[1]);
        assert!(lines[2].starts_with("GPIO 27 (input of back) open: "), "{}", lines[2]);
        assert_eq!(report(&garment, Some(&found)).unwrap().faults[2].gpio, 27);
        assert_eq!(
            table(&garment, Some(&findings(&[]))),
            "reference: no faults on 9 select lines and 4 inputs.\n"
        );
        assert!(table(&garment, None).contains("has not tested"));
    }
}
