// The occupant: one mesh a segment, each made of convex hulls of two ellipsoids.

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  Group,
  InstancedMesh,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  Quaternion,
  SphereGeometry,
  Vector3,
} from "three";
import { ConvexGeometry } from "three/addons/geometries/ConvexGeometry.js";
import { mergeGeometries, mergeVertices } from "three/addons/utils/BufferGeometryUtils.js";
import { OTHER_TONES, TONES } from "./colors.js";
import { placeAt, poseAt } from "./pose.js";

/** Points round an ellipsoid, and rings of them. */
const ROUND = 14;
const RINGS = 7;
const GHOST_OPACITY = 0.35;

export class Figure {
  constructor(run, number) {
    this.run = run;
    this.group = new Group();
    this.material = new MeshLambertMaterial({ vertexColors: true });
    const tones = number === 0 ? TONES : OTHER_TONES[number - 1];
    this.meshes = run.segments.map((name, segment) => {
      const parts = run.parts.filter((part) => part.segment === segment);
      const mesh = new Mesh(shape(parts, tones), this.material);
      mesh.name = name;
      mesh.frustumCulled = false;
      this.group.add(mesh);
      return mesh;
    });
    this.spheres = buildSpheres(run);
    this.group.add(this.spheres);
  }

  move(at) {
    const count = this.meshes.length;
    this.meshes.forEach((mesh, segment) => {
      poseAt(this.run.poses, count, segment, at, mesh.position, mesh.quaternion);
      mesh.updateMatrix();
    });
    if (this.spheres.visible) this.moveSpheres(at);
  }

  /** Spheres that ride on parts of the body that give way go along with them. */
  moveSpheres(at) {
    const { spheres, ridden, carried } = this.run;
    const place = new Vector3();
    const matrix = new Matrix4();
    const own = new Matrix4();
    spheres.forEach((sphere, i) => {
      const r = sphere.radius;
      place.set(0, 0, 0);
      const rider = ridden.indexOf(i);
      if (rider >= 0) placeAt(carried, ridden.length, rider, at, place);
      const [x, y, z] = sphere.centre;
      own.makeScale(r, r, r).setPosition(x + place.x, y + place.y, z + place.z);
      matrix.multiplyMatrices(this.meshes[sphere.segment].matrix, own);
      this.spheres.setMatrixAt(i, matrix);
    });
    this.spheres.instanceMatrix.needsUpdate = true;
  }

  setGhost(ghost) {
    if (this.material.transparent === ghost) return;
    this.material.transparent = ghost;
    this.material.opacity = ghost ? GHOST_OPACITY : 1;
    this.material.depthWrite = !ghost;
    this.material.needsUpdate = true;
  }
}

function buildSpheres(run) {
  const material = new MeshLambertMaterial({
    color: 0xf2cc4d,
    transparent: true,
    opacity: 0.4,
    depthWrite: false,
  });
  const spheres = new InstancedMesh(new SphereGeometry(1, 18, 12), material, run.spheres.length);
  spheres.frustumCulled = false;
  return spheres;
}

/** Shapes that were made before: bodies of runs that follow each other are mostly the same. */
const SHAPES = new Map();
const MOST_SHAPES = 200;

/** The parts of a segment as one. */
function shape(parts, tones) {
  const key = JSON.stringify([parts, tones]);
  let made = SHAPES.get(key);
  if (!made) {
    made = mergeGeometries(parts.map((part) => hull(part, tones)));
    made.userData.isKept = true;
    if (SHAPES.size >= MOST_SHAPES) SHAPES.clear();
    SHAPES.set(key, made);
  }
  return made;
}

/** The convex hull of two ellipsoids, smooth, in one colour. */
function hull(part, tones) {
  const flat = new ConvexGeometry(part.ends.flatMap(ellipsoid));
  const bare = new BufferGeometry().setAttribute("position", flat.getAttribute("position"));
  const geometry = mergeVertices(bare, 1e-5);
  geometry.computeVertexNormals();
  const color = new Color(tones[part.tone]);
  const count = geometry.getAttribute("position").count;
  const colors = new Float32Array(count * 3);
  for (let i = 0; i < count; i++) color.toArray(colors, 3 * i);
  return geometry.setAttribute("color", new BufferAttribute(colors, 3));
}

/** Points on an ellipsoid [centre x, y, z, half axes x, y, z]; its poles lie along Z. */
function ellipsoid([x, y, z, a, b, c]) {
  const points = [new Vector3(x, y, z + c), new Vector3(x, y, z - c)];
  for (let ring = 1; ring < RINGS; ring++) {
    const height = Math.cos((Math.PI * ring) / RINGS);
    const width = Math.sin((Math.PI * ring) / RINGS);
    for (let i = 0; i < ROUND; i++) {
      const turn = (2 * Math.PI * i) / ROUND;
      points.push(
        new Vector3(x + a * width * Math.cos(turn), y + b * width * Math.sin(turn), z + c * height),
      );
    }
  }
  return points;
}

/** Where a segment is, in vehicle axes. */
export function segmentPlace(run, segment, at, place) {
  poseAt(run.poses, run.segments.length, segment, at, place, new Quaternion());
  return place;
}
