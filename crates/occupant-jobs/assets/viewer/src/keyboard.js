// Keys: space, arrows, home, end, + and −, 1 to 8 and 0.

import { PRESETS } from "./eye.js";

/** Outputs that an arrow with shift skips. */
const LEAP = 10;

/** Keys pressed within `root` move the clock and the camera that `now` gives. */
export function listenToKeys(now, root = document) {
  root.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || isTaken(event)) return;
    const { clock, stage } = now();
    if (stage?.saving) return;
    const act = action(event, clock, stage);
    if (!act) return;
    event.preventDefault();
    act();
  });
}

/** Whether the focused element wants the key for itself. */
function isTaken(event) {
  const { tagName, type } = event.target;
  if (tagName === "SELECT" || tagName === "TEXTAREA") return true;
  if (tagName === "BUTTON" || tagName === "SUMMARY" || type === "checkbox")
    return event.key === " ";
  return false;
}

function action(event, clock, stage) {
  const leap = event.shiftKey ? LEAP : 1;
  switch (event.key) {
    case " ":
      return () => clock.toggle();
    case "ArrowLeft":
      return () => clock.step(-leap);
    case "ArrowRight":
      return () => clock.step(leap);
    case "Home":
      return () => clock.seek(clock.start);
    case "End":
      return () => clock.seek(clock.end);
    case "+":
      return () => clock.shiftSpeed(1);
    case "-":
      return () => clock.shiftSpeed(-1);
    case "0":
      return stage && (() => stage.eye.look(stage.eye.preset));
    default: {
      const preset = PRESETS[Number(event.key) - 1];
      return stage && preset ? () => stage.eye.look(preset) : null;
    }
  }
}
