// How far bodies bend over the run: fixes the range of colours once.

import type { BodyData, FieldData, SceneData } from '../data/scene_data';
import { halfTable } from '../data/half';
import { elastic } from './motion';
import { quantityOf, stressAt, vonMises } from './stress';

const SAMPLED_VERTICES = 48;
const SAMPLED_FRAMES = 400;

/** The `count` vertices for which a bound of the value is largest. */
function candidates(bounds: Float32Array, count: number): number[] {
  if (bounds.length <= count) return [...bounds.keys()];
  const limit = Float32Array.from(bounds).sort()[bounds.length - count];
  const chosen: number[] = [];
  for (let v = 0; v < bounds.length && chosen.length < count; ++v) if (bounds[v] >= limit) chosen.push(v);
  return chosen;
}

function largestAmplitudes(scene: SceneData, body: BodyData): Float32Array {
  const result = new Float32Array(body.modeCount);
  const { amplitudes, amplitudeCount } = scene;
  if (!amplitudes) return result;
  for (let f = 0; f < scene.time.length; ++f) {
    for (let j = 0; j < body.modeCount; ++j) {
      const q = Math.abs(amplitudes[f * amplitudeCount + body.firstMode + j]);
      if (q > result[j]) result[j] = q;
    }
  }
  return result;
}

function frames(scene: SceneData): number[] {
  const n = scene.time.length;
  const step = Math.max(1, Math.floor(n / SAMPLED_FRAMES));
  const list: number[] = [];
  for (let f = 0; f < n; f += step) list.push(f);
  return list;
}

/** The frames in which the modes may move the body most: a peak of one frame is among them. */
function boldestFrames(scene: SceneData, body: BodyData): number[] {
  const n = scene.time.length;
  if (n <= SAMPLED_FRAMES) return frames(scene);
  const sizes = largestOfModes(body);
  const bounds = new Float32Array(n);
  for (let f = 0; f < n; ++f) {
    for (let j = 0; j < body.modeCount; ++j) bounds[f] += sizes[j] * Math.abs(scene.amplitudes![f * scene.amplitudeCount + body.firstMode + j]);
  }
  return candidates(bounds, SAMPLED_FRAMES);
}

/**
 * Largest elastic displacement of a body over the run: at the vertices where sum |u_j| max|q_j| is largest, at the up to 400 frames
 * where sum max|u_j| |q_j| is. Costs V m + F m + 48 x 400 m operations, not V m for every frame.
 */
export function largestDisplacement(scene: SceneData, body: BodyData): number {
  const modes = body.mesh?.modes;
  if (!modes || !scene.amplitudes || scene.time.length === 0) return 0;
  const half = halfTable();
  const m = body.modeCount;
  const most = largestAmplitudes(scene, body);
  const bounds = new Float32Array(modes.length / (3 * m));
  for (let v = 0; v < bounds.length; ++v) {
    let bound = 0;
    for (let j = 0; j < m; ++j) {
      const i = 3 * (v * m + j);
      bound += most[j] * Math.hypot(half[modes[i]], half[modes[i + 1]], half[modes[i + 2]]);
    }
    bounds[v] = bound;
  }
  let largest = 0;
  const looked = boldestFrames(scene, body);
  for (const v of candidates(bounds, SAMPLED_VERTICES)) {
    for (const f of looked) {
      const u = elastic(body, v, scene.amplitudes, f * scene.amplitudeCount + body.firstMode);
      largest = Math.max(largest, Math.hypot(u[0], u[1], u[2]));
    }
  }
  return largest;
}

/** Largest displacement of each mode at amplitude one. */
export function largestOfModes(body: BodyData): Float32Array {
  const result = new Float32Array(body.modeCount);
  const modes = body.mesh?.modes;
  if (!modes) return result;
  const half = halfTable();
  const m = body.modeCount;
  for (let v = 0; v < modes.length / (3 * m); ++v) {
    for (let j = 0; j < m; ++j) {
      const i = 3 * (v * m + j);
      const size = Math.hypot(half[modes[i]], half[modes[i + 1]], half[modes[i + 2]]);
      if (size > result[j]) result[j] = size;
    }
  }
  return result;
}

