// The ground in plan: ways of thrown bodies to scale, and their contacts with it.

import { element, figures, milliseconds } from "./dom.js";
import { locate } from "./data.js";

const NS = "http://www.w3.org/2000/svg";
/** Width of a plan, and room around what it shows. */
const WIDTH = 640;
const ROOM = 46;
/** Lowest and highest plan. */
const HEIGHTS = [150, 420];

function svg(name, attributes, ...children) {
  const node = document.createElementNS(NS, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  node.append(...children);
  return node;
}

/** The plan of a run; none without a throw. */
export function buildPlan(run) {
  const { ways, contacts } = run.ground;
  if (ways.length === 0) return null;
  const places = ways.flatMap((way) => way.points.map(([, x, y]) => [x, y]));
  const from = Math.min(...ways.map((way) => way.marks[0][1]));
  const touched = contacts.filter((contact) => contact.time_s >= from);
  const all = places.concat(touched.map((contact) => contact.place_m));
  const [lowX, highX, lowY, highY] = bounds(all);
  const span = Math.max(highX - lowX, 0.5);
  const scale = (WIDTH - 2 * ROOM) / Math.max(span, (highY - lowY) * 1.6, 0.5);
  const height = Math.min(Math.max((highY - lowY) * scale + 2 * ROOM, HEIGHTS[0]), HEIGHTS[1]);
  const middle = [(lowX + highX) / 2, (lowY + highY) / 2];
  // space: X ahead, Y left, seen from above
  const at = ([x, y]) => [
    WIDTH / 2 + (x - middle[0]) * scale,
    height / 2 - (y - middle[1]) * scale,
  ];
  const picture = svg("svg", {
    viewBox: `0 0 ${WIDTH} ${height.toFixed(0)}`,
    class: "plan",
    role: "img",
    "aria-label": "Ways of thrown bodies on the ground, in plan",
  });
  for (const contact of touched) {
    const [cx, cy] = at(contact.place_m);
    const dot = svg("circle", { cx, cy, r: 3, class: "touch" });
    dot.append(
      svg("title", {}, `${contact.part} on ${contact.surface}, ${milliseconds(contact.time_s)}`),
    );
    picture.append(dot);
  }
  ways.forEach((way) => picture.append(...drawWay(way, at, ways.length > 1)));
  picture.append(...ruler(scale, height, run.length_unit));
  return picture;
}

function bounds(places) {
  const range = (i) => {
    const values = places.map((place) => place[i]);
    return [values.reduce((a, b) => Math.min(a, b)), values.reduce((a, b) => Math.max(a, b))];
  };
  return [...range(0), ...range(1)];
}

function placeAt(way, time) {
  const { index, fraction } = locate(
    way.points.map((point) => point[0]),
    time,
  );
  const here = way.points[index];
  const next = way.points[Math.min(index + 1, way.points.length - 1)];
  return [1, 2].map((i) => here[i] + fraction * (next[i] - here[i]));
}

function drawWay(way, at, several) {
  const line = way.points
    .map(([, x, y]) =>
      at([x, y])
        .map((v) => v.toFixed(1))
        .join(","),
    )
    .join(" ");
  const drawn = [svg("polyline", { points: line, class: "way" })];
  way.marks.forEach(([name, time], i) => {
    const [x, y] = at(placeAt(way, time));
    const whose = several && i === 0 ? `${way.occupant}: ` : "";
    // one above and one below the way, each at its own height
    const dy = (i % 2 === 0 ? -1 : 1) * (i < 2 ? 14 : 28) + 4;
    const anchor = x < WIDTH * 0.25 ? "start" : x > WIDTH * 0.75 ? "end" : "middle";
    drawn.push(
      svg("circle", { cx: x, cy: y, r: 4.5, class: "place" }),
      svg("line", { x1: x, y1: y, x2: x, y2: y + dy - (dy > 0 ? 10 : -2), class: "lead" }),
      svg(
        "text",
        { x, y: y + dy, "text-anchor": anchor },
        `${whose}${name}, ${milliseconds(time)}`,
      ),
    );
  });
  return drawn;
}

/** A bar of a round length, with the direction ahead. */
function ruler(scale, height, [metres, symbol]) {
  const room = (0.25 * WIDTH) / scale / metres;
  const power = 10 ** Math.floor(Math.log10(room));
  const length = [5, 2, 1].find((n) => n * power <= room) * power;
  const end = 12 + length * metres * scale;
  const y = height - 10;
  return [
    svg("path", { d: `M12 ${y - 5}V${y}H${end.toFixed(1)}V${y - 5}`, class: "ruler" }),
    svg(
      "text",
      { x: end + 6, y },
      `${figures(length, 2)} ${symbol}; X ahead is to the right, seen from above`,
    ),
  ];
}

/** Contacts with the ground, in the order of time; `table` and `timeCell` are those of the page. */
export function groundRows(run, clock, timeCell) {
  const [metres, symbol] = run.length_unit;
  const [m_s, speed] = run.speed_unit;
  return run.ground.contacts.map((contact) =>
    element(
      "tr",
      {},
      timeCell(contact.time_s, clock),
      element("td", {}, contact.part.replaceAll("_", " ")),
      element("td", {}, contact.surface),
      element(
        "td",
        { class: "number" },
        `${contact.place_m
          .slice(0, 2)
          .map((v) => figures(v / metres, 4))
          .join(", ")} ${symbol}`,
      ),
      element(
        "td",
        { class: "number" },
        contact.speed_m_s === null
          ? "at the start"
          : `${figures(contact.speed_m_s / m_s, 3)} ${speed}`,
      ),
    ),
  );
}
