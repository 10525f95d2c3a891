// Assembles the page: messages are stored on arrival, and drawn once per screen refresh.

import { $, one, say } from "./dom.js";
import { Body } from "./body.js";
import { CognitiveMap } from "./fcm.js";
import { Concepts } from "./concepts.js";
import { contacts } from "./contacts.js";
import { Controls } from "./controls.js";
import { felt } from "./felt.js";
import { legend } from "./folds.js";
import { Hand } from "./hand.js";
import { Health } from "./health.js";
import { Hover } from "./hover.js";
import { Link } from "./link.js";
import { Log } from "./log.js";
import { Mind } from "./mind.js";
import { Others } from "./others.js";
import { Panels } from "./panels.js";
import { Player } from "./player.js";
import { Robot } from "./robot.js";
import { Save } from "./save.js";
import { Setup } from "./setup.js";
import { Store } from "./store.js";
import { Surface } from "./surface.js";
import { Speaker } from "./speaker.js";
import { Tools } from "./tools.js";
import { Why } from "./why.js";
import { connect } from "./socket.js";
import * as ranges from "./ranges.js";
import * as scale from "./scale.js";
import * as strips from "./strips.js";

const store = new Store();
const link = new Link($("link"), $("source"), $("provenance"));
/** Time between two redraws of what is beside the picture while it is live: nobody reads faster. */
const BESIDE_MS = 100;
let stale = true;
/** True if what is beside the picture is out of date since a message, and if it must be drawn at once. */
let [besides, urgent] = [true, true];
/** Time at which it was drawn. */
let besidesAt = 0;
const changed = () => (stale = urgent = true);
/** @type {<What>(act: (what: What) => void) => (what: What) => void} */
const change = (act) => (what) => {
  act(what);
  stale = besides = true;
};

const socket = connect({
  image: change((message) => store.image(message)),
  line: change((line) => store.line(line)),
  connected: change((connected) => {
    link.connection(connected);
    if (connected) store.connected();
  }),
  heard: () => link.hear(),
});
/** @type {import("./types.d.ts").Ask} */
const ask = (request) => socket.ask(request);
const hover = new Hover($("hover"), ask, changed);
const controls = new Controls(store, ask, changed);
const robot = new Robot();
const mind = new Mind();
const others = new Others(() => (stale = true));
const speaker = new Speaker();
const player = new Player(store, ask, changed);
const why = new Why(ask, changed);
const concepts = new Concepts($("concepts"), (concept) => why.open(concept), changed);
const log = new Log($("log"), (at) => player.go(at));
/** @type {Record<string, import("./types.d.ts").View>} */
const views = {
  panels: new Panels($("view-panels"), hover),
  surface: new Surface($("view-surface"), hover, changed),
  body: new Body($("view-body"), hover, others, changed),
  map: new CognitiveMap($("view-map")),
  health: new Health($("view-health")),
};
const shownViews = () => controls.parts.flatMap((name) => views[name] ?? []);
const setup = new Setup(store, ask, changed);
const tools = new Tools(ask, changed);
const hand = new Hand({ store, ask, hover, tools, views: () => shownViews() });
const save = new Save({ store, view: () => $("view") });

/** @type {import("./types.d.ts").Shown | null} */
let drawn = null;

function draw() {
  requestAnimationFrame(draw);
  const now = performance.now();
  hand.frame(now);
  const due = urgent || (besides && (store.paused || now - besidesAt >= BESIDE_MS));
  if (!stale && !due) return;
  stale = false;
  const { settings } = controls;
  if (store.latest !== drawn) link.drawn();
  drawn = store.latest;
  $("empty").hidden = Boolean(store.shown());
  controls.scale();
  controls.arrange();
  // First, because they decide how much room is left.
  if (due) player.draw();
  if (due) tools.draw(hand.offered, hand.force);
  others.follow(controls.parts.includes("body") ? store.states.robot : undefined);
  for (const view of shownViews()) view.draw(store, settings);
  scale.draw(store, settings);
  hover.draw(store);
  if (!due) return;
  besidesAt = now;
  besides = urgent = false;
  beside(settings);
}

/**
 * Text for whoever does not see the picture: what the keys have changed of the tool, the taxel that they read,
 * else the intention, of the robot if it has one.
 */
function spoken() {
  const changed = tools.text(performance.now());
  if (changed !== null) return changed;
  const meant = store.states.robot_intent?.leading ?? "none";
  if (meant !== "none") return hover.text(store) ?? `intention of the robot: ${meant}`;
  const leading = store.shown()?.head.frame.intent.leading ?? "none";
  return hover.text(store) ?? (leading === "none" ? "" : `intention: ${leading}`);
}

/** @param {import("./types.d.ts").Settings} settings */
function beside(settings) {
  link.draw(store);
  setup.draw();
  $("layer-folds").hidden = !store.states.folding;
  say($("folding"), legend(store.shown(), settings));
  say($("spoken"), speaker.next(spoken(), performance.now()));
  felt(store);
  why.draw(store);
  concepts.draw(store);
  robot.draw(store);
  mind.draw(store);
  contacts(one(HTMLTableElement, "contacts"), $("contact-count"), store);
  ranges.draw(one(HTMLCanvasElement, "ranges"), store, settings);
  if (!store.recorded) strips.draw(one(HTMLCanvasElement, "strips"), store);
  log.draw(store.lines());
}
requestAnimationFrame(draw);

window.addEventListener("resize", changed);
$("mind-details").addEventListener("toggle", changed);
// The absence of messages must show without a message.
setInterval(() => link.absence(store) && changed(), 500);
window.addEventListener("keydown", (event) => {
  const { target, ctrlKey, altKey, metaKey, key } = event;
  if (!(target instanceof Element)) return;
  // Until the next frame is drawn, the focus may be left in a dialog or a menu that has just closed.
  const typed =
    target.matches("input, select") ||
    (key === " " && target.matches("button, summary")) ||
    target.closest("dialog[open], [role=menu]:not([hidden])");
  if (typed || ctrlKey || altKey || metaKey || !controls.settings.keys) return;
  if (key === "s") save.toggle();
  else if (!tools.press(event) && !player.key(event) && !controls.key(event)) return;
  event.preventDefault();
});

// For tests and for the console.
Object.assign(window, { taxel: { store, settings: controls.settings, views, changed, ask } });
