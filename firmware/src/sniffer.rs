//! The CRC-32 of messages by the DMA: its sniffer computes the sum of the bytes that a channel reads, one in
//! a cycle. The table of the core takes 7 cycles for each.

use embassy_rp::{Peri, peripherals::DMA_CH11};
use rp_pac::DMA;
use rp_pac::dma::regs::CtrlTrig;
use rp_pac::dma::vals::{Calc, DataSize, TreqSel};
use taxel_core::format::crc32;

const CHANNEL: usize = 11;
/// Rounds of waiting, besides one for each byte; a round takes longer than a byte.
const SPARE_ROUNDS: usize = 64;

/// Computes checksums. The only user of the sniffer and of its channel.
pub struct Sniffer {
    _channel: Peri<'static, DMA_CH11>,
    /// Place to which the channel writes each byte that it reads.
    sink: u8,
}

impl Sniffer {
    /// Sets the sniffer to CRC-32/ISO-HDLC: bits of the bytes reversed, result reversed and inverted.
    pub fn new(channel: Peri<'static, DMA_CH11>) -> Sniffer {
        DMA.sniff_ctrl().write(|sniffer| {
            sniffer.set_en(true);
            sniffer.set_dmach(CHANNEL as u8);
            sniffer.set_calc(Calc::CRC32R);
            sniffer.set_out_rev(true);
            sniffer.set_out_inv(true);
        });
        Sniffer { _channel: channel, sink: 0 }
    }

    /// Returns the CRC-32/ISO-HDLC of the bytes, by the table if the DMA does not end in time.
    pub fn crc32(&mut self, bytes: &[u8]) -> u32 {
        if self.sniff(bytes) {
            return DMA.sniff_data().read();
        }
        DMA.chan_abort().write(|w| w.set_chan_abort(1 << CHANNEL));
        crc32(bytes)
    }

    /// Lets the sniffer see the bytes; `false` if it has not seen all of them.
    fn sniff(&mut self, bytes: &[u8]) -> bool {
        let channel = DMA.ch(CHANNEL);
        DMA.sniff_data().write_value(u32::MAX);
        channel.read_addr().write_value(bytes.as_ptr() as u32);
        channel.write_addr().write_value(&raw mut self.sink as u32);
        channel.trans_count().write_value(bytes.len() as u32);
        // The bytes are in memory before the channel reads them.
        cortex_m::asm::dmb();
        channel.ctrl_trig().write_value(control());
        let is_at_rest = || !channel.ctrl_trig().read().busy();
        (0..bytes.len() + SPARE_ROUNDS).any(|_| is_at_rest())
            && channel.trans_count().read() == 0
            && !channel.ctrl_trig().read().ahb_error()
    }
}

/// Reads bytes one after the other, unpaced; clears errors of an earlier transfer.
fn control() -> CtrlTrig {
    let mut control = CtrlTrig::default();
    control.set_en(true);
    control.set_data_size(DataSize::SIZE_BYTE);
    control.set_incr_read(true);
    control.set_treq_sel(TreqSel::PERMANENT);
    control.set_chain_to(CHANNEL as u8);
    control.set_irq_quiet(true);
    control.set_sniff_en(true);
    control.set_read_error(true);
    control.set_write_error(true);
    control
}
