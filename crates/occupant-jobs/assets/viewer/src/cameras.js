// Cameras by name: those of `occupant view --3d`, with the same numbers.
//
// A camera rides on a carrier whose axes are X forward, Y right, Z down: the vehicle, the ground, a level frame at the
// occupant, or the occupant's head. Its lens does not move on the carrier.

import { Matrix4, Quaternion, Vector3 } from "three";
import { segmentPlace } from "./figure.js";
import { placeAt, poseAt } from "./pose.js";

/** What each does, and what a caption says of it. */
export const CAMERAS = {
  vehicle: ["rides with the car", "camera fixed to the vehicle"],
  ground: ["sees the whole path", "camera fixed to the ground"],
  chase: ["behind the occupant", "camera behind the occupant"],
  driver: ["the eye of the occupant", "seen by the occupant"],
};

/** Angle of the picture's height: of all cameras, and of an occupant's eye, rad. */
const HEIGHT_RAD = 0.56;
const EYE_RAD = 1.25;
/** Share of the picture that what must be seen may take. */
const WITHIN = 0.76;
/** Least width of a picture over its height. */
const WIDE = 1.5;
/** Distance from the place of the first moment beyond which a camera in the car lets people go, m. */
const LET_GO_M = 1.6;
/** Chase: behind, beside and above, m. */
const CHASE_M = [6, 2.2, 2];
/** Most moments looked at for a camera that must see all. */
const MOMENTS = 60;
/** The eye from the middle of a skull, in its radii; of a head without a sphere in m. */
const EYE = 0.9;
const EYE_M = 0.09;
/** Radii from the middle of a skull within which a camera does not see it. */
const WITHIN_SKULL = 1.3;

/** A lens on its carrier: eye and target in m, angle of the height of a picture that is wide enough. */
const lens = (eye, target, height = HEIGHT_RAD) => ({ eye, target, height });

/** A camera that was chosen, for the runs that are seen and the chosen occupant: its lens and its carrier. */
export function camera(name, actors, occupant) {
  const [{ run }] = actors;
  const head = headOf(run, occupant);
  if (name === "ground")
    return { lens: ground(actors), carrier: (actor) => actor.ground.matrixWorld };
  if (name === "chase") {
    const [behind, beside, above] = CHASE_M;
    const sight = lens(new Vector3(-behind, beside, -above), new Vector3(0.5, 0, 0));
    return { lens: sight, carrier: (actor) => level(actor, occupant) };
  }
  if (name === "driver" && head !== null) {
    // a little downward, as drivers look at the road
    const sight = lens(new Vector3(), new Vector3(1, 0, 0.12), EYE_RAD);
    return { lens: sight, carrier: (actor) => eyeOf(actor, headOf(actor.run, occupant) ?? head) };
  }
  return { lens: riding(actors), carrier: (actor) => actor.car.matrixWorld };
}

/** Angle that covers the height of a picture, rad: a narrow one shows more above and below, not less beside. */
export const heightOf = (height, aspect) =>
  2 * Math.atan(Math.tan(0.5 * height) * Math.max(1, WIDE / aspect));

/** The segment of the head of an occupant, else of the first that has one. */
function headOf(run, occupant) {
  const own = run.occupants.find((one) => one.name === occupant)?.head ?? null;
  return own ?? run.occupants.find((one) => (one.head ?? null) !== null)?.head ?? null;
}

/** Heads are not drawn by a camera within them. */
export function hideHeads(actor, eye) {
  for (const { head } of actor.run.occupants) {
    const mesh = actor.figure.meshes[head];
    if (!mesh) continue;
    const [centre, radius] = skull(actor.run, head);
    const middle = centre.applyMatrix4(mesh.matrix).applyMatrix4(actor.car.matrixWorld);
    mesh.visible = middle.distanceTo(eye) > WITHIN_SKULL * radius;
  }
}

/** Middle and radius of the first sphere of a head, axes of the segment. */
function skull(run, head) {
  const sphere = run.spheres.find((own) => own.segment === head);
  return sphere ? [new Vector3(...sphere.centre), sphere.radius] : [new Vector3(), EYE_M / EYE];
}

/** The eye of a head in the scene; the segment's axes are X forward, Z up. */
function eyeOf(actor, head) {
  const [middle, radius] = skull(actor.run, head);
  const pose = poseOf(actor.run.poses, actor.run.segments.length, head, actor.at);
  const eye = middle.add(new Vector3(EYE * radius, 0, 0));
  const turned = new Matrix4().makeRotationX(Math.PI).setPosition(eye);
  return turned.premultiply(pose).premultiply(actor.car.matrixWorld);
}

/** A level frame at the middle of an occupant, forward as the vehicle points on the ground. */
function level(actor, occupant) {
  const { run, at } = actor;
  const pose = poseOf(run.vehicle, 1, 0, at);
  const ahead = heading(pose);
  const frame = new Matrix4().makeBasis(ahead, rightOf(ahead), new Vector3(0, 0, 1));
  const middle = firstMiddle(run, at, occupant).applyMatrix4(pose);
  return frame.setPosition(middle).premultiply(actor.ground.matrixWorld);
}

function poseOf(poses, count, item, at) {
  const place = new Vector3();
  const turn = new Quaternion();
  poseAt(poses, count, item, at, place, turn);
  return new Matrix4().compose(place, turn, new Vector3(1, 1, 1));
}

