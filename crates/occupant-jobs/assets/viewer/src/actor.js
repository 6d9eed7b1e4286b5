// One run on the stage: its occupant, compartment, belts, arrows and trails.

import { Group } from "three";
import { locate } from "./data.js";
import { Figure } from "./figure.js";
import { buildSurfaces } from "./surfaces.js";
import { Belts } from "./belts.js";
import { Arrows } from "./arrows.js";
import { Trails } from "./trails.js";

export class Actor {
  constructor(run, number) {
    this.run = run;
    this.number = number;
    this.at = { index: 0, fraction: 0 };
    this.group = new Group();
    /** Moves with the vehicle. */
    this.car = new Group();
    /** Stays on the ground. */
    this.ground = new Group();
    this.group.add(this.car, this.ground);
    this.figure = new Figure(run, number);
    this.belts = new Belts(run, number);
    this.arrows = new Arrows(run, number);
    this.trails = new Trails(run, number);
    this.surfaces = [buildSurfaces(run, "vehicle"), buildSurfaces(run, "space")];
    this.car.add(
      this.surfaces[0],
      this.figure.group,
      this.belts.group,
      this.arrows.group,
      this.trails.group,
    );
    this.ground.add(this.surfaces[1]);
    this.ghost = false;
    this.shown = {};
  }

  /** Gives the memory of the drawing back. */
  release() {
    this.group.traverse((node) => {
      if (node.geometry && !node.geometry.userData.isKept) node.geometry.dispose();
      if (node.material) node.material.dispose();
    });
  }

  show(shown) {
    this.shown = shown;
    this.belts.group.visible = shown.belts;
    this.arrows.group.visible = shown.arrows;
    this.trails.group.visible = shown.trails;
    this.figure.spheres.visible = shown.spheres;
    this.showSurfaces();
  }

  /** A ghost is translucent and has no compartment of its own. */
  setGhost(ghost) {
    this.ghost = ghost;
    this.figure.setGhost(ghost);
    this.showSurfaces();
  }

  showSurfaces() {
    for (const group of this.surfaces) group.visible = Boolean(this.shown.surfaces) && !this.ghost;
  }

  move(time) {
    this.at = locate(this.run.times, time);
    this.figure.move(this.at);
    this.belts.move(this.at);
    this.arrows.move(this.at);
    this.trails.move(this.at);
    this.moveUnbounded();
  }

  /** Unbounded planes of the ground are drawn as a patch below the vehicle. */
  moveUnbounded() {
    const patches = this.surfaces[1].userData.patches;
    if (patches.length === 0) return;
    const [x, y, z] = this.run.vehicle.subarray(this.at.index * 7, this.at.index * 7 + 3);
    for (const { mesh, normal } of patches) {
      const off = normal[0] * x + normal[1] * y + normal[2] * z;
      mesh.position.set(x - off * normal[0], y - off * normal[1], z - off * normal[2]);
    }
  }
}
