// What the camera looks at: views of the scene from a side, which follow the vehicle or a segment, and cameras by name.
// All of them go on by hand: orbit, pan and zoom.

import { Box3, Group, Matrix4, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { CAMERAS, camera, heightOf } from "./cameras.js";
import { segmentPlace } from "./figure.js";

/** From the middle of the scene to the camera; vehicle axes, Z down. */
const DIRECTIONS = {
  oblique: [0.75, 1, -0.55],
  side: [0, 1, 0],
  top: [0, 0.001, -1],
  front: [1, 0, 0],
};

export const VIEWS = Object.keys(DIRECTIONS);
/** In the order of their keys. */
export const PRESETS = [...VIEWS, ...Object.keys(CAMERAS)];

/** Cameras of one occupant. */
const OF_OCCUPANT = ["chase", "driver"];
/** Angle of the height of a view, degrees. */
const VIEW_DEG = 35;
/** Nearest and farthest that is drawn: least distances, and shares of the distance to the target. */
const NEAR = [0.05, 0.01];
const FAR = [200, 4];

export class Eye {
  constructor(lens, canvas, changed) {
    this.camera = lens;
    this.actors = [];
    this.occupant = "";
    /** What the camera rides on: orbits are in its axes. */
    this.carrier = new Group();
    this.carrier.matrixAutoUpdate = false;
    this.carrier.add(lens);
    lens.lookAt = lookWithin;
    this.controls = new OrbitControls(lens, canvas);
    this.controls.minDistance = 0.2;
    this.controls.addEventListener("change", () => {
      this.fitLens();
      changed();
    });
    this.controls.addEventListener("start", () => (this.isMoved = true));
    this.preset = "oblique";
    /** Whether it was moved by hand since it was chosen. */
    this.isMoved = false;
    /** How far behind the first run another stands, m. */
    this.behind = 0;
    /** -2 nothing, -1 the vehicle, else a segment. */
    this.followed = -1;
    /** Hears of each choice. */
    this.told = () => {};
  }

  /** Whether a camera by name is chosen, which has a carrier of its own. */
  get isCamera() {
    return this.preset in CAMERAS;
  }

  /** Other runs of the same scene. */
  setActors(actors) {
    this.actors = actors;
    if (this.followed >= actors[0].run.segments.length) this.followed = -1;
  }

  /** Fits a camera that was not moved by hand to the runs. */
  refit() {
    if (this.isCamera && !this.isMoved) this.look(this.preset);
  }

  /** The occupant that cameras belong to. */
  setOccupant(name) {
    if (this.occupant === name) return;
    this.occupant = name;
    if (OF_OCCUPANT.includes(this.preset)) this.look(this.preset);
  }

  /** Looks from one side at the whole scene, or from a camera by name. */
  look(preset) {
    this.preset = preset;
    this.isMoved = false;
    const seen = this.actors.filter(({ group }) => group.visible);
    this.chosen = this.isCamera ? camera(preset, seen, this.occupant) : null;
    this.follow();
    const { eye, target } = this.chosen?.lens ?? this.view(preset);
    this.camera.position.copy(eye);
    this.controls.target.copy(target);
    this.fitLens();
    this.controls.update();
    this.told();
  }

  /** The lens of a view, on a carrier that does not turn. */
  view(preset) {
    const box = this.bounds();
    const target = box.getCenter(new Vector3()).applyMatrix4(this.actors[0].car.matrixWorld);
    target.sub(new Vector3().setFromMatrixPosition(this.carrier.matrix));
    const radius = 0.5 * box.getSize(new Vector3()).length();
    const half = (0.5 * VIEW_DEG * Math.PI) / 180;
    const narrow = Math.min(1, this.camera.aspect);
    const distance = radius / Math.sin(Math.atan(Math.tan(half) * narrow));
    const direction = new Vector3(...DIRECTIONS[preset]).normalize();
    return { eye: target.clone().addScaledVector(direction, distance), target };
  }

  /** Where the body has been, in vehicle axes. */
  bounds() {
    const box = new Box3();
    const { poses } = this.actors[0].run;
    const place = new Vector3();
    for (let i = 0; i < poses.length; i += 7) box.expandByPoint(place.fromArray(poses, i));
    box.expandByScalar(0.25);
    box.min.x -= this.behind;
    return box;
  }

  setFollowed(followed) {
    const before = new Vector3().setFromMatrixPosition(this.carrier.matrix);
    this.followed = followed;
    if (this.isCamera) return;
    this.follow();
    const shift = before.sub(new Vector3().setFromMatrixPosition(this.carrier.matrix));
    if (followed >= 0) shift.copy(this.controls.target).negate();
    this.controls.target.add(shift);
    this.camera.position.add(shift);
    this.controls.update();
  }

  /** Moves the carrier to where it is now, and the camera with it. */
  follow() {
    const { matrix } = this.carrier;
    const now =
      this.chosen?.carrier(this.actors[0]) ?? matrix.clone().makeTranslation(this.followedPlace());
    // a run that failed may end nowhere
    if (now.elements.every(Number.isFinite)) matrix.copy(now);
    this.carrier.updateMatrixWorld(true);
  }

  followedPlace() {
    const [actor] = this.actors;
    const place = new Vector3();
    if (this.followed < -1) return place;
    if (this.followed >= 0) segmentPlace(actor.run, this.followed, actor.at, place);
    return place.applyMatrix4(actor.car.matrixWorld);
  }

  /** Fits the angle to the shape of the picture, and what is drawn to the distance. */
  fitLens() {
    const { camera: lens } = this;
    const away = lens.position.distanceTo(this.controls.target);
    const height = this.chosen && heightOf(this.chosen.lens.height, lens.aspect);
    lens.fov = height ? (height * 180) / Math.PI : VIEW_DEG;
    lens.near = Math.max(NEAR[0], NEAR[1] * away);
    lens.far = FAR[0] + FAR[1] * away;
    lens.updateProjectionMatrix();
  }

  /** Where the camera stands in the scene. */
  place() {
    return this.camera.position.clone().applyMatrix4(this.carrier.matrixWorld);
  }
}

/** Turns a camera to a target in the axes of its carrier. */
function lookWithin(target) {
  this.quaternion.setFromRotationMatrix(new Matrix4().lookAt(this.position, target, this.up));
}
