// The 3-D stage. Scene axes are the vehicle's: X forward, Y right, Z down; metres.
//
// The stage draws only when something has changed.

import {
  Color,
  DirectionalLight,
  HemisphereLight,
  Matrix4,
  PerspectiveCamera,
  Quaternion,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import { Actor } from "./actor.js";
import { Resolution, drawsInSoftware } from "./resolution.js";
import { hideHeads } from "./cameras.js";
import { Eye } from "./eye.js";
import { Labels } from "./labels.js";
import { poseAt } from "./pose.js";
import { listenToTabs } from "./tabs.js";

/** How far behind the run before it each stands when they stand beside, m. */
const BESIDE_M = 2;

export class Stage {
  constructor(place, runs, clock) {
    this.place = place;
    this.frames = 0;
    this.shown = {
      surfaces: true,
      belts: true,
      arrows: true,
      trails: false,
      labels: false,
      spheres: false,
    };
    this.world = "vehicle";
    this.renderer = new WebGLRenderer({ antialias: !drawsInSoftware() });
    this.resolution = new Resolution(this.renderer, clock);
    this.pending = false;
    this.actors = [];
    this.gone = [];
    this.canvas = this.renderer.domElement;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", "The occupant in the compartment, in three dimensions");
    place.append(this.canvas);
    this.scene = new Scene();
    this.light();
    this.camera = new PerspectiveCamera();
    this.camera.up.set(0, 0, -1);
    this.eye = new Eye(this.camera, this.canvas, () => this.draw());
    this.scene.add(this.eye.carrier);
    /** Size of pictures that are saved, while they are: nothing else is drawn then. */
    this.saving = null;
    new ResizeObserver(() => this.resize()).observe(place);
    window
      .matchMedia("(prefers-color-scheme: dark)")
      .addEventListener("change", () => this.paint());
    this.paint();
    this.put(runs, clock);
    this.resize();
    this.show({});
    this.setOther(runs.length > 2 ? "beside" : "ghost");
    clock.listen(() => this.move());
    listenToTabs((name) => this.eye.setOccupant(name));
  }

  /** Shows other runs from where the camera is. */
  replace(runs, clock) {
    for (const actor of this.actors) this.scene.remove(actor.group);
    // released after the next picture: the programs that old and new share stay compiled
    this.gone.push(...this.actors);
    this.labels.layer.remove();
    const count = this.runs.length;
    this.put(runs, clock);
    this.show({});
    if (runs.length !== count) this.setOther(runs.length > 2 ? "beside" : "ghost");
    else this.eye.refit();
    clock.listen(() => this.move());
  }

  put(runs, clock) {
    this.runs = runs;
    this.clock = clock;
    this.resolution.clock = clock;
    this.actors = runs.map((run, number) => new Actor(run, number));
    this.actors.forEach((actor) => this.scene.add(actor.group));
    const greatest = Math.max(...this.actors.map((actor) => actor.arrows.greatest));
    this.actors.forEach((actor) => actor.arrows.setGreatest(greatest));
    this.eye.setActors(this.actors);
    this.labels = new Labels(this.place, this.actors[0], this.camera);
  }

  light() {
    const sky = new HemisphereLight(0xffffff, 0x9a9a9a, 2);
    sky.position.set(0, 0, -1);
    const sun = new DirectionalLight(0xffffff, 1.6);
    sun.position.set(1.5, -2, -4);
    this.scene.add(sky, sun);
  }

  paint() {
    const ground = getComputedStyle(document.documentElement).getPropertyValue("--stage").trim();
    this.scene.background = new Color(ground);
    this.draw();
  }

  resize() {
    const { clientWidth, clientHeight } = this.place;
    if (this.saving === null && clientWidth > 0 && clientHeight > 0)
      this.setSize(clientWidth, clientHeight);
    this.draw();
  }

  setSize(width, height) {
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.eye.fitLens();
  }

  /** Begins pictures of a size in pixels for files; `restore` puts the page's own size back. */
  save(size) {
    this.saving = size;
    this.eye.controls.enabled = false;
    this.resolution.set(1);
    this.setSize(...size);
  }

  restore() {
    this.saving = null;
    this.eye.controls.enabled = true;
    this.resolution.set(this.resolution.full);
    this.resize();
  }

  /** Changes what is shown: {surfaces: false}. */
  show(change) {
    Object.assign(this.shown, change);
    for (const actor of this.actors) actor.show(this.shown);
    this.labels.show(this.shown.labels);
    this.move();
  }

  /** Where the other runs are: "ghost", "beside" or "hidden". */
  setOther(other) {
    this.other = other;
    this.eye.behind = other === "beside" ? BESIDE_M * (this.runs.length - 1) : 0;
    this.move();
    this.eye.look(this.eye.preset);
  }

  /** What stands still: "vehicle" or "ground". */
  setWorld(world) {
    this.world = world;
    this.move();
  }

  /** Puts everything where it is at the clock's time. */
  move() {
    for (const [number, actor] of this.actors.entries()) {
      actor.move(this.clock.time);
      this.putVehicle(actor);
      if (number > 0) {
        actor.group.visible = this.other !== "hidden";
        actor.group.position.x = this.other === "beside" ? -BESIDE_M * number : 0;
        actor.setGhost(this.other === "ghost");
      }
    }
    this.eye.follow();
    this.draw();
  }

  /** The vehicle in its world, or the world round the vehicle. */
  putVehicle(actor) {
    const at = new Vector3();
    const turn = new Quaternion();
    poseAt(actor.run.vehicle, 1, 0, actor.at, at, turn);
    const pose = new Matrix4().compose(at, turn, new Vector3(1, 1, 1));
    const still = new Matrix4();
    const onGround = this.world === "ground";
    setMatrix(actor.car, onGround ? pose : still);
    setMatrix(actor.ground, onGround ? still : pose.invert());
    actor.group.updateMatrixWorld(true);
  }

  /** Draws now. */
  render() {
    const eye = this.eye.place();
    for (const actor of this.actors) hideHeads(actor, eye);
    this.renderer.render(this.scene, this.camera);
  }

  draw() {
    if (this.pending || this.saving !== null) return;
    this.pending = true;
    requestAnimationFrame((now) => {
      this.pending = false;
      if (this.saving !== null) return;
      this.resolution.drawn(now);
      this.render();
      this.labels.place();
      this.gone.splice(0).forEach((actor) => actor.release());
      this.frames += 1;
    });
  }
}

function setMatrix(group, matrix) {
  matrix.decompose(group.position, group.quaternion, group.scale);
}
