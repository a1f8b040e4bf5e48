// Geometry of a body's surface: vertices doubled at sharp edges, so that these stay sharp when shaded.

import { BufferAttribute, BufferGeometry } from 'three';
import type { MeshData } from '../data/scene_data';

const SHARP = Math.cos((38 * Math.PI) / 180);

export interface Surface {
  geometry: BufferGeometry;
  /** Lines along sharp and open edges, on the same vertices. */
  edges: BufferGeometry;
}

function faceNormals(vertices: Float32Array, triangles: ArrayLike<number>): Float32Array {
  const normals = new Float32Array(triangles.length);
  for (let i = 0; i < triangles.length; i += 3) {
    const a = 3 * triangles[i];
    const b = 3 * triangles[i + 1];
    const c = 3 * triangles[i + 2];
    const ux = vertices[b] - vertices[a];
    const uy = vertices[b + 1] - vertices[a + 1];
    const uz = vertices[b + 2] - vertices[a + 2];
    const vx = vertices[c] - vertices[a];
    const vy = vertices[c + 1] - vertices[a + 1];
    const vz = vertices[c + 2] - vertices[a + 2];
    normals[i] = uy * vz - uz * vy;
    normals[i + 1] = uz * vx - ux * vz;
    normals[i + 2] = ux * vy - uy * vx;
  }
  return normals;
}

/** Corners of each vertex: start[v] to start[v + 1] in `corners`. */
function cornersOf(triangles: ArrayLike<number>, count: number): { start: Uint32Array; corners: Uint32Array } {
  const start = new Uint32Array(count + 1);
  for (let i = 0; i < triangles.length; ++i) ++start[triangles[i] + 1];
  for (let v = 0; v < count; ++v) start[v + 1] += start[v];
  const next = start.slice(0, count);
  const corners = new Uint32Array(triangles.length);
  for (let i = 0; i < triangles.length; ++i) corners[next[triangles[i]]++] = i;
  return { start, corners };
}

function cosine(a: Float32Array, i: number, b: Float32Array, k: number): number {
  const dot = a[i] * b[k] + a[i + 1] * b[k + 1] + a[i + 2] * b[k + 2];
  const length = Math.hypot(a[i], a[i + 1], a[i + 2]) * Math.hypot(b[k], b[k + 1], b[k + 2]);
  return length > 0 ? dot / length : 1;
}

/** Edges whose two triangles meet sharply, and those of one triangle only, as pairs of vertices. */
function sharpEdges(triangles: ArrayLike<number>, faces: Float32Array, count: number): [number, number][] {
  const first = new Map<number, number>();
  const sharp = new Map<number, boolean>();
  for (let i = 0; i < triangles.length; ++i) {
    const a = triangles[i];
    const b = triangles[i % 3 === 2 ? i - 2 : i + 1];
    const key = a < b ? a * count + b : b * count + a;
    const face = 3 * Math.floor(i / 3);
    const other = first.get(key);
    if (other === undefined) {
      first.set(key, face);
      sharp.set(key, true);
    } else sharp.set(key, cosine(faces, other, faces, face) < SHARP);
  }
  const edges: [number, number][] = [];
  for (const [key, is] of sharp) if (is) edges.push([Math.floor(key / count), key % count]);
  return edges;
}

export function buildSurface(mesh: MeshData): Surface {
  const { vertices, triangles } = mesh;
  const count = vertices.length / 3;
  const faces = faceNormals(vertices, triangles);
  const index = new Uint32Array(triangles.length);
  const sources: number[] = [];
  const normals: number[] = [];
  const firstCopy = new Uint32Array(count);
  if (mesh.normals) {
    for (let v = 0; v < count; ++v) {
      sources.push(v);
      firstCopy[v] = v;
      normals.push(mesh.normals[3 * v], mesh.normals[3 * v + 1], mesh.normals[3 * v + 2]);
    }
    index.set(triangles);
  } else {
    const { start, corners } = cornersOf(triangles, count);
    for (let v = 0; v < count; ++v) {
      const from = sources.length;
      firstCopy[v] = from;
      for (let k = start[v]; k < start[v + 1]; ++k) {
        const corner = corners[k];
        const face = 3 * Math.floor(corner / 3);
        // The first copy of the vertex whose faces are about in line with this one.
        let copy = from;
        while (copy < sources.length) {
          const n = Float32Array.of(normals[3 * copy], normals[3 * copy + 1], normals[3 * copy + 2]);
          if (cosine(n, 0, faces, face) >= SHARP) break;
          ++copy;
        }
        if (copy === sources.length) {
          sources.push(v);
          normals.push(0, 0, 0);
        }
        for (let i = 0; i < 3; ++i) normals[3 * copy + i] += faces[face + i];
        index[corner] = copy;
      }
      if (from === sources.length) {
        sources.push(v);
        normals.push(0, 0, 1);
      }
    }
  }
  const position = new Float32Array(3 * sources.length);
  const normal = new Float32Array(normals);
  for (let v = 0; v < sources.length; ++v) {
    const length = Math.hypot(normal[3 * v], normal[3 * v + 1], normal[3 * v + 2]) || 1;
    for (let i = 0; i < 3; ++i) {
      position[3 * v + i] = vertices[3 * sources[v] + i];
      normal[3 * v + i] /= length;
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(position, 3));
  geometry.setAttribute('normal', new BufferAttribute(normal, 3));
  geometry.setAttribute('source', new BufferAttribute(Float32Array.from(sources), 1));
  geometry.setIndex(new BufferAttribute(sources.length < 65536 ? Uint16Array.from(index) : index, 1));
  geometry.computeBoundingBox();
  geometry.computeBoundingSphere();

  const edges = new BufferGeometry();
  edges.setAttribute('position', geometry.getAttribute('position'));
  edges.setAttribute('source', geometry.getAttribute('source'));
  edges.setIndex(sharpEdges(triangles, faces, count).flatMap(([a, b]) => [firstCopy[a], firstCopy[b]]));
  return { geometry, edges };
}
