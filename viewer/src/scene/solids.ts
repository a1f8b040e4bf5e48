// Shapes of rigid bodies: boxes, cylinders, ellipsoids, and sticks for bodies of which only points are known.

import { BoxGeometry, BufferAttribute, BufferGeometry, CylinderGeometry, EdgesGeometry, Group, type LineBasicMaterial, LineSegments, Mesh, type MeshPhongMaterial, SphereGeometry } from 'three';
import type { SolidData } from '../data/scene_data';
import type { Triple } from '../data/page';
import { bar } from './symbols';

const AROUND = 48;

/** The rims of a cylinder, and two lines across each end, so that its turning is seen. */
function cylinderEdges(): BufferGeometry {
  const places: number[] = [];
  for (const z of [-0.5, 0.5]) {
    for (let k = 0; k < AROUND; ++k) {
      for (const step of [k, k + 1]) places.push(0.5 * Math.cos((2 * Math.PI * step) / AROUND), 0.5 * Math.sin((2 * Math.PI * step) / AROUND), z);
    }
    places.push(-0.5, 0, z, 0.5, 0, z, 0, -0.5, z, 0, 0.5, z);
  }
  return new BufferGeometry().setAttribute('position', new BufferAttribute(new Float32Array(places), 3));
}

export function buildSolid(solid: SolidData, material: MeshPhongMaterial, lines: LineBasicMaterial): Group {
  const group = new Group();
  group.position.set(...solid.position);
  group.quaternion.set(...solid.quaternion);
  const geometry = solid.kind === 'box' ? new BoxGeometry(1, 1, 1) : solid.kind === 'cylinder' ? new CylinderGeometry(0.5, 0.5, 1, AROUND).rotateX(Math.PI / 2) : new SphereGeometry(0.5, 40, 24);
  group.scale.set(...(solid.size.map((x) => Math.max(Math.abs(x), 1e-9)) as Triple));
  group.add(new Mesh(geometry, material));
  if (solid.kind !== 'ellipsoid') {
    const edges = new LineSegments(solid.kind === 'box' ? new EdgesGeometry(geometry) : cylinderEdges(), lines);
    edges.name = 'edges';
    group.add(edges);
  }
  return group;
}

/** Bars from the frame to the points of the body. */
export function buildSticks(places: Triple[], radius: number, material: MeshPhongMaterial): Group {
  const group = new Group();
  const ball = new Mesh(new SphereGeometry(1.6 * radius, 20, 14), material);
  group.add(ball);
  for (const place of places) {
    if (Math.hypot(...place) < 2 * radius) continue;
    group.add(bar([0, 0, 0], place, radius, material));
    const end = new Mesh(new SphereGeometry(1.15 * radius, 16, 10), material);
    end.position.set(...place);
    group.add(end);
  }
  return group;
}
