// The page on paper: light colours, plots as wide as a column, and a strip of pictures of the scene.

import { element, milliseconds } from "./dom.js";

/** Pictures of the strip. */
const PICTURES = 6;

/** Prepares the page before it is printed, and puts it back after. */
export function listenToPrint(strip, clock, stage, plots) {
  let before = 0;
  let folds = [];
  const prepare = () => {
    if (document.documentElement.classList.contains("paper")) return;
    clock.pause();
    before = clock.time;
    document.documentElement.classList.add("paper");
    folds = [
      ...document.querySelectorAll("#report details:not([open], .scenario, footer details)"),
    ];
    folds.forEach((fold) => (fold.open = true));
    stage?.paint();
    plots.fit();
    strip.replaceChildren(...(stage ? pictures(clock, stage) : []));
    clock.seek(before);
  };
  const restore = () => {
    document.documentElement.classList.remove("paper");
    stage?.paint();
    plots.fit();
    strip.replaceChildren();
    folds.forEach((fold) => (fold.open = false));
    clock.seek(before);
  };
  window.addEventListener("beforeprint", prepare);
  window.addEventListener("afterprint", restore);
}

function pictures(clock, stage) {
  return Array.from({ length: PICTURES }, (_, i) => {
    const time = clock.start + ((clock.end - clock.start) * i) / (PICTURES - 1);
    clock.seek(time);
    stage.render();
    const { width, height } = stage.canvas;
    const picture = element("canvas", { width, height });
    // drawn at once: an image would be decoded after the page is printed
    picture.getContext("2d").drawImage(stage.canvas, 0, 0);
    return element("figure", {}, picture, element("figcaption", {}, milliseconds(time)));
  });
}
