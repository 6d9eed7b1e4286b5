// Surfaces: translucent plates with edges. All bounded ones of a frame are one mesh and one set of lines.

import {
  BufferGeometry,
  Color,
  DoubleSide,
  Float32BufferAttribute,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
} from "three";
import { MATERIALS } from "./colors.js";

/** Surfaces fixed to a frame, "vehicle" or "space"; `userData.patches` lists those that follow the vehicle. */
export function buildSurfaces(run, frame) {
  const group = new Group();
  group.userData.patches = [];
  const own = run.surfaces.filter((surface) => surface.frame === frame);
  const follows = (surface) => frame === "space" && !surface.bounded;
  const fixed = own.filter((surface) => !follows(surface));
  if (fixed.length > 0) group.add(...plates(fixed));
  for (const surface of own.filter(follows)) {
    const mesh = new Group();
    mesh.add(...plates([surface]));
    group.add(mesh);
    group.userData.patches.push({ mesh, normal: surface.normal });
  }
  return group;
}

function plates(surfaces) {
  const places = [];
  const colors = [];
  const edges = [];
  const edgeColors = [];
  for (const { corners, material } of surfaces) {
    const color = new Color(MATERIALS[material % MATERIALS.length]);
    for (let i = 1; i + 1 < corners.length; i++) {
      for (const corner of [corners[0], corners[i], corners[i + 1]]) {
        places.push(...corner);
        colors.push(color.r, color.g, color.b);
      }
    }
    corners.forEach((corner, i) => {
      edges.push(...corner, ...corners[(i + 1) % corners.length]);
      edgeColors.push(color.r, color.g, color.b, color.r, color.g, color.b);
    });
  }
  const plate = new Mesh(
    colored(places, colors),
    new MeshBasicMaterial({
      vertexColors: true,
      transparent: true,
      opacity: 0.22,
      side: DoubleSide,
      depthWrite: false,
    }),
  );
  const lines = new LineSegments(
    colored(edges, edgeColors),
    new LineBasicMaterial({ vertexColors: true }),
  );
  return [plate, lines];
}

function colored(places, colors) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(places, 3));
  geometry.setAttribute("color", new Float32BufferAttribute(colors, 3));
  return geometry;
}
