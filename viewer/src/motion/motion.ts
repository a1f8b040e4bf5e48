// Where bodies are at a time: positions and amplitudes linear between frames, orientations on the shortest arc.

import type { BodyData, PointData, SceneData } from '../data/scene_data';
import type { Triple } from '../data/page';
import { halfTable } from '../data/half';
import { interval } from '../data/series';
import { rotate, slerp } from './rotation';

export class Motion {
  readonly scene: SceneData;
  /** x, y, z of each body's frame, relative to the scene's origin. */
  readonly position: Float64Array;
  /** x, y, z, w of each body's frame. */
  readonly quaternion: Float64Array;
  readonly amplitudes: Float32Array;
  /** Frame before the time, and the part of the way to the next. */
  frame = 0;
  part = 0;

  constructor(scene: SceneData) {
    this.scene = scene;
    const count = scene.bodies.length;
    this.position = new Float64Array(3 * count);
    this.quaternion = new Float64Array(4 * count);
    for (let b = 0; b < count; ++b) this.quaternion[4 * b + 3] = 1;
    this.amplitudes = new Float32Array(Math.max(1, scene.amplitudeCount));
    if (scene.time.length > 0) this.go(scene.time[0]);
  }

  go(time: number): void {
    const { time: times, pose, amplitudes, amplitudeCount, bodies } = this.scene;
    const n = times.length;
    if (n === 0) return;
    const k = interval(times, time, this.frame);
    const next = Math.min(k + 1, n - 1);
    const step = times[next] - times[k];
    const s = step > 0 ? Math.min(1, Math.max(0, (time - times[k]) / step)) : 0;
    this.frame = k;
    this.part = s;
    const stride = 7 * bodies.length;
    for (let b = 0; b < bodies.length; ++b) {
      const from = k * stride + 7 * b;
      const to = next * stride + 7 * b;
      for (let i = 0; i < 3; ++i) this.position[3 * b + i] = (1 - s) * pose[from + i] + s * pose[to + i];
      slerp(pose, from + 3, pose, to + 3, s, this.quaternion, 4 * b);
    }
    if (!amplitudes) return;
    const from = k * amplitudeCount;
    const to = next * amplitudeCount;
    for (let j = 0; j < amplitudeCount; ++j) this.amplitudes[j] = (1 - s) * amplitudes[from + j] + s * amplitudes[to + j];
  }

  /** A place of a body's frame in the world, relative to the scene's origin. */
  toWorld(body: number, x: number, y: number, z: number): Triple {
    if (body < 0) return [x, y, z];
    const turned = rotate(this.quaternion, 4 * body, x, y, z);
    for (let i = 0; i < 3; ++i) turned[i] += this.position[3 * body + i];
    return turned;
  }

  /** Place in the body's frame of a point with modes, deformation times `scale`. */
  deformed(body: BodyData, p: Triple, modes: Triple[] | null, scale: number): Triple {
    const result: Triple = [p[0], p[1], p[2]];
    if (!modes) return result;
    for (let j = 0; j < body.modeCount; ++j) {
      const q = scale * this.amplitudes[body.firstMode + j];
      for (let i = 0; i < 3; ++i) result[i] += q * modes[j][i];
    }
    return result;
  }

  pointPosition(point: PointData, scale: number): Triple {
    if (point.body < 0) return [point.p[0], point.p[1], point.p[2]];
    const local = this.deformed(this.scene.bodies[point.body], point.p, point.modes, scale);
    return this.toWorld(point.body, local[0], local[1], local[2]);
  }
}

/** Elastic displacement of a vertex in the body's frame. */
export function elastic(body: BodyData, vertex: number, amplitudes: ArrayLike<number>, at: number): Triple {
  const modes = body.mesh?.modes;
  const sum: Triple = [0, 0, 0];
  if (!modes) return sum;
  const half = halfTable();
  const m = body.modeCount;
  for (let j = 0; j < m; ++j) {
    const q = amplitudes[at + j];
    const i = 3 * (vertex * m + j);
    sum[0] += q * half[modes[i]];
    sum[1] += q * half[modes[i + 1]];
    sum[2] += q * half[modes[i + 2]];
  }
  return sum;
}
