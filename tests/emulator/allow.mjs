// Emulator warnings that mean nothing here. Any other ends a run.

const ALLOWED = [
  // rp2040js has no ring oscillator; the firmware slows it down and goes on with the crystal.
  /^ROSC_BASE: Unimplemented peripheral write to 0x(0|4|8|10): /,
];

/** Whether a warning, as "part: text", is expected. */
export function allowed(warning) {
  return ALLOWED.some((pattern) => pattern.test(warning));
}