/** The vehicle's direction on the ground. */
function heading(pose) {
  const ahead = new Vector3().setFromMatrixColumn(pose, 0).setZ(0);
  return ahead.length() > 0.2 ? ahead.normalize() : new Vector3(1, 0, 0);
}

const rightOf = (ahead) => new Vector3(-ahead.y, ahead.x, 0);

/** Centres of the spheres at a moment, vehicle axes. */
function places(run, at) {
  const carried = new Vector3();
  const poses = run.segments.map((_, i) => poseOf(run.poses, run.segments.length, i, at));
  return run.spheres.map(({ segment, centre }, i) => {
    const rider = run.ridden.indexOf(i);
    if (rider >= 0) placeAt(run.carried, run.ridden.length, rider, at, carried);
    else carried.set(0, 0, 0);
    return new Vector3(...centre).add(carried).applyMatrix4(poses[segment]);
  });
}

/** Middle of some places. */
function middle(all) {
  return all.reduce((sum, place) => sum.add(place), new Vector3()).divideScalar(all.length || 1);
}

/** Centres of the spheres; of a body without any the places of its segments. */
function centres(run, at) {
  if (run.spheres.length > 0) return places(run, at);
  return run.segments.map((_, i) => segmentPlace(run, i, at, new Vector3()));
}

/** Middle of one body alone: a second vehicle's people are far away. */
function firstMiddle(run, at, occupant = "") {
  const all = centres(run, at);
  const own = run.spheres.findIndex((sphere) => sphere.name.startsWith(`${occupant}.`));
  const first = all[Math.max(own, 0)] ?? middle(all);
  const near = all.filter((place) => place.distanceTo(first) < LET_GO_M);
  return near.length > 0 ? middle(near) : first;
}

/** Some outputs of a run, the first among them. */
function moments(run) {
  const every = Math.max(1, Math.ceil(run.times.length / MOMENTS));
  const count = Math.ceil(run.times.length / every);
  return Array.from({ length: count }, (_, i) => ({ index: i * every, fraction: 0 }));
}

const START = { index: 0, fraction: 0 };

/** From the front right, near enough that those who stay are in the picture; other runs where they stand. */
function riding(actors) {
  const points = actors.flatMap(({ run, group }) => {
    const first = firstMiddle(run, START);
    const near = moments(run).flatMap((at) =>
      round(run, places(run, at), at).filter(([place]) => place.distanceTo(first) < LET_GO_M),
    );
    return near.map(([place, radius]) => [place.add(group.position), radius]);
  });
  const { run } = actors[0];
  return fit(points, firstMiddle(run, START), new Vector3(1, 1.05, -0.42));
}

/** From beside the path, far enough that all of it is in the picture. */
function ground(actors) {
  const points = actors.flatMap(({ run, group }) =>
    moments(run).flatMap((at) => {
      const pose = poseOf(run.vehicle, 1, 0, at);
      const people = round(run, places(run, at)).map(([place, r]) => [place.applyMatrix4(pose), r]);
      const corners = outsides(run, at, pose).map((place) => [place, 0]);
      return [...people, ...corners].map(([place, r]) => [place.add(group.position), r]);
    }),
  );
  const { run } = actors[0];
  const pose = poseOf(run.vehicle, 1, 0, START);
  const ahead = heading(pose);
  const from = rightOf(ahead)
    .addScaledVector(ahead, 0.35)
    .add(new Vector3(0, 0, -0.55));
  return fit(points, middle(centres(run, START)).applyMatrix4(pose), from);
}

/** Places of spheres with their radii. */
const round = (run, all) => all.map((place, i) => [place, run.spheres[i].radius]);

/** Corners of the exteriors of vehicles at a moment, on the ground; those of other vehicles are closed lines. */
function outsides(run, { index }, pose) {
  const plates = run.surfaces
    .filter((surface) => surface.outside)
    .flatMap(({ frame, corners }) =>
      corners.map((corner) => {
        const place = new Vector3(...corner);
        return frame === "vehicle" ? place.applyMatrix4(pose) : place;
      }),
    );
  const lines = run.belts
    .filter(({ name }) => name.endsWith("outside"))
    .flatMap(({ points, count }) =>
      Array.from({ length: count }, (_, i) =>
        new Vector3().fromArray(points, 3 * (index * count + i)).applyMatrix4(pose),
      ),
    );
  return [...plates, ...lines];
}

/** A lens in a direction from the middle of points, as near as all of them are in the picture's middle. */
function fit(points, otherwise, from) {
  const low = new Vector3().setScalar(Infinity);
  const high = new Vector3().setScalar(-Infinity);
  const at = new Vector3();
  const sound = points.filter(([place]) => Number.isFinite(place.x + place.y + place.z));
  for (const [place, radius] of sound) {
    low.min(at.copy(place).subScalar(radius));
    high.max(at.copy(place).addScalar(radius));
  }
  const target = sound.length > 0 ? low.add(high).multiplyScalar(0.5) : otherwise;
  const back = from.normalize();
  const right = new Vector3(0, 0, -1).cross(back).normalize();
  const above = back.clone().cross(right);
  const slope = WITHIN * Math.tan(0.5 * HEIGHT_RAD);
  let away = 1.2;
  for (const [place, radius] of sound) {
    const off = at.subVectors(place, target);
    const aside = (Math.abs(right.dot(off)) + radius) / WIDE;
    const upward = Math.abs(above.dot(off)) + radius;
    away = Math.max(away, Math.max(aside, upward) / slope + back.dot(off));
  }
  return lens(target.clone().addScaledVector(back, away), target);
}
