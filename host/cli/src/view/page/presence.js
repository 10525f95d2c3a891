// Whether the picture is live: a page whose program has ended must not look live.

/**
 * Silence after which the program counts as gone although the connection is open, milliseconds. It sends four
 * messages a second.
 */
export const SILENCE_MS = 3000;

/**
 * The message to show; null while all is well. `connected` is the state of the connection, `heard` the time
 * of the last message and `lost` that of the disconnection, both ms or null. A paused recording sends
 * nothing. `board` says since when and why the board is lost.
 * @param {{ connected: boolean, heard: number | null, lost: number | null, quiet?: boolean, board?: { since: number,
 *   text: string } }} state
 * @param {number} now
 * @returns {{ since: number | null, text: string, again: boolean } | null}
 */
export function absence({ connected, heard, lost, quiet = false, board }, now) {
  if (!connected) {
    // A paused recording may have been silent for long.
    const since = lost ?? heard;
    return { since, text: since === null ? "Connecting …" : "Disconnected", again: since !== null };
  }
  if (heard !== null && !quiet && now - heard >= SILENCE_MS) {
    return { since: heard, text: "No messages from the program", again: false };
  }
  return board ? { ...board, again: true } : null;
}

/**
 * "5 s", "3 min", "2 h"
 * @param {number} ms
 */
export function agoText(ms) {
  const seconds = Math.max(0, Math.floor(ms / 1000));
  if (seconds < 120) return `${seconds} s`;
  return seconds < 7200 ? `${Math.floor(seconds / 60)} min` : `${Math.floor(seconds / 3600)} h`;
}
