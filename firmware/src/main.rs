//! bring-up
#![no_std]
#![no_main]
use defmt_rtt as _;
use embassy_rp as _;
#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! { loop {} }
#[embassy_executor::main]
async fn main(_s: embassy_executor::Spawner) {
    let _p = embassy_rp::init(Default::default());
    defmt::info!("hello");
}
