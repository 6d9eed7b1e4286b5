// Belts: ribbons from anchor to anchor, as wide as webbing, upright on the plane in which the belt runs. What is closed is an
// outline: bags, other vehicles, and parts that move in the vehicle.

import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  Line,
  LineBasicMaterial,
  Mesh,
  MeshBasicMaterial,
  Vector3,
} from "three";
import { SLACK, TAUT } from "./colors.js";

const WIDTH_M = 0.046;
/** How much of a belt shows through the body. */
const THROUGH = 0.3;
/** Bend below which a course is straight, of its length. */
const STRAIGHT = 1e-4;

export class Belts {
  constructor(run) {
    this.group = new Group();
    this.ribbons = run.belts.map((belt) => (isClosed(belt) ? new Outline(belt) : new Ribbon(belt)));
    for (const ribbon of this.ribbons) this.group.add(...ribbon.meshes);
  }

  move(at) {
    for (const ribbon of this.ribbons) ribbon.move(at);
  }
}

function isClosed({ points, count }) {
  const last = 3 * (count - 1);
  return [0, 1, 2].every((axis) => points[axis] === points[last + axis]);
}

/** Puts the course of a belt between two outputs into `course`. */
function courseAt(belt, { index, fraction }, course) {
  const size = course.length;
  const here = belt.points.subarray(index * size, (index + 1) * size);
  const next = fraction > 0 ? belt.points.subarray((index + 1) * size) : here;
  for (let i = 0; i < size; i++) course[i] = here[i] + fraction * (next[i] - here[i]);
}

class Outline {
  constructor(belt) {
    this.belt = belt;
    this.places = new BufferAttribute(new Float32Array(3 * belt.count), 3);
    const geometry = new BufferGeometry().setAttribute("position", this.places);
    const line = new Line(geometry, new LineBasicMaterial({ color: SLACK }));
    line.frustumCulled = false;
    this.meshes = [line];
  }

  move(at) {
    courseAt(this.belt, at, this.places.array);
    this.places.needsUpdate = true;
  }
}

class Ribbon {
  constructor(belt) {
    this.belt = belt;
    this.count = belt.count;
    this.course = new Float32Array(3 * this.count);
    this.geometry = new BufferGeometry();
    this.places = new BufferAttribute(new Float32Array(6 * this.count), 3);
    this.geometry.setAttribute("position", this.places);
    this.geometry.setIndex(quads(this.count));
    const look = { side: DoubleSide, color: SLACK };
    this.solid = new MeshBasicMaterial(look);
    this.through = new MeshBasicMaterial({
      ...look,
      depthTest: false,
      transparent: true,
      opacity: THROUGH,
    });
    this.meshes = [this.solid, this.through].map((material) => new Mesh(this.geometry, material));
    for (const mesh of this.meshes) mesh.frustumCulled = false;
  }

  move(at) {
    courseAt(this.belt, at, this.course);
    this.spread();
    const color = this.belt.force[at.index] > 0 ? TAUT : SLACK;
    this.solid.color.setHex(color);
    this.through.color.setHex(color);
  }

  spread() {
    const first = new Vector3().fromArray(this.course, 0);
    const last = new Vector3().fromArray(this.course, 3 * (this.count - 1));
    const middle = new Vector3().fromArray(this.course, 3 * (this.count >> 1));
    const course = new Vector3().subVectors(last, first);
    const across = first.sub(middle).cross(last.sub(middle));
    // a straight part lies flat, or along the car where it is upright
    if (across.length() < STRAIGHT * course.lengthSq()) across.crossVectors(course, flat(course));
    across.setLength(0.5 * WIDTH_M);
    const out = this.places.array;
    for (let i = 0; i < this.count; i++) {
      for (let axis = 0; axis < 3; axis++) {
        const aside = across.getComponent(axis);
        out[6 * i + axis] = this.course[3 * i + axis] + aside;
        out[6 * i + 3 + axis] = this.course[3 * i + axis] - aside;
      }
    }
    this.places.needsUpdate = true;
  }
}

const UPRIGHT = 0.9;
const flat = (course) =>
  Math.abs(course.z) > UPRIGHT * course.length() ? new Vector3(0, 1, 0) : new Vector3(0, 0, 1);

/** Two triangles between each two points of the course. */
function quads(count) {
  const index = [];
  for (let i = 0; i + 1 < count; i++) {
    const a = 2 * i;
    index.push(a, a + 1, a + 2, a + 1, a + 3, a + 2);
  }
  return index;
}
