// What lies under the pointer: computed once for a click, with the bent surfaces.

import { Mesh, Ray, Raycaster, Vector3, type Camera, type Object3D } from 'three';
import type { Motion } from '../motion/motion';
import { elastic } from '../motion/motion';
import type { BodyView } from './bodies';
import type { Part } from './connections';

export interface Pick {
  /** -1: a part. */
  body: number;
  /** Vertex of the mesh next to the place, or null on rigid shapes. */
  vertex: number | null;
  part: Part | null;
  distance: number;
}

const local = new Ray();
const corners = [new Vector3(), new Vector3(), new Vector3()];
const hit = new Vector3();

/** Places of all vertices in the body's frame. */
export function bentVertices(view: BodyView, motion: Motion, scale: number): Float32Array {
  const mesh = view.data.mesh!;
  const places = Float32Array.from(mesh.vertices);
  if (!mesh.modes) return places;
  for (let v = 0; v < places.length / 3; ++v) {
    const u = elastic(view.data, v, motion.amplitudes, view.data.firstMode);
    for (let i = 0; i < 3; ++i) places[3 * v + i] += scale * u[i];
  }
  return places;
}

function pickMesh(view: BodyView, motion: Motion, scale: number, ray: Ray): Pick | null {
  local.copy(ray).applyMatrix4(view.group.matrixWorld.clone().invert());
  const places = bentVertices(view, motion, scale);
  const { triangles } = view.data.mesh!;
  let best: Pick | null = null;
  for (let i = 0; i < triangles.length; i += 3) {
    for (let k = 0; k < 3; ++k) corners[k].fromArray(places, 3 * triangles[i + k]);
    if (!local.intersectTriangle(corners[0], corners[1], corners[2], false, hit)) continue;
    const distance = hit.distanceTo(local.origin);
    if (best && distance >= best.distance) continue;
    let nearest = 0;
    for (let k = 1; k < 3; ++k) if (corners[k].distanceToSquared(hit) < corners[nearest].distanceToSquared(hit)) nearest = k;
    best = { body: view.data.index, vertex: triangles[i + nearest], part: null, distance };
  }
  return best;
}

function pickBody(view: BodyView, motion: Motion, scale: number, raycaster: Raycaster): Pick | null {
  if (view.data.mesh) return pickMesh(view, motion, scale, raycaster.ray);
  const meshes: Object3D[] = [];
  view.group.traverse((object) => {
    if (object instanceof Mesh && object.visible) meshes.push(object);
  });
  const first = raycaster.intersectObjects(meshes, false)[0];
  return first ? { body: view.data.index, vertex: null, part: null, distance: first.distance } : null;
}

/** Meshes that are drawn or stand for what is drawn, with those that are seen through bodies apart. */
function meshesOf(object: Object3D, before: Object3D[], among: Object3D[]): void {
  if (!object.visible && !object.userData.takesClicks) return;
  if (object instanceof Mesh) ((object.material as { depthTest?: boolean }).depthTest === false ? before : among).push(object);
  for (const child of object.children) meshesOf(child, before, among);
}

/**
 * What is drawn over bodies comes first, then the nearest of what is solid. Glass lets clicks through: it is
 * found only where nothing else is.
 */
export function pick(bodies: BodyView[], motion: Motion, scale: number, raycaster: Raycaster, parts: { object: Object3D; part: Part }[]): Pick | null {
  const nearest: { over: Pick | null; solid: Pick | null; glass: Pick | null } = { over: null, solid: null, glass: null };
  const offer = (rank: keyof typeof nearest, found: Pick | null): void => {
    const best = nearest[rank];
    if (found && (!best || found.distance < best.distance)) nearest[rank] = found;
  };
  for (const view of bodies) if (view.group.visible) offer(view.glass ? 'glass' : 'solid', pickBody(view, motion, scale, raycaster));
  for (const { object, part } of parts) {
    const over: Object3D[] = [];
    const solid: Object3D[] = [];
    meshesOf(object, over, solid);
    for (const [rank, meshes] of [['over', over], ['solid', solid]] as const) {
      const first = raycaster.intersectObjects(meshes, false)[0];
      if (first) offer(rank, { body: -1, vertex: null, part, distance: first.distance });
    }
  }
  return nearest.over ?? nearest.solid ?? nearest.glass;
}

export function rayThrough(x: number, y: number, camera: Camera): Raycaster {
  const raycaster = new Raycaster();
  raycaster.setFromCamera({ x, y } as never, camera);
  return raycaster;
}
