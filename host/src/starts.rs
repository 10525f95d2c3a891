//! How a board came to start, in words.

use taxel_core::boot::{Aside, Boot, BootCause};

/// What started it.
pub fn cause(boot: &Boot) -> &'static str {
    match boot.cause {
        BootCause::Power => "the power came",
        BootCause::Pin => "the reset pin",
        BootCause::Watchdog => "the watchdog: its loop hung",
        BootCause::Panic => "a panic of its program",
        BootCause::Request => "a host asked for it",
        BootCause::Other => "something else, as after flashing",
    }
}

/// Why what was saved is not in force; none: it is.
pub fn aside(boot: &Boot) -> Option<&'static str> {
    match boot.aside {
        Aside::No => None,
        Aside::Resets => Some("the board had reset itself three times without a minute of life"),
        Aside::Pin => Some("its pin for that was grounded"),
        Aside::Request => Some("`taxel reset-settings` has put them aside"),
    }
}

/// Whether it reset itself.
pub fn is_fault(boot: &Boot) -> bool {
    matches!(boot.cause, BootCause::Watchdog | BootCause::Panic)
}

/// A sentence where something is to be said.
pub fn remark(boot: &Boot) -> Option<String> {
    let cause = cause(boot);
    match (aside(boot), is_fault(boot)) {
        (Some(why), _) => {
            Some(format!("started ({cause}) with what ships; saved settings are kept aside: {why}"))
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
            "started (the watchdog: its loop hung) with what ships; saved settings are kept aside: the board had \
             reset itself three times without a minute of life"
        );
        assert!(of(BootCause::Power, Aside::Pin).is_some() && of(BootCause::Power, Aside::Request).is_some());
    }
}
