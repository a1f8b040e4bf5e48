// The vehicle of the other pages swings: shapes whose motion tests compute again.

import type { PageJson, VibrationJson } from '../../src/data/page';
import { vehicle } from './vehicle';
import type { BufferWriter } from './writer';

const BODIES = 10;
const AMPLITUDES = 24;
/** By which the shape of the first mode is turned in the complex plane: that changes nothing on the page. */
const TURNED = 0.7;

interface Shape {
  json: VibrationJson;
  /** Of each body, complex: real and imaginary displacement and rotation. */
  real: number[][];
  imaginary: number[][];
  amplitudes: [number, number][];
}

function still(): number[][] {
  return Array.from({ length: BODIES }, () => [0, 0, 0, 0, 0, 0]);
}

/** Displacement and rotation of each body and amplitudes of the first mode of the list, real. */
export const HEAVE = {
  places: [[0, 0, 2, 0, 0, 0], ...Array.from({ length: 4 }, () => [0, 0, 1, 0.2, 0, -0.1]), ...Array.from({ length: 4 }, () => [0, 0, 0.1, 0, 0, 0]), [0, 0, 2, 0, 0.05, 0]],
  amplitudes: Array.from({ length: AMPLITUDES }, (_, j) => (j === 0 ? 0.3 : j === 1 ? -0.1 : 0)),
};

function shapes(evil: string): Shape[] {
  const none = Array.from({ length: AMPLITUDES }, (): [number, number] => [0, 0]);
  const c = Math.cos(TURNED);
  const s = Math.sin(TURNED);
  const whirl = { real: still(), imaginary: still() };
  for (const body of [0, 9]) {
    whirl.real[body] = [1, 0, 0, 0, 0, 0];
    whirl.imaginary[body] = [0, -1, 0, 0, 0, 0];
  }
  const spin = still();
  spin[5] = [0, 0, 0, 0, 1, 0];
  return [
    {
      json: { number: null, kind: 'rigid', frequency: 0, undamped: 0, damping: 0, moves: [[`chassis${evil}`, 0.9], ['box', 0.1]], held: [] },
      real: Array.from({ length: BODIES }, () => [1, 0, 0, 0, 0, 0]),
      imaginary: still(),
      amplitudes: none,
    },
    {
      json: { number: 1, kind: 'vibration', frequency: 1.52345, undamped: 1.6, damping: 0.3669, moves: [['chassis', 0.83], ['box', 0.12], ['front_left_wheel', 0.02]], held: [['front_left_spring', 0.5], ['rear_left_spring', 0.5]] },
      real: HEAVE.places.map((row) => row.map((x) => c * x)),
      imaginary: HEAVE.places.map((row) => row.map((x) => s * x)),
      amplitudes: HEAVE.amplitudes.map((x) => [c * x, s * x]),
    },
    { json: { number: 2, kind: 'unstable', frequency: 10.25, undamped: 10.3, damping: -0.02, moves: [['chassis', 0.97]], held: [] }, ...whirl, amplitudes: none },
    { json: { number: 3, kind: 'decay', frequency: 0, undamped: 1 / (2 * Math.PI * 0.25), damping: 1, moves: [['front_left_arm', 1]], held: [['front_left_arm', 1]] }, real: still(), imaginary: still(), amplitudes: none.map(([a, b], j) => (j === 0 ? [1, 0] : [a, b])) },
    { json: { number: 4, kind: 'vibration', frequency: 31, undamped: 31, damping: 1e-14, moves: [['front_left_wheel', 1]], held: [] }, real: spin, imaginary: still(), amplitudes: none },
  ];
}

export function modes(options: { hostile?: boolean } = {}): { page: PageJson; writer: BufferWriter } {
  const { page, writer } = vehicle({ frames: 1, hostile: options.hostile });
  const list = shapes(options.hostile ? '<img src=x onerror="window.hacked=1"></script><b>' : '');
  const places = list.flatMap(({ real, imaginary }) => [...real.flat(), ...imaginary.flat()]);
  const amplitudes = list.flatMap((shape) => [...shape.amplitudes.map(([a]) => a), ...shape.amplitudes.map(([, b]) => b)]);
  return {
    page: {
      ...page,
      kind: 'modes',
      status: { state: 'completed', sentences: ['The natural vibrations of the model about its equilibrium.'], warnings: ['Mode 2 (10.25 Hz) is unstable: its oscillation grows.'] },
      tables: [{ heading: 'Vibrations', columns: ['mode', 'f [Hz]', 'undamped [Hz]', 'damping', 'kind', 'moves', 'is held by'], rows: Array.from({ length: 25 }, (_, k) => [String(k + 1), k === 24 ? '99.5' : '1.5235', '1.6', '0.3669', 'vibration', 'chassis 83 %', 'front_left_spring 50 %']) }],
      curves: null,
      trust: null,
      speed: null,
      scene: {
        ...page.scene!,
        vibrations: {
          list: list.map(({ json }) => json),
          places: writer.view('f32', places, [list.length, 2, BODIES, 6]),
          amplitudes: writer.view('f32', amplitudes, [list.length, 2, AMPLITUDES]),
        },
      },
    },
    writer,
  };
}
