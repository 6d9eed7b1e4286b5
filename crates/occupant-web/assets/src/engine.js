// The simulator: the module unpacked from the page, and workers that hold it.

import { work } from "./worker.js";

/** The module in this page: base64 of gzip. */
export async function unpack(text) {
  const binary = atob(text.replace(/\s/g, ""));
  const packed = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) packed[i] = binary.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  // compiled while it is unpacked
  const headers = { "Content-Type": "application/wasm" };
  return WebAssembly.compileStreaming(new Response(stream, { headers }));
}

/** A request that was given up for a later one. */
export class GivenUp extends Error {}

/** A worker with the module. It meets one request at a time. */
export class Engine {
  constructor(module) {
    this.module = module;
    this.source = URL.createObjectURL(
      new Blob([`(${work.toString()})()`], { type: "text/javascript" }),
    );
    this.begin();
  }

  begin() {
    this.worker = new Worker(this.source);
    this.worker.postMessage({ module: this.module });
    this.last = Promise.resolve();
    this.current = null;
  }

  /** Asks after all that was asked before; `told` hears shares of what is done; `file` are bytes to open. */
  ask(request, told = () => {}, file = null) {
    const worker = this.worker;
    const asked = this.last.then(() => this.meet(worker, request, told, file));
    this.last = asked.catch(() => {});
    return asked;
  }

  meet(worker, request, told, file) {
    return new Promise((done, failed) => {
      if (worker !== this.worker) {
        failed(new GivenUp());
        return;
      }
      this.current = { failed };
      worker.onmessage = ({ data }) => {
        if (data.share !== undefined) {
          told(data.share);
          return;
        }
        this.current = null;
        if (data.trap) {
          this.begin();
          failed(new Error(data.trap));
          return;
        }
        const answer = JSON.parse(data.json);
        if (answer.refused) failed(new Refused(answer.refused));
        else done({ answer, bytes: data.bytes, ms: data.ms });
      };
      worker.onerror = (event) => failed(new Error(event.message));
      worker.postMessage({ request: JSON.stringify(request), file });
    });
  }

  /** Ends the worker. */
  end() {
    this.worker.terminate();
    URL.revokeObjectURL(this.source);
  }

  /** Gives up what is under way. */
  stop() {
    if (!this.current) return;
    const { failed } = this.current;
    this.worker.terminate();
    this.begin();
    failed(new GivenUp());
  }
}

/** What the simulator does not accept, with its problems. */
export class Refused extends Error {
  constructor({ words, problems }) {
    super(words);
    this.problems = problems;
  }
}
