// The worker: holds the module and meets one request after the other. It is made from its own text, so it stands alone.

export function work() {
  const TOLD_MS = 50;
  let ready = null;
  let told = 0;

  const progress = (share) => {
    const now = performance.now();
    if (now - told < TOLD_MS) return;
    told = now;
    postMessage({ share });
  };

  const meet = (own, { request, file }) => {
    if (file) {
      const at = own.reserve_file(file.length);
      new Uint8Array(own.memory.buffer).set(file, at);
    }
    const text = new TextEncoder().encode(request);
    const at = own.reserve(text.length);
    new Uint8Array(own.memory.buffer).set(text, at);
    let trap = null;
    try {
      own.answer();
    } catch (error) {
      trap = error;
    }
    // memory may have grown and moved
    const read = (from, length) => new Uint8Array(own.memory.buffer).slice(from, from + length);
    const json = new TextDecoder().decode(read(own.json(), own.json_length()));
    if (trap) return { trap: json || String(trap) };
    return { json, bytes: read(own.bytes(), own.bytes_length()) };
  };

  self.onmessage = async ({ data }) => {
    if (data.module) {
      ready = WebAssembly.instantiate(data.module, { page: { progress } });
      return;
    }
    try {
      const { exports } = await ready;
      const began = performance.now();
      const answer = meet(exports, data);
      answer.ms = performance.now() - began;
      postMessage(answer, answer.bytes ? [answer.bytes.buffer] : []);
    } catch (error) {
      postMessage({ trap: String(error) });
    }
  };
}
