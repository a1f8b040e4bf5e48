// Hot spots: nodes whose largest stress of the run is larger than that of all nodes they share a triangle with.

import type { BodyData, SceneData } from '../data/scene_data';

export interface HotSpot {
  body: number;
  vertex: number;
  /** Number in the finite-element file, or null. */
  node: number | null;
  /** Largest von Mises stress of the run [MPa], and when [s]. */
  stress: number;
  time: number;
}

/** Of one body, the hottest first. Vertices of one node, as on the sides of a swept bar, count as one place. */
export function hotSpotsOf(body: BodyData): HotSpot[] {
  const { mesh } = body;
  const stress = mesh?.stress;
  if (!mesh || !stress?.envelope || !stress.when) return [];
  const { envelope, when, doubtful } = stress;
  const place = (v: number): number => (mesh.nodes ? mesh.nodes[v] : v);
  const hottest = new Map<number, number>();
  for (let v = 0; v < envelope.length; ++v) {
    if (doubtful?.[v] || !Number.isFinite(envelope[v])) continue;
    const known = hottest.get(place(v));
    if (known === undefined || envelope[v] > envelope[known]) hottest.set(place(v), v);
  }
  const beaten = new Set<number>();
  const { triangles } = mesh;
  for (let i = 0; i < triangles.length; ++i) {
    const a = hottest.get(place(triangles[i]));
    const b = hottest.get(place(triangles[i % 3 === 2 ? i - 2 : i + 1]));
    if (a === undefined || b === undefined || a === b) continue;
    // Of two that are equal one stays.
    const first = envelope[a] > envelope[b] || (envelope[a] === envelope[b] && a < b);
    beaten.add(first ? b : a);
  }
  return [...hottest.values()]
    .filter((v) => !beaten.has(v) && envelope[v] > 0)
    .sort((a, b) => envelope[b] - envelope[a])
    .map((v) => ({ body: body.index, vertex: v, node: mesh.nodes ? mesh.nodes[v] : null, stress: envelope[v], time: when[v] }));
}

/** Of all bodies, at most `most` of each, the hottest first. */
export function hotSpots(scene: SceneData, most: number): HotSpot[] {
  return scene.bodies.flatMap((body) => hotSpotsOf(body).slice(0, most)).sort((a, b) => b.stress - a.stress);
}
