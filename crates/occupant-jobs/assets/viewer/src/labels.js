// Names beside what they name: surfaces, belts, and contacts with their force.

import { Vector3 } from "three";
import { element, figures } from "./dom.js";

/** Contacts with less force have no label, N. */
const LEAST_N = 5;
/** Size of a letter, of a line, and lines that a label may move down not to cover another. */
const LETTER_PX = 6.2;
const LINE_PX = 17;
const MOST_ROWS = 4;

export class Labels {
  constructor(place, actor, camera) {
    this.actor = actor;
    this.camera = camera;
    /** Size of a picture that is saved, else that of the page. */
    this.size = null;
    this.layer = element("div", { class: "labels", "aria-hidden": "true" });
    place.append(this.layer);
    this.shown = false;
    this.surfaces = actor.run.surfaces.map((surface) => {
      const label = element("span", { class: "label" }, surface.name);
      const centre = middle(surface.corners);
      return {
        label,
        centre,
        group: surface.frame === "vehicle" ? actor.car : actor.ground,
        surface,
      };
    });
    this.layer.append(...this.surfaces.map((s) => s.label));
    this.contacts = [];
  }

  show(shown) {
    this.shown = shown;
    this.layer.hidden = !shown;
  }

  /** Puts all labels where they belong now. */
  place() {
    if (!this.shown) return;
    const size = this.size ?? [this.layer.clientWidth, this.layer.clientHeight];
    this.taken = [];
    for (const { label, centre, group, surface } of this.surfaces) {
      const follows = surface.frame === "space" && !surface.bounded;
      label.hidden = follows || !this.actor.shown.surfaces;
      if (!label.hidden) this.put(label, centre.clone().applyMatrix4(group.matrixWorld), size);
    }
    this.placeContacts(size);
  }

  /** Those that are seen: text, and place of the upper left corner. */
  seen() {
    const all = [...this.surfaces.map(({ label }) => label), ...this.contacts];
    const seen = this.shown ? all.filter((label) => !label.hidden) : [];
    return seen.map((label) => ({ text: label.textContent, at: label.at }));
  }

  placeContacts(size) {
    const { start, sphere, surface, point, force } = this.actor.run.contacts;
    const { spheres, surfaces, force_unit } = this.actor.run;
    const [per, unit] = force_unit;
    const index = this.actor.at.index;
    const count = this.actor.shown.arrows ? start[index + 1] - start[index] : 0;
    while (this.contacts.length < count) {
      const label = element("span", { class: "label contact" });
      this.layer.append(label);
      this.contacts.push(label);
    }
    this.contacts.forEach((label, n) => {
      label.hidden = n >= count;
      if (label.hidden) return;
      const i = start[index] + n;
      const load = Math.hypot(force[3 * i], force[3 * i + 1], force[3 * i + 2]);
      label.hidden = load < LEAST_N;
      if (label.hidden) return;
      label.textContent = `${spheres[sphere[i]].name} – ${surfaces[surface[i]].name}: ${figures(load / 1e3 / per, 3)} ${unit}`;
      const at = new Vector3().fromArray(point, 3 * i).applyMatrix4(this.actor.car.matrixWorld);
      this.put(label, at, size);
    });
  }

  put(label, place, [width, height]) {
    const at = place.project(this.camera);
    label.hidden = label.hidden || at.z > 1;
    const x = (0.5 + 0.5 * at.x) * width;
    const y = (0.5 - 0.5 * at.y) * height;
    if (label.hidden) return;
    const wide = LETTER_PX * label.textContent.length + 6;
    const left = Math.max(0, Math.min(x, width - wide));
    const top = this.free(left, y, wide);
    label.hidden = top === null;
    label.at = [left, top];
    label.style.transform = `translate(${left.toFixed(1)}px, ${(top ?? y).toFixed(1)}px)`;
  }

  /** The nearest height at or below `top` where no other label is; none if that is far away. */
  free(left, top, wide) {
    for (let row = 0; row < MOST_ROWS; row++, top += LINE_PX) {
      const isTaken = this.taken.some(
        (other) =>
          left < other.right && left + wide > other.left && Math.abs(top - other.top) < LINE_PX,
      );
      if (isTaken) continue;
      this.taken.push({ left, right: left + wide, top });
      return top;
    }
    return null;
  }
}

function middle(corners) {
  const sum = new Vector3();
  for (const corner of corners) sum.add(new Vector3(...corner));
  return sum.divideScalar(corners.length);
}
