// Pictures of the page: node picture.mjs [--source SOURCE] [--body BODY] [--robot URDF] [--joints JOINTS] [--view VIEW] [--dark] [--size WxH] [--until EXPRESSION] [--keys KEYS] [--press "TOOL PANEL X Y"] FILE.png

import { writeFile } from "node:fs/promises";
import { parseArgs } from "node:util";
import { Chromium } from "./chromium.mjs";
import { choose, inView } from "./hand.fixture.mjs";
import { View } from "./program.mjs";

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    source: { type: "string", default: "sim:pat" },
    body: { type: "string" },
    robot: { type: "string" },
    joints: { type: "string" },
    view: { type: "string", default: "garment" },
    dark: { type: "boolean", default: false },
    size: { type: "string", default: "1280x800" },
    // An expression of the page that is waited for.
    until: { type: "string", default: "true" },
    keys: { type: "string", default: "" },
    // A tool that presses a place of a panel, in taxels, until the picture is taken.
    press: { type: "string" },
  },
});
const [width, height] = values.size.split("x").map(Number);
const options = ["source", "body", "robot", "joints"].flatMap((name) => (values[name] ? [`--${name}`, values[name]] : []));
const program = await View.start(...options);
const browser = await Chromium.start();
try {
  await browser.open(program.url, { width, height, dark: values.dark, mobile: width < 600 });
  await browser.value(`document.getElementById("tab-${values.view}").click()`);
  for (const key of values.keys) await browser.key(key);
  if (values.press) {
    const [tool, panel, ...at] = values.press.split(" ");
    await browser.until("taxel.store.states.hand && taxel.store.latest?.head.frame.time_us > 2e6");
    await choose(browser, tool);
    const [x, y] = await inView(browser, values.view, Number(panel), at.map(Number));
    await browser.pointer(x, y);
    await browser.pointer(x, y, "mousePressed");
  }
  await browser.until(values.until, 40);
  await browser.value("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))");
  await writeFile(positionals[0], await browser.picture());
  for (const complaint of browser.complaints) console.error(complaint);
} finally {
  await browser.stop();
  await program.stop();
}
