// Buttons and sliders below the stage.

import { SPEEDS } from "./clock.js";
import { nearest } from "./data.js";
import { element, figures, milliseconds } from "./dom.js";
import { PRESETS } from "./eye.js";

export function buildControls(root, clock, stage, runs) {
  root.append(buildPlayback(clock));
  if (stage) root.append(buildCamera(stage, runs[0]), buildToggles(stage, runs));
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
  const presets = PRESETS.map((name, i) => {
    const button = element("button", { type: "button", title: String(i + 1) }, name);
    button.addEventListener("click", () => stage.eye.look(name));
    return button;
  });
  const follow = element("select", { id: "follow" });
  const choices = [
    ["-1", "the vehicle"],
    ...run.segments.map((name, i) => [String(i), `the ${name}`]),
    ["-2", "nothing"],
  ];
  for (const [value, name] of choices) follow.append(element("option", { value }, name));
  follow.addEventListener("change", () => stage.eye.setFollowed(Number(follow.value)));
  const world = element("select", { id: "world" });
  for (const name of ["vehicle", "ground"]) world.append(element("option", { value: name }, name));
  world.addEventListener("change", () => stage.setWorld(world.value));
  return element(
    "div",
    { class: "row camera", role: "group", "aria-label": "Camera" },
    ...presets,
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
