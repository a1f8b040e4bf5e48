// Stress at a vertex: the twin of what the vertex shader does (scene/bending.ts), for ranges, values of picked points and curves.

import type { BodyData, StressData } from '../data/scene_data';
import { halfTable } from '../data/half';

/** xx, yy, zz, xy, yz, zx */
export type Stress = [number, number, number, number, number, number];

export type Quantity = 'von_mises' | 'principal_1' | 'principal_3';

/** MPa, with the amplitudes of the body from `at` on; those of its loads are in the row of all amplitudes that begins at `row`, null: without them. */
export function stressAt(body: BodyData, stress: StressData, vertex: number, amplitudes: ArrayLike<number>, at: number, row: number | null): Stress {
  const half = halfTable();
  const result: Stress = [0, 0, 0, 0, 0, 0];
  const first = 6 * vertex * (body.modeCount + stress.loadCount);
  const count = body.modeCount + (row === null ? 0 : stress.loadCount);
  for (let j = 0; j < count; ++j) {
    const q = stress.factor * amplitudes[j < body.modeCount ? at + j : row! + stress.firstLoad + j - body.modeCount];
    for (let c = 0; c < 6; ++c) result[c] += q * half[stress.modes[first + 6 * j + c]];
  }
  return result;
}

export function vonMises(s: ArrayLike<number>): number {
  const [a, b, c] = [s[0] - s[1], s[1] - s[2], s[2] - s[0]];
  return Math.sqrt(0.5 * (a * a + b * b + c * c) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

/** Largest and smallest principal stress: closed form by the angle of the deviator (Smith 1961). */
export function principals(s: ArrayLike<number>): [number, number] {
  const mean = (s[0] + s[1] + s[2]) / 3;
  const [x, y, z] = [s[0] - mean, s[1] - mean, s[2] - mean];
  const p = Math.sqrt((x * x + y * y + z * z + 2 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5])) / 6);
  if (!(p > 0)) return [mean, mean];
  const determinant = x * (y * z - s[4] * s[4]) - s[3] * (s[3] * z - s[4] * s[5]) + s[5] * (s[3] * s[4] - y * s[5]);
  const phi = Math.acos(Math.min(1, Math.max(-1, determinant / (2 * p * p * p)))) / 3;
  return [mean + 2 * p * Math.cos(phi), mean + 2 * p * Math.cos(phi + (2 * Math.PI) / 3)];
}

export function quantityOf(quantity: Quantity, s: ArrayLike<number>): number {
  if (quantity === 'von_mises') return vonMises(s);
  return principals(s)[quantity === 'principal_1' ? 0 : 1];
}

/** Largest von Mises stress of each mode at amplitude one, doubtful places left out; MPa. */
export function largestStressOfModes(body: BodyData, stress: StressData): Float64Array {
  const result = new Float64Array(body.modeCount);
  const amplitudes = new Float64Array(body.modeCount);
  const vertices = stress.modes.length / (6 * Math.max(1, body.modeCount + stress.loadCount));
  for (let j = 0; j < body.modeCount; ++j) {
    amplitudes.fill(0);
    amplitudes[j] = 1;
    for (let v = 0; v < vertices; ++v) if (!stress.doubtful?.[v]) result[j] = Math.max(result[j], vonMises(stressAt(body, stress, v, amplitudes, 0, null)));
  }
  return result;
}
