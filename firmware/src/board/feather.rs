//! Adafruit Feather RP2040, and boards with the same pinout such as the Waveshare RP2040-Zero.
//!
//! | pin | use |
//! |---|---|
//! | USB | link to the host |
//! | GP0, GP1 | UART, the other link to the host: transmit, receive |
//! | GP2, GP3, GP6 - GP12 | select lines (the Feather does not bring out GP4 and GP5) |
//! | GP18 - GP20, GP24, GP25 | further select lines, or outputs of reactions |
//! | GP13 | heartbeat LED; grounded at power-up: the board starts with the shipped settings |
//! | GP26 - GP29 | converter inputs |

use super::parts::BoardParts;
use crate::{
    adc::Converter,
    led::Led,
    levels,
    limits::INFO,
    link::{PacketHandler, Uart, Usb, Wire, uart},
    pins::LinePin,
    scan::{DmaChain, FrameBegin},
    serial_number,
    sniffer::Sniffer,
    store::Flash,
};
use embassy_rp::{
    adc, bind_interrupts,
    gpio::{Flex, Pull},
    peripherals::{UART0, USB},
    uart as port, usb,
    watchdog::Watchdog,
};
use static_cell::ConstStaticCell;

/// Takes pins as lines. Fails to compile unless they are the pins of [`INFO`].
macro_rules! lines {
    ($p:ident: $($pin:ident = $gpio:literal),* $(,)?) => {{
        const { assert!(INFO.pins.outputs == 0 $(| 1 << $gpio)*) };
        [$(LinePin::new($p.$pin.into())),*]
    }};
}

bind_interrupts!(struct Interrupts {
    PIO0_IRQ_0 => FrameBegin;
    UART0_IRQ => port::BufferedInterruptHandler<UART0>;
    USBCTRL_IRQ => PacketHandler, usb::InterruptHandler<USB>;
});

/// Starts the clocks (125 MHz) and returns the board's parts. Must be called once.
pub fn take() -> BoardParts {
    let p = embassy_rp::init(Default::default());
    // `init` has reset the pads.
    levels::drive();
    let mut flash = Flash::new_blocking(p.FLASH);
    // Before USB, whose interrupts run from the flash.
    let number = serial_number::read(&mut flash);
    BoardParts {
        chip: number.unwrap_or(""),
        lines: lines!(p:
            PIN_2 = 2,
            PIN_3 = 3,
            PIN_6 = 6,
            PIN_7 = 7,
            PIN_8 = 8,
            PIN_9 = 9,
            PIN_10 = 10,
            PIN_11 = 11,
            PIN_12 = 12,
            PIN_18 = 18,
            PIN_19 = 19,
            PIN_20 = 20,
            PIN_24 = 24,
            PIN_25 = 25,
        ),
        converter: Converter::new(
            adc::Adc::new_blocking(p.ADC, adc::Config::default()),
            [
                adc::Channel::new_pin(p.PIN_26, Pull::None),
                adc::Channel::new_pin(p.PIN_27, Pull::None),
                adc::Channel::new_pin(p.PIN_28, Pull::None),
                adc::Channel::new_pin(p.PIN_29, Pull::None),
            ],
        ),
        chain: DmaChain::new(
            (
                p.PIO0,
                (
                    p.DMA_CH0, p.DMA_CH1, p.DMA_CH2, p.DMA_CH3, p.DMA_CH4, p.DMA_CH5, p.DMA_CH6, p.DMA_CH7,
                    p.DMA_CH8, p.DMA_CH9, p.DMA_CH10,
                ),
            ),
            Interrupts,
        ),
        sniffer: Sniffer::new(p.DMA_CH11),
        wire: Wire::new(Usb::start(usb::Driver::new(p.USB, Interrupts), number), {
            static TX: ConstStaticCell<[u8; uart::RING]> = ConstStaticCell::new([0; uart::RING]);
            static RX: ConstStaticCell<[u8; uart::RING]> = ConstStaticCell::new([0; uart::RING]);
            let mut config = port::Config::default();
            config.baudrate = uart::BAUD;
            Uart::new(port::BufferedUart::new(
                p.UART0,
                p.PIN_0,
                p.PIN_1,
                Interrupts,
                TX.take(),
                RX.take(),
                config,
            ))
        }),
        led: Led::new(Flex::new(p.PIN_13)),
        watchdog: Watchdog::new(p.WATCHDOG),
        flash,
    }
}
