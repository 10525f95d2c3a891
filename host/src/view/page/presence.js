// Whether what is shown is live: a page whose program has gone must not look as if it had not.

/** Milliseconds without a word after which the program counts as gone though the connection stands. It speaks four times a second. */
export const SILENCE_MS = 3000;

/**
 * What is to be said: null while all is well. `connected` is the state of the connection, `heard` when the last message came
 * and `lost` when the connection went, both ms or null; a recording that stands still says nothing.
 */
export function absence({ connected, heard, lost, quiet = false }, now) {
  if (!connected) {
    // A recording that stands still may have said nothing for long before.
    const since = lost ?? heard;
    return { since, text: since === null ? "Connecting …" : "Disconnected", again: since !== null };
  }
  if (heard === null || quiet || now - heard < SILENCE_MS) return null;
  return { since: heard, text: "Nothing comes from the program", again: false };
}

/** "5 s", "3 min", "2 h" */
export function agoText(ms) {
  const seconds = Math.max(0, Math.floor(ms / 1000));
  if (seconds < 120) return `${seconds} s`;
  return seconds < 7200 ? `${Math.floor(seconds / 60)} min` : `${Math.floor(seconds / 3600)} h`;
}
