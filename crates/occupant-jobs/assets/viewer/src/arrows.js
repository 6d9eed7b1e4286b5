// Contact forces on the body as arrows, where they act.

import {
  ConeGeometry,
  CylinderGeometry,
  Group,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  Quaternion,
  Vector3,
} from "three";
import { CONTACT } from "./colors.js";

/** Length of the arrow of the run's greatest force, m. */
const LONGEST_M = 0.5;
const SHORTEST_M = 0.01;
const THICK_M = 0.007;
const HEAD_M = 0.05;

export class Arrows {
  constructor(run) {
    this.contacts = run.contacts;
    const { start, force } = this.contacts;
    let most = 0;
    for (let i = 0; i + 1 < start.length; i++) most = Math.max(most, start[i + 1] - start[i]);
    let greatest = 0;
    for (let i = 0; i < force.length; i += 3) {
      greatest = Math.max(greatest, Math.hypot(force[i], force[i + 1], force[i + 2]));
    }
    this.setGreatest(greatest);
    // most contacts are behind or under the body: arrows show through it
    const material = new MeshBasicMaterial({ color: CONTACT, depthTest: false, transparent: true });
    const shaft = new CylinderGeometry(THICK_M, THICK_M, 1, 6).translate(0, 0.5, 0);
    const head = new ConeGeometry(2.6 * THICK_M, 1, 10).translate(0, 0.5, 0);
    this.shafts = new InstancedMesh(shaft, material, Math.max(most, 1));
    this.heads = new InstancedMesh(head, material, Math.max(most, 1));
    this.group = new Group();
    for (const mesh of [this.shafts, this.heads]) {
      mesh.frustumCulled = false;
      mesh.count = 0;
      mesh.renderOrder = 2;
      this.group.add(mesh);
    }
  }

  /** The force whose arrow is the longest, N: the same for all runs on the stage, so that arrows can be compared. */
  setGreatest(greatest) {
    this.greatest = greatest;
    this.scale = greatest > 0 ? LONGEST_M / greatest : 0;
  }

  move({ index }) {
    const { start, point, force } = this.contacts;
    const matrix = new Matrix4();
    const turn = new Quaternion();
    const up = new Vector3(0, 1, 0);
    let count = 0;
    for (let i = start[index]; i < start[index + 1]; i++) {
      const along = new Vector3().fromArray(force, 3 * i).multiplyScalar(this.scale);
      const length = along.length();
      if (length < SHORTEST_M) continue;
      const from = new Vector3().fromArray(point, 3 * i);
      const head = Math.min(HEAD_M, 0.6 * length);
      along.divideScalar(length);
      turn.setFromUnitVectors(up, along);
      matrix.compose(from, turn, new Vector3(1, length - head, 1));
      this.shafts.setMatrixAt(count, matrix);
      from.addScaledVector(along, length - head);
      matrix.compose(from, turn, new Vector3(1, head, 1));
      this.heads.setMatrixAt(count, matrix);
      count += 1;
    }
    for (const mesh of [this.shafts, this.heads]) {
      mesh.count = count;
      mesh.instanceMatrix.needsUpdate = true;
    }
  }
}
