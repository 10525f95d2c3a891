//! Errors of frames and messages.

use core::fmt;

/// Reason why bytes are not a valid message, or a message cannot be encoded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WireError {
    /// More bytes without a 0x00 than the receiver can hold.
    TooLong,
    /// Fewer bytes than one byte of message and its CRC.
    TooShort,
    /// A code byte points past the end of the frame, or there is a 0x00 inside.
    Cobs,
    /// The CRC does not match the bytes.
    Crc,
    /// The CRC matches, but the bytes are no message of this type.
    Message,
    /// The buffer of the caller is too small for the frame.
    NoRoom,
}

impl fmt::Display for WireError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            WireError::TooLong => "the frame is longer than the receiver can hold",
            WireError::TooShort => "the frame is shorter than one byte of message and its CRC",
            WireError::Cobs => "the frame is not valid COBS",
            WireError::Crc => "the CRC-32 of the frame does not fit its bytes",
            WireError::Message => "the frame is intact but holds no known message",
            WireError::NoRoom => "the buffer is too small for the frame",
        })
    }
}

impl core::error::Error for WireError {}