/** Value of a field at a vertex and a frame (fields of modes: with the amplitudes at `at`, in the row that begins at `row`). */
export function fieldValue(body: BodyData, field: FieldData, vertex: number, amplitudes: ArrayLike<number>, at: number, row: number, frame: number): number {
  const half = halfTable();
  if (field.stress) {
    const { data, quantity } = field.stress;
    return quantity === 'envelope' ? data.envelope![vertex] : quantityOf(quantity, stressAt(body, data, vertex, amplitudes, at, row));
  }
  if (field.history) return half[field.history[frame * (body.mesh!.vertices.length / 3) + vertex]];
  let value = field.base ? half[field.base[vertex]] : 0;
  if (!field.modes) return value;
  for (let j = 0; j < body.modeCount; ++j) value += amplitudes[at + j] * half[field.modes[vertex * body.modeCount + j]];
  return value;
}

/** Smallest and largest value of a field over the run, sampled as displacements are. */
export function fieldRange(scene: SceneData, body: BodyData, field: FieldData): [number, number] | null {
  const count = body.mesh!.vertices.length / 3;
  const half = halfTable();
  let min = Infinity;
  let max = -Infinity;
  const take = (value: number): void => {
    if (!Number.isFinite(value)) return;
    if (value < min) min = value;
    if (value > max) max = value;
  };
  if (field.stress) {
    const { data, quantity } = field.stress;
    const trusted = (v: number): boolean => !data.doubtful?.[v];
    if (quantity === 'envelope') {
      for (let v = 0; v < count; ++v) if (trusted(v)) take(data.envelope![v]);
      return min <= max ? [0, max] : null;
    }
    const most = largestAmplitudes(scene, body);
    const bounds = new Float32Array(count);
    const one = new Float64Array(body.modeCount);
    for (let j = 0; j < body.modeCount; ++j) {
      one.fill(0);
      one[j] = most[j];
      for (let v = 0; v < count; ++v) if (trusted(v)) bounds[v] += vonMises(stressAt(body, data, v, one, 0, null));
    }
    for (let j = 0; j < data.loadCount; ++j) {
      const row = new Float64Array(data.firstLoad + data.loadCount);
      for (let f = 0; f < scene.time.length; ++f) row[data.firstLoad + j] = Math.max(row[data.firstLoad + j], Math.abs(scene.amplitudes?.[f * scene.amplitudeCount + data.firstLoad + j] ?? 0));
      for (let v = 0; v < count; ++v) if (trusted(v)) bounds[v] += vonMises(stressAt(body, data, v, row, body.firstMode, 0));
    }
    const looked = scene.amplitudes ? boldestFrames(scene, body) : [];
    const few = candidates(bounds, SAMPLED_VERTICES);
    // Loads have their largest in frames of their own.
    if (data.loadCount > 0 && scene.amplitudes) looked.push(...frames(scene));
    for (const f of looked) for (const v of few) if (trusted(v)) take(fieldValue(body, field, v, scene.amplitudes!, f * scene.amplitudeCount + body.firstMode, f * scene.amplitudeCount, f));
    if (min > max) return null;
    return quantity === 'von_mises' ? [0, max] : [min, max];
  } else if (field.history) {
    for (const bits of field.history) take(half[bits]);
  } else if (field.modes) {
    const most = largestAmplitudes(scene, body);
    const bounds = new Float32Array(count);
    for (let v = 0; v < count; ++v) {
      let bound = field.base ? Math.abs(half[field.base[v]]) : 0;
      for (let j = 0; j < body.modeCount; ++j) bound += most[j] * Math.abs(half[field.modes[v * body.modeCount + j]]);
      bounds[v] = bound;
    }
    const amplitudes = scene.amplitudes ?? new Float32Array(scene.amplitudeCount);
    for (const v of candidates(bounds, SAMPLED_VERTICES)) {
      for (const f of scene.amplitudes ? frames(scene) : [0]) take(fieldValue(body, field, v, amplitudes, f * scene.amplitudeCount + body.firstMode, f * scene.amplitudeCount, f));
    }
    if (field.base) for (let v = 0; v < count; ++v) take(half[field.base[v]]);
  }
  return min <= max ? [min, max] : null;
}
