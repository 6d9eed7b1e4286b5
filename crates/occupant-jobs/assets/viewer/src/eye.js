// The camera: orbit, pan and zoom by hand, presets, and following the vehicle or a segment.

import { Box3, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { segmentPlace } from "./figure.js";

/** From the middle of the scene to the camera; vehicle axes, Z down. */
const DIRECTIONS = {
  oblique: [0.75, 1, -0.55],
  side: [0, 1, 0],
  top: [0, 0.001, -1],
  front: [1, 0, 0],
};

export const PRESETS = Object.keys(DIRECTIONS);

export class Eye {
  constructor(camera, canvas, actor, changed) {
    this.camera = camera;
    this.actor = actor;
    this.controls = new OrbitControls(camera, canvas);
    this.controls.minDistance = 0.2;
    this.controls.maxDistance = 60;
    this.controls.addEventListener("change", changed);
    this.preset = "oblique";
    /** How far behind the first run another stands, m. */
    this.behind = 0;
    /** -2 nothing, -1 the vehicle, else a segment. */
    this.followed = -1;
    this.last = this.followedPlace();
  }

  /** Another run of the same scene. */
  setActor(actor) {
    this.actor = actor;
    if (this.followed >= actor.run.segments.length) this.followed = -1;
    this.last = this.followedPlace();
  }

  /** Looks at the whole scene from one side. */
  look(preset) {
    this.preset = preset;
    const box = this.bounds();
    const centre = box.getCenter(new Vector3()).applyMatrix4(this.actor.car.matrixWorld);
    const radius = 0.5 * box.getSize(new Vector3()).length();
    const half = (0.5 * this.camera.fov * Math.PI) / 180;
    const narrow = Math.min(1, this.camera.aspect);
    const distance = radius / Math.sin(Math.atan(Math.tan(half) * narrow));
    const direction = new Vector3(...DIRECTIONS[preset]).normalize();
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(direction, distance);
    this.controls.update();
    this.last = this.followedPlace();
  }

  /** Where the body has been, in vehicle axes. */
  bounds() {
    const box = new Box3();
    const { poses } = this.actor.run;
    const place = new Vector3();
    for (let i = 0; i < poses.length; i += 7) box.expandByPoint(place.fromArray(poses, i));
    box.expandByScalar(0.25);
    box.min.x -= this.behind;
    return box;
  }

  setFollowed(followed) {
    this.followed = followed;
    this.last = this.followedPlace();
    if (followed >= 0) {
      const shift = this.last.clone().sub(this.controls.target);
      this.controls.target.add(shift);
      this.camera.position.add(shift);
      this.controls.update();
    }
  }

  /** Moves the camera with what it follows. */
  follow() {
    const now = this.followedPlace();
    const shift = now.clone().sub(this.last);
    this.last = now;
    if (shift.lengthSq() === 0) return;
    this.controls.target.add(shift);
    this.camera.position.add(shift);
    this.controls.update();
  }

  followedPlace() {
    const place = new Vector3();
    if (this.followed < -1) return place;
    if (this.followed >= 0) segmentPlace(this.actor.run, this.followed, this.actor.at, place);
    return place.applyMatrix4(this.actor.car.matrixWorld);
  }
}
