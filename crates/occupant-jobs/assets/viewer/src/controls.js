// Buttons and sliders below the stage.

import { SPEEDS } from "./clock.js";
import { nearest } from "./data.js";
import { element, figures, milliseconds } from "./dom.js";
import { CAMERAS } from "./cameras.js";
import { PRESETS, VIEWS } from "./eye.js";
import { film, noFilm, picture, tooLong } from "./film.js";

export function buildControls(root, clock, stage, runs) {
  root.append(buildPlayback(clock));
  if (stage)
    root.append(
      buildCamera(stage, runs[0]),
      buildToggles(stage, runs),
      buildFilm(root, stage, clock),
    );
}

function buildPlayback(clock) {
  const last = clock.times.length - 1;
  const play = element("button", { type: "button", class: "play", title: "Space" });
  const begin = element(
    "button",
    { type: "button", "aria-label": "To the begin", title: "Home" },
    "|◀",
  );
  const back = element(
    "button",
    { type: "button", "aria-label": "One output back", title: "←" },
    "◀",
  );
  const on = element("button", { type: "button", "aria-label": "One output on", title: "→" }, "▶");
  const scrub = element("input", {
    type: "range",
    class: "scrub",
    min: 0,
    max: last,
    step: 1,
    "aria-label": "Time",
  });
  const time = element("output", { class: "time", "aria-live": "off" });
  const speed = element("select", { "aria-label": "Speed" });
  for (const value of SPEEDS) speed.append(element("option", { value }, `${value}×`));
  const repeat = element("input", { type: "checkbox" });

  play.addEventListener("click", () => clock.toggle());
  begin.addEventListener("click", () => clock.seek(clock.start));
  back.addEventListener("click", () => clock.step(-1));
  on.addEventListener("click", () => clock.step(1));
  scrub.addEventListener("input", () => {
    clock.pause();
    clock.seek(clock.times[Number(scrub.value)]);
  });
  speed.addEventListener("change", () => clock.setSpeed(Number(speed.value)));
  repeat.addEventListener("change", () => clock.setRepeat(repeat.checked));
  clock.listen(() => {
    const word = clock.playing ? "Pause" : "Play";
    if (play.textContent !== word) play.textContent = word;
    scrub.value = nearest(clock.times, clock.time);
    scrub.setAttribute("aria-valuetext", milliseconds(clock.time));
    time.textContent = milliseconds(clock.time);
    speed.value = String(clock.speed);
  });
  const row = element("div", { class: "row" }, play, begin, back, on, time, speed);
  row.append(element("label", {}, repeat, "repeat"));
  return element("div", { class: "playback" }, scrub, row);
}

function buildCamera(stage, run) {
  const { eye } = stage;
  const key = (name) => PRESETS.indexOf(name) + 1;
  const option = (name) => {
    const words = name in CAMERAS ? `${name} – ${CAMERAS[name][0]}` : name;
    return element("option", { value: name }, `${words} (${key(name)})`);
  };
  const camera = element(
    "select",
    { id: "camera" },
    element("optgroup", { label: "Views" }, ...VIEWS.map(option)),
    element("optgroup", { label: "Cameras" }, ...Object.keys(CAMERAS).map(option)),
  );
  camera.addEventListener("change", () => eye.look(camera.value));
  const reset = element(
    "button",
    { type: "button", title: "Undo what was turned by hand: 0" },
    "Reset",
  );
  reset.addEventListener("click", () => eye.look(eye.preset));
  const follow = element("select", { id: "follow" });
  const choices = [
    ["-1", "the vehicle"],
    ...run.segments.map((name, i) => [String(i), `the ${name}`]),
    ["-2", "nothing"],
  ];
  for (const [value, name] of choices) follow.append(element("option", { value }, name));
  follow.value = String(eye.followed);
  follow.addEventListener("change", () => eye.setFollowed(Number(follow.value)));
  const world = element("select", { id: "world" });
  for (const name of ["vehicle", "ground"]) world.append(element("option", { value: name }, name));
  world.value = stage.world;
  world.addEventListener("change", () => stage.setWorld(world.value));
  eye.told = () => {
    camera.value = eye.preset;
    // cameras ride on what they belong to
    follow.disabled = world.disabled = eye.isCamera;
  };
  eye.told();
  return element(
    "div",
    { class: "row camera", role: "group", "aria-label": "Where it is seen from" },
    element("label", {}, "Camera ", camera),
    reset,
    element("label", {}, "follow ", follow),
    element("label", {}, "at rest ", world),
  );
}

