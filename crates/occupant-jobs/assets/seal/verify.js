// compares the bytes of a chosen file with the seal at its end; loads nothing
(() => {
  const hex = async (bytes) =>
    [...new Uint8Array(await crypto.subtle.digest("SHA-256", bytes))]
      .map((b) => b.toString(16).padStart(2, "0")).join("");
  const judge = async (bytes) => {
    const text = new TextDecoder("latin1").decode(bytes);
    const begin = "<" + "!-- occupant seal 1\n";
    const at = text.lastIndexOf(begin);
    const lines = text.slice(at + begin.length).split("\n");
    if (at < 0 || lines.length !== 3 || !lines[1].endsWith(" --" + ">") || lines[2] !== "")
      return "ALTERED: the seal at the end of the file";
    const json = bytes.slice(at + begin.length, at + begin.length + lines[0].length);
    if ((await hex(json)) !== lines[1].slice(0, -4)) return "ALTERED: the list of the seal";
    let next = 0;
    const wrong = [];
    for (const s of JSON.parse(new TextDecoder().decode(json))) {
      if (s.start !== next) return "ALTERED: the sections do not lie end to end";
      next += s.length;
      if ((await hex(bytes.slice(s.start, next))) !== s.sha256)
        wrong.push(`ALTERED: ${s.name}, bytes ${s.start} to ${next}`);
    }
    if (next !== at) return "ALTERED: bytes before the seal that it does not list";
    return wrong.join("\n") || `Every byte is as sealed.\nSHA-256 of the file: ${await hex(bytes)}`;
  };
  document.getElementById("seal-file").addEventListener("change", async (event) => {
    const answer = document.getElementById("seal-answer");
    try {
      answer.textContent = await judge(new Uint8Array(await event.target.files[0].arrayBuffer()));
    } catch (error) {
      answer.textContent = `ALTERED or unreadable: ${error}`;
    }
  });
})();
