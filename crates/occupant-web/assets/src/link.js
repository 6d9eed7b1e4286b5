// The scenario in the fragment of the address: nothing of it goes to a server.

const PREFIX = "#s=";

/** The state as a fragment. */
export async function toFragment(state) {
  const text = JSON.stringify(state);
  const packed = await through(new Blob([text]), new CompressionStream("deflate-raw"));
  let binary = "";
  for (const byte of packed) binary += String.fromCharCode(byte);
  return PREFIX + btoa(binary).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

/** The state of a fragment; null without one, or with one that is none. */
export async function fromFragment(fragment) {
  if (!fragment.startsWith(PREFIX)) return null;
  try {
    const base64 = fragment.slice(PREFIX.length).replace(/-/g, "+").replace(/_/g, "/");
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const text = await through(new Blob([bytes]), new DecompressionStream("deflate-raw"));
    return checked(JSON.parse(new TextDecoder().decode(text)));
  } catch {
    return null;
  }
}

/** Only what has the shape of a state is one. */
function checked(state) {
  const isText = (value) => typeof value === "string";
  const isTable = (value) =>
    value !== null && typeof value === "object" && Object.values(value).every(isText);
  const isGood =
    isText(state.name) && isText(state.text) && isTable(state.set) && isTable(state.tables);
  return isGood ? state : null;
}

async function through(blob, stream) {
  return new Uint8Array(await new Response(blob.stream().pipeThrough(stream)).arrayBuffer());
}
