//! Causes of a board's start, in words.

use taxel_core::boot::{Aside, Boot, BootCause};

/// Cause of the start.
pub fn cause(boot: &Boot) -> &'static str {
    match boot.cause {
        BootCause::Power => "power-up",
        BootCause::Pin => "the reset pin",
        BootCause::Watchdog => "the watchdog: its loop hung",
        BootCause::Panic => "a panic of its program",
        BootCause::Request => "a host's request",
        BootCause::Other => "something else, as after flashing",
    }
}

/// Returns why saved settings are not in use; none if they are.
pub fn aside(boot: &Boot) -> Option<&'static str> {
    match boot.aside {
        Aside::No => None,
        Aside::Resets => Some("the board had reset itself three times without running for a minute"),
        Aside::Pin => Some("its reset-settings pin was grounded"),
        Aside::Request => Some("`taxel reset-settings` has put them aside"),
    }
}

/// True if the board reset itself.
pub fn is_fault(boot: &Boot) -> bool {
    matches!(boot.cause, BootCause::Watchdog | BootCause::Panic)
}

/// Remark on an unusual start.
pub fn remark(boot: &Boot) -> Option<String> {
    let cause = cause(boot);
    match (aside(boot), is_fault(boot)) {
        (Some(why), _) => {
            Some(format!("started ({cause}) with the shipped settings; saved ones are kept aside: {why}"))
        }
        (None, true) => Some(format!("started again ({cause})")),
        (None, false) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_start_is_remarked_where_the_board_is_not_as_it_was_left() {
        let of = |cause, aside| remark(&Boot { cause, resets: 1, aside });
        for cause in [BootCause::Power, BootCause::Pin, BootCause::Request, BootCause::Other] {
            assert_eq!(of(cause, Aside::No), None);
        }
        assert_eq!(of(BootCause::Panic, Aside::No).unwrap(), "started again (a panic of its program)");
        assert_eq!(
            of(BootCause::Watchdog, Aside::Resets).unwrap(),
            "started (the watchdog: its loop hung) with the shipped settings; saved ones are kept aside: the board \
             had reset itself three times without running for a minute"
        );
        assert!(of(BootCause::Power, Aside::Pin).is_some() && of(BootCause::Power, Aside::Request).is_some());
    }
}
