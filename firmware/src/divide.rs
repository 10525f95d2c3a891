//! Divides with the chip's divider: some 40 cycles for each quotient, where the loop of the compiler's library
//! takes 60 to 400.
//!
//! Compiled code calls these functions for `/` and `%` of 32 bits. They replace the weak symbols of that
//! library.

// SAFETY: they meet the run-time ABI for the Arm architecture (5.3.3): `r0` is divided by `r1`; the quotient is
// in `r0` afterwards and the remainder in `r1`, and no register but `r0` to `r3` and the flags is written.
// A divisor of 0 is never passed: compiled code checks it before. The divider has one state, so interrupts are
// off from the first operand to the last result, some 20 cycles; each core has a divider of its own.
#[allow(unsafe_code)]
mod divider {
    core::arch::global_asm!(
        // Operands go to `dividend` and the word after it. The quotient is ready 8 cycles later.
        ".macro taxel_divide dividend",
        "    ldr r2, 4f", // SIO
        "    mrs r3, PRIMASK",
        "    cpsid i",
        "    str r0, [r2, #\\dividend]",
        "    str r1, [r2, #\\dividend + 4]",
        "    b 3f",
        "3:  b 3f",
        "3:  b 3f",
        "3:  b 3f",
        "3:",
        "    ldr r1, [r2, #0x74]", // DIV_REMAINDER
        "    ldr r0, [r2, #0x70]", // DIV_QUOTIENT
        "    msr PRIMASK, r3",
        "    bx lr",
        ".p2align 2",
        "4:  .word 0xd0000000",
        ".endm",
        ".section .text.taxel_divide, \"ax\", %progbits",
        ".p2align 2",
        ".global __aeabi_uidiv",
        ".type __aeabi_uidiv, %function",
        ".thumb_func",
        "__aeabi_uidiv:",
        ".global __aeabi_uidivmod",
        ".type __aeabi_uidivmod, %function",
        ".thumb_func",
        "__aeabi_uidivmod:",
        "    taxel_divide 0x60", // DIV_UDIVIDEND
        ".global __aeabi_idiv",
        ".type __aeabi_idiv, %function",
        ".thumb_func",
        "__aeabi_idiv:",
        ".global __aeabi_idivmod",
        ".type __aeabi_idivmod, %function",
        ".thumb_func",
        "__aeabi_idivmod:",
        "    taxel_divide 0x68", // DIV_SDIVIDEND
    );
}
