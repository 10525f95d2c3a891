// `taxel view` as a program of its own.

import { spawn } from "node:child_process";
import { readFile } from "node:fs/promises";

const PROGRAM = process.env.TAXEL_PROGRAM ?? "taxel";

/** A running `taxel view`. */
export class View {
  /** Starts it with options; where they name no port, it finds one itself. */
  static start(...options) {
    return View.run("view", ...options);
  }

  static async run(...words) {
    const port = words.includes("--port") ? [] : ["--port", "0"];
    const program = spawn(PROGRAM, [...words, ...port], { stdio: ["pipe", "pipe", "inherit"] });
    const url = await new Promise((done, fail) => {
      let said = "";
      program.once("error", fail).once("exit", (code) => fail(new Error(`${PROGRAM} ended with ${code}`)));
      program.stdout.on("data", (text) => {
        said += text;
        const found = /http:\/\/127\.0\.0\.1:(\d+)\//.exec(said);
        if (found) done(found);
      });
    });
    return new View(program, url[0], Number(url[1]));
  }

  constructor(program, url, port) {
    Object.assign(this, { program, url, port });
  }

  /** Writes a line to its standard input. */
  send(line) {
    this.program.stdin.write(`${line}\n`);
  }

  /** Bytes of memory that are in use. */
  async memory() {
    const status = await readFile(`/proc/${this.program.pid}/status`, "utf8");
    return Number(/VmRSS:\s+(\d+) kB/.exec(status)[1]) * 1024;
  }

  /** Ends it. */
  async stop() {
    const gone = new Promise((done) => this.program.once("exit", done));
    this.program.kill();
    await gone;
  }
}
