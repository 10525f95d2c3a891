//! The table of bounds in `docs/evidence/bounds.md`: what it says is what the tests assert.

const TABLE: &str = include_str!("../../../../docs/evidence/bounds.md");

/// Largest error of a quantity.
#[derive(Debug, Clone, Copy)]
pub struct Bound {
    /// In the unit of the quantity.
    pub absolute: f64,
    /// Times the value.
    pub relative: f64,
}

impl Bound {
    /// The bound at that value.
    pub fn at(self, value: f64) -> f64 {
        self.absolute + self.relative * value.abs()
    }
}

/// Those of the first table.
fn rows() -> impl Iterator<Item = Vec<&'static str>> {
    let cells = |line: &'static str| line.trim_matches('|').split('|').map(str::trim).collect::<Vec<_>>();
    let is_row = |line: &&str| line.starts_with('|');
    TABLE.lines().skip_while(move |line| !is_row(line)).take_while(is_row).map(cells).skip(2)
}

/// `0.5`, `1.3e-6`, `2^-25` or `2^-16 + 1e-8`.
fn number(cell: &str) -> f64 {
    let term = |term: &str| match term.trim().strip_prefix("2^") {
        Some(power) => 2f64.powi(power.parse().expect("a whole power of two")),
        None => {
            term.trim().parse().unwrap_or_else(|_| panic!("docs/evidence/bounds.md: {term} is no number"))
        }
    };
    cell.split('+').map(term).sum()
}

/// What the table says of a quantity, to be asserted by `test`.
pub fn bound(quantity: &str, test: &str) -> Bound {
    let row = rows().find(|row| row[0] == quantity).unwrap_or_else(|| panic!("no row {quantity}"));
    assert_eq!(row[7].trim_matches('`'), test, "the test that the row of {quantity} names");
    Bound { absolute: number(row[5]), relative: number(row[6]) }
}

#[test]
fn every_row_is_whole() {
    let mut count = 0;
    for row in rows() {
        assert_eq!(row.len(), 8, "{row:?}");
        let Bound { absolute, relative } = bound(row[0], row[7].trim_matches('`'));
        assert!(absolute >= 0.0 && relative >= 0.0, "{row:?}");
        count += 1;
    }
    assert!(count > 10, "{count} rows");
}