function buildToggles(stage, runs) {
  const row = element("div", { class: "row toggles", role: "group", "aria-label": "Shown" });
  for (const name of Object.keys(stage.shown)) {
    const box = element("input", { type: "checkbox", id: `show-${name}` });
    box.checked = stage.shown[name];
    box.addEventListener("change", () => stage.show({ [name]: box.checked }));
    row.append(element("label", {}, box, name === "arrows" ? "contact forces" : name));
  }
  if (runs.length > 1) {
    const other = element("select", { id: "other" });
    for (const name of ["ghost", "beside", "hidden"])
      other.append(element("option", { value: name }, name));
    other.value = stage.other;
    other.addEventListener("change", () => stage.setOther(other.value));
    row.append(element("label", {}, runs.length > 2 ? "other runs " : "other run ", other));
  }
  const { greatest } = stage.actors[0].arrows;
  if (greatest > 0) {
    const [per, unit] = runs[0].force_unit;
    const text = `longest arrow ${figures(greatest / 1e3 / per, 3)} ${unit}`;
    row.append(element("span", { class: "hint" }, text));
  }
  return row;
}

function buildFilm(root, stage, clock) {
  const button = (name, title) => element("button", { type: "button", title }, name);
  const title = "From the begin to the end at this speed, from this camera, 25 pictures a second";
  const [save, still] = [button("Save film", title), button("Save picture", "This moment as PNG")];
  const said = element("output", { class: "hint" });
  const lacking = noFilm();
  save.disabled = lacking !== null;
  said.textContent = lacking ?? "";
  const row = element(
    "div",
    { class: "row film", role: "group", "aria-label": "Files" },
    save,
    still,
    said,
  );
  let [busy, goes] = [false, false];
  const isBusy = () => busy || stage.saving !== null;

  /** Does a job while nothing else can be changed, and offers its file. */
  const make = async (job) => {
    const others = [...root.children].filter((child) => child !== row);
    others.forEach((child) => (child.inert = true));
    // no counting aloud
    said.setAttribute("aria-live", "off");
    busy = true;
    const words = await job().then(
      (made) => (made ? saved(made) : "Stopped: no file."),
      (error) => `Not saved: ${error.message}`,
    );
    busy = false;
    said.setAttribute("aria-live", "polite");
    said.textContent = words;
    others.forEach((child) => (child.inert = false));
  };
  const told = (done, count) => {
    said.textContent = `picture ${done} of ${count}`;
    return goes;
  };
  save.addEventListener("click", async () => {
    if (goes) {
      goes = false;
      return;
    }
    if (isBusy()) return;
    const long = tooLong(clock);
    if (long) {
      said.textContent = long;
      return;
    }
    goes = true;
    save.textContent = "Stop";
    await make(() => film(stage, clock, told));
    goes = false;
    save.textContent = "Save film";
  });
  still.addEventListener("click", () => {
    if (!isBusy()) make(() => picture(stage, clock));
  });
  return row;
}

/** Offers a file, and says which. */
function saved({ blob, name, seconds }) {
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  const size = `${figures(blob.size / 1e6, 2)} MB`;
  return `Saved ${name}, ${seconds ? `${figures(seconds, 3)} s, ` : ""}${size}`;
}
