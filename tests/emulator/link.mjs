// A link of the board as a TCP server: one client at a time. Without a client the bytes are lost, as on a wire that ends
// nowhere.

import { createServer } from 'node:net';
import { setTimeout } from 'node:timers/promises';

export class Link {
  /** `receive(bytes)` takes what the client sends; `onClient(there)`: it has come, or gone. */
  constructor(receive, onClient = () => {}) {
    Object.assign(this, { receive, onClient });
    /** Called with the number of bytes so far when the last one of a message has come. */
    this.onEnd = () => {};
    this.out = [];
    this.client = undefined;
    this.sent = this.dropped = this.received = 0;
  }

  /** Listens on the loopback interface and gives the port. */
  listen(port) {
    this.server = createServer({ noDelay: true }, (socket) => this.accept(socket));
    return new Promise((resolve, reject) => {
      this.server.once('error', reject);
      this.server.listen(port, '127.0.0.1', () => resolve(this.server.address().port));
    });
  }

  accept(socket) {
    if (this.client !== undefined) {
      socket.destroy();
      return;
    }
    this.client = socket;
    this.onClient(true);
    socket.on('data', (bytes) => {
      this.received += bytes.length;
      this.receive(bytes);
    });
    socket.on('error', () => {});
    socket.on('close', () => {
      this.client = undefined;
      this.onClient(false);
    });
  }

  /** Takes a byte from the board. */
  push(byte) {
    if (this.client === undefined) {
      this.dropped++;
      return;
    }
    this.out.push(byte);
    if (byte === 0) this.onEnd(this.sent + this.out.length);
  }

  /** Hands what has gathered to the client. */
  flush() {
    if (this.out.length === 0 || this.client === undefined) return;
    this.sent += this.out.length;
    this.client.write(Uint8Array.from(this.out));
    this.out.length = 0;
  }

  /** Sends what is left; a client that does not take it within a second loses it. */
  async close() {
    this.flush();
    const { client } = this;
    if (client !== undefined) {
      await Promise.race([new Promise((resolve) => client.end(resolve)), setTimeout(1000)]);
      client.destroy();
    }
    this.server?.close();
  }
}
