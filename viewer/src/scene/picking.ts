// Which body and node lie under the pointer: computed once for a click, with the bent surfaces.

import { Mesh, Ray, Raycaster, Vector3, type Camera, type Object3D } from 'three';
import type { Motion } from '../motion/motion';
import { elastic } from '../motion/motion';
import type { BodyView } from './bodies';

export interface Pick {
  body: number;
  /** Vertex of the mesh next to the place, or null on rigid shapes. */
  vertex: number | null;
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
    best = { body: view.data.index, vertex: triangles[i + nearest], distance };
  }
  return best;
}

export function pick(bodies: BodyView[], motion: Motion, scale: number, raycaster: Raycaster, extra: { object: Object3D; body: number }[]): Pick | null {
  let best: Pick | null = null;
  const offer = (found: Pick | null): void => {
    if (found && (!best || found.distance < best.distance)) best = found;
  };
  for (const view of bodies) {
    if (!view.group.visible) continue;
    if (view.data.mesh) offer(pickMesh(view, motion, scale, raycaster.ray));
    else {
      const meshes: Object3D[] = [];
      view.group.traverse((object) => {
        if (object instanceof Mesh && object.visible) meshes.push(object);
      });
      const first = raycaster.intersectObjects(meshes, false)[0];
      if (first) offer({ body: view.data.index, vertex: null, distance: first.distance });
    }
  }
  for (const { object, body } of extra) {
    if (!object.visible) continue;
    const first = raycaster.intersectObject(object, true)[0];
    if (first) offer({ body, vertex: null, distance: first.distance });
  }
  return best;
}

export function rayThrough(x: number, y: number, camera: Camera): Raycaster {
  const raycaster = new Raycaster();
  raycaster.setFromCamera({ x, y } as never, camera);
  return raycaster;
}
