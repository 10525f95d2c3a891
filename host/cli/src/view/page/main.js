// Assembles the page: messages are stored on arrival, and drawn once per screen refresh.

import { $, make } from "./dom.js";
import { Body } from "./body.js";
import { CognitiveMap } from "./fcm.js";
import { Concepts, contacts } from "./contacts.js";
import { Controls } from "./controls.js";
import { Health } from "./health.js";
import { Hover } from "./hover.js";
import { Link } from "./link.js";
import { Panels } from "./panels.js";
import { Player } from "./player.js";
import { Save } from "./save.js";
import { Store } from "./store.js";
import { Surface } from "./surface.js";
import { connect } from "./socket.js";
import * as ranges from "./ranges.js";
import * as scale from "./scale.js";
import * as strips from "./strips.js";

const store = new Store();
const link = new Link($("link"), $("source"), $("provenance"));
let stale = true;
const changed = () => (stale = true);
const change =
  (act) =>
  (...what) => {
    act(...what);
    changed();
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
const ask = (wish) => socket.ask(wish);
const hover = new Hover($("hover"), ask, changed);
const controls = new Controls(store, ask, changed);
const player = new Player(store, ask, changed);
const concepts = new Concepts($("concepts"), $("leading"));
const views = {
  panels: new Panels($("view-panels"), hover),
  surface: new Surface($("view-surface"), changed),
  body: new Body($("view-body")),
  map: new CognitiveMap($("view-map")),
  health: new Health($("view-health")),
};
const save = new Save({ store, view: () => $(`view-${controls.settings.view}`) });

let [told, drawn] = [null, null];
function log() {
  const lines = store.lines();
  const key = lines.join("\n");
  if (told === key) return;
  told = key;
  $("log").replaceChildren(...lines.map((text) => make("li", {}, text)));
}

function draw() {
  requestAnimationFrame(draw);
  if (!stale) return;
  stale = false;
  const { settings } = controls;
  if (store.latest !== drawn) link.drawn();
  drawn = store.latest;
  $("empty").hidden = Boolean(store.shown());
  controls.scale();
  // First, because it decides how much room is left.
  player.draw();
  views[settings.view].draw(store, settings);
  scale.draw(store, settings);
  hover.draw(store);
  link.draw(store);
  concepts.draw(store);
  contacts($("contacts"), $("contact-count"), store);
  ranges.draw($("ranges"), store, settings);
  if (!store.recorded) strips.draw($("strips"), store);
  log();
}
requestAnimationFrame(draw);

window.addEventListener("resize", changed);
// The absence of messages must show without a message.
setInterval(() => link.absence(store) && changed(), 500);
window.addEventListener("keydown", (event) => {
  const { target, ctrlKey, altKey, metaKey, key } = event;
  const typed =
    target.matches("input, select") || (key === " " && target.matches("button")) || target.closest("dialog, [role=menu]");
  if (typed || ctrlKey || altKey || metaKey) return;
  if (key === "s") save.toggle();
  else if (!player.key(event) && !controls.key(event)) return;
  event.preventDefault();
});

// For tests and for the console.
window.taxel = { store, settings: controls.settings, changed, ask };
