// Ranges of scales beside that of the whole run: of one instant, and of most places.

import type { BodyData, FieldData, SceneData } from '../data/scene_data';
import { halfTable } from '../data/half';
import { fieldValue } from './elastic_range';
import { elastic, type Motion } from './motion';

/** At most so many places of a body, at so many instants, count for a percentile. */
const PLACES = 800;
const INSTANTS = 60;

function trusted(field: FieldData | null, vertex: number): boolean {
  return !field?.stress?.data.doubtful?.[vertex];
}

export function fieldOf(body: BodyData, name: string | null): FieldData | null {
  return name === null ? null : (body.mesh?.fields.find((field) => field.name === name) ?? null);
}

/** Whether a body has what is asked for: displacement (null), or the field. */
export function has(body: BodyData, name: string | null): boolean {
  return name === null ? body.mesh?.modes != null && body.modeCount > 0 : fieldOf(body, name) !== null;
}

function valueAtVertex(body: BodyData, field: FieldData | null, vertex: number, amplitudes: ArrayLike<number>, row: number, frame: number, part: number): number {
  if (!field) return Math.hypot(...elastic(body, vertex, amplitudes, row + body.firstMode));
  if (field.history && !field.stress) {
    const half = halfTable();
    const count = body.mesh!.vertices.length / 3;
    const a = half[field.history[frame * count + vertex]];
    return part > 0 ? a + part * (half[field.history[(frame + 1) * count + vertex]] - a) : a;
  }
  return fieldValue(body, field, vertex, amplitudes, row + body.firstMode, row, frame);
}

/** Smallest and largest value of all vertices of a body where the motion stands; those not to be trusted left out. */
export function rangeNow(motion: Motion, body: BodyData, name: string | null): [number, number] | null {
  if (!has(body, name)) return null;
  const field = fieldOf(body, name);
  const last = motion.frame + 1 >= motion.scene.time.length;
  let [min, max] = [Infinity, -Infinity];
  for (let v = 0; v < body.mesh!.vertices.length / 3; ++v) {
    if (!trusted(field, v)) continue;
    const value = valueAtVertex(body, field, v, motion.amplitudes, 0, motion.frame, last ? 0 : motion.part);
    if (value < min) min = value;
    if (value > max) max = value;
  }
  return min <= max ? [min, max] : null;
}

/** The value that a part of all has at most, linear between the sorted ones. */
export function quantile(values: number[], part: number): number {
  const sorted = Float64Array.from(values).sort();
  const x = Math.min(1, Math.max(0, part)) * (sorted.length - 1);
  const k = Math.min(Math.floor(x), sorted.length - 2);
  return sorted.length === 1 ? sorted[0] : sorted[k] + (x - k) * (sorted[k + 1] - sorted[k]);
}

/** The smallest and the largest value over the run of places of a body, spread evenly over its vertices. */
export function extremesOfPlaces(scene: SceneData, body: BodyData, name: string | null): { least: number[]; most: number[] } {
  const found: { least: number[]; most: number[] } = { least: [], most: [] };
  if (!has(body, name)) return found;
  const field = fieldOf(body, name);
  const count = body.mesh!.vertices.length / 3;
  const step = Math.max(1, Math.ceil(count / PLACES));
  // What the page knows of all instants is better than a sample of them.
  const envelope = field?.stress && field.stress.quantity !== 'principal_1' && field.stress.quantity !== 'principal_3' ? field.stress.data.envelope : null;
  const frames = Math.max(1, scene.time.length);
  const stride = Math.max(1, Math.ceil(frames / INSTANTS));
  const amplitudes = scene.amplitudes ?? new Float32Array(scene.amplitudeCount * frames);
  for (let v = 0; v < count; v += step) {
    if (!trusted(field, v)) continue;
    let [min, max] = envelope ? [0, envelope[v]] : [Infinity, -Infinity];
    for (let f = 0; f < frames && !envelope; f += stride) {
      const value = valueAtVertex(body, field, v, amplitudes, f * scene.amplitudeCount, f, 0);
      min = Math.min(min, value);
      max = Math.max(max, value);
    }
    if (!Number.isFinite(min) || !Number.isFinite(max)) continue;
    found.least.push(min);
    found.most.push(max);
  }
  return found;
}
