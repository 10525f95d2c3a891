//! The board as a USB device: a serial port (CDC-ACM). Its tasks run in an interrupt of the lowest priority,
//! so that they interrupt only perception. What it sends, `packets.rs` sends.

use super::packets::{self, PACKET};
use super::rings::{OPENED, RECEIVED};
use super::starts;
use embassy_executor::{InterruptExecutor, SpawnError, SpawnToken, Spawner};
use embassy_rp::interrupt::typelevel::{Handler, SWI_IRQ_1};
use embassy_rp::interrupt::{self, InterruptExt, Priority};
use embassy_rp::{bind_interrupts, peripherals::USB, usb::Driver};
use embassy_usb::class::cdc_acm::{CdcAcmClass, ControlChanged, Receiver, State};
use embassy_usb::{Builder, Config, UsbDevice};
use static_cell::{ConstStaticCell, StaticCell};

/// Vendor and product by which a host finds the board, from the test range of <https://pid.codes>; so the
/// product's name counts, too. Products for sale need numbers of their own.
const ID: (u16, u16) = (0x1209, 0x0001);
/// Name of the product.
const PRODUCT: &str = "taxel";

/// Greatest current that the board draws from the bus, mA.
const MILLIAMPERES: u16 = 250;

type Bus = Driver<'static, USB>;

static EXECUTOR: InterruptExecutor = InterruptExecutor::new();

bind_interrupts!(struct Interrupts {
    SWI_IRQ_1 => TaskInterrupt;
});

/// The interrupt in which the tasks run; nothing else raises it.
struct TaskInterrupt;

impl Handler<SWI_IRQ_1> for TaskInterrupt {
    #[allow(unsafe_code)] // SAFETY: only the executor's own interrupt calls it
    unsafe fn on_interrupt() {
        unsafe { EXECUTOR.on_interrupt() }
    }
}

/// Attaches the board to the bus, with its serial number if it has one. Must be called once.
pub fn start(driver: Bus, number: Option<&'static str>) {
    interrupt::SWI_IRQ_1.set_priority(Priority::P3);
    EXECUTOR.start(interrupt::SWI_IRQ_1).spawn(once(attach(driver, number)));
}

/// Token of a task with a single instance.
fn once<S>(token: Result<SpawnToken<S>, SpawnError>) -> SpawnToken<S> {
    token.unwrap_or_else(|_| defmt::panic!("the USB device was started twice"))
}

/// Runs the device and spawns its other tasks at this priority.
#[embassy_executor::task]
async fn attach(driver: Bus, number: Option<&'static str>) {
    #[allow(unsafe_code)]
    // SAFETY: this future is a task of an executor of embassy.
    let spawner = unsafe { Spawner::for_current_executor() }.await;
    let (mut device, port) = device(driver, number);
    packets::start();
    let (_, receiver, control) = port.split_with_control();
    spawner.spawn(once(watch(control)));
    spawner.spawn(once(receive(receiver)));
    spawner.spawn(once(starts::watch()));
    device.run().await;
}

/// The device and its serial port. A function of its own: otherwise the task would keep what it builds them
/// from.
#[inline(never)]
fn device(driver: Bus, number: Option<&'static str>) -> (UsbDevice<'static, Bus>, CdcAcmClass<'static, Bus>) {
    static DESCRIPTORS: ConstStaticCell<[u8; 128]> = ConstStaticCell::new([0; 128]);
    static CAPABILITIES: ConstStaticCell<[u8; 16]> = ConstStaticCell::new([0; 16]);
    static CONTROL: ConstStaticCell<[u8; PACKET]> = ConstStaticCell::new([0; PACKET]);
    static PORT: StaticCell<State<'static>> = StaticCell::new();
    static SLEEP: StaticCell<Sleep> = StaticCell::new();
    let mut config = Config::new(ID.0, ID.1);
    config.manufacturer = Some(PRODUCT);
    config.product = Some(PRODUCT);
    config.serial_number = number;
    config.max_power = MILLIAMPERES;
    let mut builder =
        Builder::new(driver, config, DESCRIPTORS.take(), CAPABILITIES.take(), &mut [], CONTROL.take());
    builder.handler(SLEEP.init(Sleep));
    let port = CdcAcmClass::new(&mut builder, PORT.init(State::new()), PACKET as u16);
    (builder.build(), port)
}

/// Watches for suspension of the bus.
struct Sleep;

impl embassy_usb::Handler for Sleep {
    fn reset(&mut self) {
        OPENED.set_asleep(false);
    }

    fn suspended(&mut self, suspended: bool) {
        OPENED.set_asleep(suspended);
    }
}

#[embassy_executor::task]
async fn watch(control: ControlChanged<'static>) {
    loop {
        control.control_changed().await;
        OPENED.set_ready(control.dtr());
    }
}

#[embassy_executor::task]
async fn receive(mut port: Receiver<'static, Bus>) {
    let mut packet = [0; PACKET];
    loop {
        port.wait_connection().await;
        if let Ok(count) = port.read_packet(&mut packet).await {
            RECEIVED.write_all(packet.get(..count).unwrap_or(&[])).await;
        }
    }
}
