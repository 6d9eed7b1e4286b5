// Trails: where the centres of head, chest, pelvis, hands and knees have been, in the vehicle.

import {
  BufferAttribute,
  BufferGeometry,
  Group,
  Line,
  LineBasicMaterial,
  Quaternion,
  Vector3,
} from "three";
import { poseAt } from "./pose.js";
import { RUNS } from "./colors.js";

const WANTED = ["head", "chest", "pelvis", "right_hand", "left_hand", "right_knee", "left_knee"];

export class Trails {
  constructor(run, number) {
    this.group = new Group();
    const material = new LineBasicMaterial({ color: RUNS[number] });
    const own = run.spheres.filter((sphere) => WANTED.includes(sphere.name));
    this.lines = (own.length > 0 ? own : run.spheres).map((sphere) => {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(trail(run, sphere), 3));
      const line = new Line(geometry, material);
      line.frustumCulled = false;
      this.group.add(line);
      return line;
    });
  }

  move({ index }) {
    for (const line of this.lines) line.geometry.setDrawRange(0, index + 1);
  }
}

function trail(run, sphere) {
  const places = new Float32Array(3 * run.times.length);
  const at = new Vector3();
  const turn = new Quaternion();
  const centre = new Vector3();
  for (let index = 0; index < run.times.length; index++) {
    poseAt(run.poses, run.segments.length, sphere.segment, { index, fraction: 0 }, at, turn);
    centre
      .fromArray(sphere.centre)
      .applyQuaternion(turn)
      .add(at)
      .toArray(places, 3 * index);
  }
  return places;
}
