// What is felt, in a sentence: of the moment shown, or of a touch that has just ended.

/** Time for which a touch that has ended is still reported, us of the board: the pause between two pats. */
const LASTS_US = 800_000;

/**
 * The sentence of the moment shown; null before the first image, and while the board is lost.
 * @param {import("./store.js").Store} store
 */
export function sentence(store) {
  const shown = store.shown();
  if (!shown || (store.states.lost && !store.paused)) return null;
  const touched = lastTouched(store, shown);
  const { frame } = shown.head;
  const { what, peak, meaning } = touched.head.frame.felt;
  const { leading } = frame.intent;
  const at = `at ${((frame.at_us ?? frame.time_us) / 1e6).toFixed(2)} s`;
  const when = touched === shown ? "now" : "just now";
  const text = touched === shown ? what : peak;
  return { when: store.paused ? at : when, what: text, meaning: leading === "none" ? meaning : leading };
}

/**
 * The moment shown or, if nothing touches then, the last one before it at which something did.
 * @param {import("./store.js").Store} store
 * @param {import("./types.d.ts").Shown} shown
 */
function lastTouched(store, shown) {
  const { contacts, time_us: now } = shown.head.frame;
  if (contacts.length) return shown;
  const [first, end] = store.span();
  for (let number = Math.min(shown.number, end) - 1; number >= first; number -= 1) {
    const before = store.at(number);
    const age = now - before.head.frame.time_us;
    if (age < 0 || age > LASTS_US) break;
    if (before.head.frame.contacts.length) return before;
  }
  return shown;
}
