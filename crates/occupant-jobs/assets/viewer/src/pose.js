// Poses between outputs: straight lines for places, great arcs for attitudes.

import { Quaternion, Vector3 } from "three";
import { POSE } from "./data.js";

const from = new Vector3();
const turned = new Quaternion();

/** Place `item` of `count` a time, at a place found with `locate`, into `position`. */
export function placeAt(places, count, item, { index, fraction }, position) {
  const here = (index * count + item) * 3;
  position.fromArray(places, here);
  if (fraction > 0) position.lerp(from.fromArray(places, here + count * 3), fraction);
}

/** Pose `item` of `count` a time, at a place found with `locate`, into `position` and `quaternion`. */
export function poseAt(poses, count, item, { index, fraction }, position, quaternion) {
  const here = (index * count + item) * POSE;
  position.fromArray(poses, here);
  quaternion.fromArray(poses, here + 3);
  if (fraction === 0) return;
  const next = here + count * POSE;
  position.lerp(from.fromArray(poses, next), fraction);
  quaternion.slerp(turned.fromArray(poses, next + 3), fraction);
}
