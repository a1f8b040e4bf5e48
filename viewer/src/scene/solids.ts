// Shapes of rigid bodies: boxes, ellipsoids, and sticks for bodies of which only points are known.

import { BoxGeometry, EdgesGeometry, Group, type LineBasicMaterial, LineSegments, Mesh, type MeshPhongMaterial, SphereGeometry } from 'three';
import type { SolidData } from '../data/scene_data';
import type { Triple } from '../data/page';
import { bar } from './symbols';

export function buildSolid(solid: SolidData, material: MeshPhongMaterial, lines: LineBasicMaterial): Group {
  const group = new Group();
  group.position.set(...solid.position);
  group.quaternion.set(...solid.quaternion);
  const geometry = solid.kind === 'box' ? new BoxGeometry(1, 1, 1) : new SphereGeometry(0.5, 40, 24);
  group.scale.set(...(solid.size.map((x) => Math.max(Math.abs(x), 1e-9)) as Triple));
  group.add(new Mesh(geometry, material));
  if (solid.kind === 'box') {
    const edges = new LineSegments(new EdgesGeometry(geometry), lines);
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
