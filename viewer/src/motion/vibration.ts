// A complex shape s on a model at rest: x(t) = Re(s e^(i phi)), which travels and whirls as the model does.

import { halfTable } from '../data/half';
import type { Triple } from '../data/page';
import type { BodyData, SceneData } from '../data/scene_data';
import type { VibrationData } from '../data/vibrations';
import type { Motion } from './motion';
import { rotate } from './rotation';

/** The largest displacement that is drawn, in parts of the size of the model, and the largest turn (radians). */
export const PART_OF_MODEL = 0.06;
export const LARGEST_TURN = 0.35;
const MOST_VERTICES = 4000;

/** Where the bodies are when nothing swings. */
export interface Rest {
  position: Float64Array;
  quaternion: Float64Array;
  amplitudes: Float32Array;
}

export interface Drawing {
  /** What the shape is multiplied by. */
  factor: number;
  /** At which the place that moves most is farthest out. */
  phase: number;
  /** Largest displacement that is drawn, metres. */
  largest: number;
}

export function restOf(motion: Motion): Rest {
  return { position: motion.position.slice(), quaternion: motion.quaternion.slice(), amplitudes: motion.amplitudes.slice() };
}

/** Half of the larger axis of the ellipse a cos - b sin, and where on it that is. */
export function ellipse(a: ArrayLike<number>, b: ArrayLike<number>): { size: number; phase: number } {
  let aa = 0;
  let bb = 0;
  let ab = 0;
  for (let i = 0; i < a.length; ++i) {
    aa += a[i] * a[i];
    bb += b[i] * b[i];
    ab += a[i] * b[i];
  }
  const half = (aa - bb) / 2;
  return { size: Math.sqrt(Math.max(0, (aa + bb) / 2 + Math.hypot(half, ab))), phase: Math.atan2(-2 * ab, aa - bb) / 2 };
}

/** Calls with places of the body in its frame, and what an amplitude of one of each mode moves them by. */
function eachPlace(scene: SceneData, body: BodyData, call: (p: Triple, modes: ArrayLike<number> | null) => void): void {
  call([0, 0, 0], null);
  const { mesh, solid, modeCount } = body;
  if (mesh) {
    const half = halfTable();
    const count = mesh.vertices.length / 3;
    const modes = mesh.modes ? new Float64Array(3 * modeCount) : null;
    const step = Math.max(1, Math.ceil(count / MOST_VERTICES));
    for (let v = 0; v < count; v += step) {
      if (modes) for (let i = 0; i < modes.length; ++i) modes[i] = half[mesh.modes![3 * modeCount * v + i]];
      call([mesh.vertices[3 * v], mesh.vertices[3 * v + 1], mesh.vertices[3 * v + 2]], modes);
    }
  }
  if (solid) {
    for (let k = 0; k < 8; ++k) {
      const corner = solid.size.map((size, i) => ((k >> i) & 1 ? 0.5 : -0.5) * size);
      const p = rotate(solid.quaternion, 0, corner[0], corner[1], corner[2]);
      call([p[0] + solid.position[0], p[1] + solid.position[1], p[2] + solid.position[2]], null);
    }
  }
  for (const point of scene.points) if (point.body === body.index) call(point.p, point.modes ? point.modes.flat() : null);
}

/** Displacement of a place to first order, in the world: d + theta x R (p + u0) + R u. */
export function displacement(rest: Rest, body: BodyData, p: Triple, modes: ArrayLike<number> | null, places: ArrayLike<number>, amplitudes: ArrayLike<number>): Triple {
  const local = [p[0], p[1], p[2]];
  const bend = [0, 0, 0];
  if (modes) {
    for (let j = 0; j < body.modeCount; ++j) {
      for (let i = 0; i < 3; ++i) {
        local[i] += rest.amplitudes[body.firstMode + j] * modes[3 * j + i];
        bend[i] += amplitudes[body.firstMode + j] * modes[3 * j + i];
      }
    }
  }
  const at = 4 * body.index;
  const r = rotate(rest.quaternion, at, local[0], local[1], local[2]);
  const u = rotate(rest.quaternion, at, bend[0], bend[1], bend[2]);
  const k = 6 * body.index;
  const [x, y, z] = [places[k + 3], places[k + 4], places[k + 5]];
  return [places[k] + y * r[2] - z * r[1] + u[0], places[k + 1] + z * r[0] - x * r[2] + u[1], places[k + 2] + x * r[1] - y * r[0] + u[2]];
}

