// Names beside what they name: surfaces, belts, and contacts with their force.

import { Vector3 } from "three";
import { element, figures } from "./dom.js";

/** Contacts with less force have no label, N. */
const LEAST_N = 5;

export class Labels {
  constructor(place, actor, camera) {
    this.actor = actor;
    this.camera = camera;
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
    const size = [this.layer.clientWidth, this.layer.clientHeight];
    for (const { label, centre, group, surface } of this.surfaces) {
      const follows = surface.frame === "space" && !surface.bounded;
      label.hidden = follows || !this.actor.shown.surfaces;
      if (!label.hidden) this.put(label, centre.clone().applyMatrix4(group.matrixWorld), size);
    }
    this.placeContacts(size);
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
    label.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
  }
}

function middle(corners) {
  const sum = new Vector3();
  for (const corner of corners) sum.add(new Vector3(...corner));
  return sum.divideScalar(corners.length);
}
