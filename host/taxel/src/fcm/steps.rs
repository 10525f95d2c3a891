//! Converts numbers of a map file to the core's decimal steps.

use super::decimal::Decimal;
use crate::error::{MapFileError, Result};

/// `value` in steps of 10^-`decimals`; error if it is not a whole number of steps.
pub fn decimal(value: f64, decimals: u32, field: &str) -> Result<i128> {
    let exact = Decimal::from_f64(value).filter(|d| d.decimals <= decimals);
    let exact = exact.ok_or_else(|| {
        error!(MapFileError::Range, "{field} = {value} is not a number of at most {decimals} decimals")
    })?;
    Ok(exact.scaled(10i128.pow(decimals)))
}

/// A value in -1 ..= 1 in steps of 10^-`decimals`. The range is checked here because i16 ends at 3.2767.
pub fn steps(value: f64, decimals: u32, field: impl Fn() -> String) -> Result<i16> {
    if value.abs() > 1.0 {
        fail!(MapFileError::Range, "{} = {value} is outside [-1, 1]", field());
    }
    let all = decimal(value, 4, &field())?;
    Ok((all / 10i128.pow(4 - decimals)) as i16)
}