/** How large a shape is drawn on a model of a size, and where its swing begins: at its largest. */
export function drawingOf(scene: SceneData, rest: Rest, vibration: VibrationData, size: number): Drawing {
  let most = 0;
  let phase = 0;
  let turn = 0;
  for (const body of scene.bodies) {
    const k = 6 * body.index;
    turn = Math.max(turn, ellipse(vibration.real.subarray(k + 3, k + 6), vibration.imaginary.subarray(k + 3, k + 6)).size);
    eachPlace(scene, body, (p, modes) => {
      const a = displacement(rest, body, p, modes, vibration.real, vibration.realAmplitudes);
      const b = displacement(rest, body, p, modes, vibration.imaginary, vibration.imaginaryAmplitudes);
      const found = ellipse(a, b);
      if (found.size <= most * (1 + 1e-9)) return;
      most = found.size;
      // Of the two ends of an axis always the same one: up, or else forward.
      const c = Math.cos(found.phase);
      const s = Math.sin(found.phase);
      const end = a.map((x, i) => c * x - s * b[i]);
      const up = end[0] * scene.up[0] + end[1] * scene.up[1] + end[2] * scene.up[2];
      const sign = Math.abs(up) > 0.05 * most ? up : end.reduce((largest, x) => (Math.abs(x) > Math.abs(largest) ? x : largest), 0);
      phase = found.phase + (sign < 0 ? Math.PI : 0);
    });
  }
  let factor = most > 0 ? (PART_OF_MODEL * size) / most : turn > 0 ? LARGEST_TURN / turn : 0;
  if (factor * turn > LARGEST_TURN) factor = LARGEST_TURN / turn;
  return { factor, phase, largest: factor * most };
}

/** Moves the bodies to an angle of the swing, `scale` times as far as the drawing says; turns are exact. */
export function swing(motion: Motion, rest: Rest, vibration: VibrationData, drawing: Drawing, scale: number, angle: number): void {
  const c = drawing.factor * scale * Math.cos(angle + drawing.phase);
  const s = drawing.factor * scale * Math.sin(angle + drawing.phase);
  const { real, imaginary, realAmplitudes, imaginaryAmplitudes } = vibration;
  const { position, quaternion, amplitudes } = motion;
  for (let b = 0; b < rest.position.length / 3; ++b) {
    const at = (i: number): number => c * real[6 * b + i] - s * imaginary[6 * b + i];
    for (let i = 0; i < 3; ++i) position[3 * b + i] = rest.position[3 * b + i] + at(i);
    const angles = [at(3), at(4), at(5)];
    const turn = Math.hypot(...angles);
    const part = turn > 1e-12 ? Math.sin(turn / 2) / turn : 0.5;
    const [x, y, z] = angles.map((value) => part * value);
    const w = Math.cos(turn / 2);
    const [qx, qy, qz, qw] = rest.quaternion.subarray(4 * b, 4 * b + 4);
    quaternion[4 * b] = w * qx + x * qw + y * qz - z * qy;
    quaternion[4 * b + 1] = w * qy - x * qz + y * qw + z * qx;
    quaternion[4 * b + 2] = w * qz + x * qy - y * qx + z * qw;
    quaternion[4 * b + 3] = w * qw - x * qx - y * qy - z * qz;
  }
  for (let j = 0; j < realAmplitudes.length; ++j) amplitudes[j] = rest.amplitudes[j] + c * realAmplitudes[j] - s * imaginaryAmplitudes[j];
}
