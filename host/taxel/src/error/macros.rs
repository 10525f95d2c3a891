//! Errors with a text: the variant that holds it, then the words of `format!`.

/// An error.
macro_rules! error {
    ($variant:expr, $($text:tt)+) => {
        $crate::error::Error::from($variant(format!($($text)+)))
    };
}

/// Returns an error.
macro_rules! fail {
    ($variant:expr, $($text:tt)+) => {
        return Err(error!($variant, $($text)+))
    };
}

/// Returns an error unless the condition holds.
macro_rules! require {
    ($condition:expr, $variant:expr, $($text:tt)+) => {
        if !$condition {
            fail!($variant, $($text)+)
        }
    };
}
