//! Copies, four words at a time: 13 cycles of a Cortex-M0+ for them, where the loops of the compiler's library take 32.
//!
//! These are the functions that compiled code calls for copies of some length, in place of that library's own, which give way to others.

// SAFETY: they do what the run-time ABI for the Arm architecture (5.3.4) asks of them: `r0`, `r1`, `r2` are the places to and from which
// so many bytes are copied, which do not overlap; in those of the names with 4 and 8 both are whole words, and the last may be a part of one.
// What they change besides `r0` to `r3` they put back. `memcpy` is the library's.
#[allow(unsafe_code)]
mod words {
    core::arch::global_asm!(
        ".section .text.taxel_copy, \"ax\", %progbits",
        ".p2align 2",
        ".global __aeabi_memcpy",
        ".type __aeabi_memcpy, %function",
        ".thumb_func",
        "__aeabi_memcpy:",
        // Words do not stand alike in both, or there are few: byte by byte, as the library does it.
        "    movs r3, r0",
        "    eors r3, r1",
        "    lsls r3, r3, #30",
        "    bne 6f",
        "    cmp r2, #8",
        "    blo 6f",
        // Up to the next whole word.
        "    lsls r3, r0, #30",
        "    beq __aeabi_memcpy4",
        "0:",
        "    ldrb r3, [r1]",
        "    strb r3, [r0]",
        "    adds r1, #1",
        "    adds r0, #1",
        "    subs r2, #1",
        "    lsls r3, r0, #30",
        "    bne 0b",
        ".global __aeabi_memcpy4",
        ".type __aeabi_memcpy4, %function",
        ".thumb_func",
        "__aeabi_memcpy4:",
        ".global __aeabi_memcpy8",
        ".type __aeabi_memcpy8, %function",
        ".thumb_func",
        "__aeabi_memcpy8:",
        "    push {{r4, r5, r6, lr}}",
        "    subs r2, #16",
        "    blo 2f",
        "1:",
        "    ldmia r1!, {{r3, r4, r5, r6}}",
        "    stmia r0!, {{r3, r4, r5, r6}}",
        "    subs r2, #16",
        "    bhs 1b",
        "2:",
        // Here and below: what is left, less one step.
        "    adds r2, #12",
        "    bmi 4f",
        "3:",
        "    ldmia r1!, {{r3}}",
        "    stmia r0!, {{r3}}",
        "    subs r2, #4",
        "    bpl 3b",
        "4:",
        "    adds r2, #3",
        "    bmi 5f",
        "7:",
        "    ldrb r3, [r1]",
        "    strb r3, [r0]",
        "    adds r1, #1",
        "    adds r0, #1",
        "    subs r2, #1",
        "    bpl 7b",
        "5:",
        "    pop {{r4, r5, r6, pc}}",
        "6:",
        "    push {{r4, lr}}",
        "    bl memcpy",
        "    pop {{r4, pc}}",
    );
}
