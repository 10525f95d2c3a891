// The connection to the program; its messages are described in host/cli/src/view/message.rs.

import { channel } from "./channel.js";

const AGAIN_MS = 1000;

/**
 * Decodes a binary message to { frame, samples, replaced, missed, image, highest }.
 * @param {ArrayBuffer} buffer
 * @returns {import("./types.d.ts").ImageMessage}
 */
export function decode(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const values = new Uint16Array(buffer, 4 + length);
  const taxels = values.length / 2;
  return { ...head, image: values.subarray(0, taxels), highest: values.subarray(taxels) };
}

/**
 * Connects, and reconnects. `on` has image(message), line(object), connected(boolean) and heard().
 * @param {object} on
 * @param {(message: import("./types.d.ts").ImageMessage) => void} on.image
 * @param {(line: import("./types.d.ts").Line) => void} on.line
 * @param {(connected: boolean) => void} on.connected
 * @param {() => void} on.heard
 * @param {string} place of the socket, beside the page
 * @returns {{ ask: import("./types.d.ts").Ask, close: () => void }}
 */
export function connect(on, place = "socket") {
  /** @type {import("./channel.js").Channel | null} */
  let socket = null;
  let isClosed = false;
  const open = () => {
    if (isClosed) return;
    const next = channel(place);
    socket = next;
    next.binaryType = "arraybuffer";
    next.onopen = () => on.connected(true);
    next.onclose = () => {
      on.connected(false);
      setTimeout(open, AGAIN_MS);
    };
    next.onmessage = ({ data }) => {
      if (isClosed) return;
      on.heard();
      if (typeof data === "string") on.line(JSON.parse(data));
      else on.image(decode(data));
    };
  };
  open();
  return {
    ask: (request) => {
      if (socket?.readyState === WebSocket.OPEN) socket.send(JSON.stringify(request));
    },
    close: () => {
      isClosed = true;
      socket?.close();
    },
  };
}
