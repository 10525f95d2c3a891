// The connection to the program; its messages are described in host/cli/src/view/message.rs.

const AGAIN_MS = 1000;

/** Decodes a binary message to { frame, samples, replaced, missed, image, highest }. */
export function decode(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const values = new Uint16Array(buffer, 4 + length);
  const taxels = values.length / 2;
  return { ...head, image: values.subarray(0, taxels), highest: values.subarray(taxels) };
}

/** Connects, and reconnects. `on` has image(message), line(object), connected(boolean) and heard(). */
export function connect(on) {
  let socket = null;
  const open = () => {
    socket = new WebSocket(`ws://${location.host}/socket`);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => on.connected(true);
    socket.onclose = () => {
      on.connected(false);
      setTimeout(open, AGAIN_MS);
    };
    socket.onmessage = ({ data }) => {
      on.heard();
      if (typeof data === "string") on.line(JSON.parse(data));
      else on.image(decode(data));
    };
  };
  open();
  return { ask: (wish) => socket.readyState === WebSocket.OPEN && socket.send(JSON.stringify(wish)) };
}
