// Natural vibrations of the model: complex shapes, checked.

import { PageBuffer, PageError } from './buffer';
import type { ShareJson, VibrationsJson } from './page';

export interface VibrationData {
  /** Null: a rigid motion. */
  number: number | null;
  kind: string;
  /** Hz, with which it swings. */
  frequency: number;
  undamped: number;
  damping: number;
  moves: [string, number][];
  held: [string, number][];
  /** Of each body displacement and rotation vector in the world, real and imaginary: 6 a body. */
  real: Float32Array;
  imaginary: Float32Array;
  realAmplitudes: Float32Array;
  imaginaryAmplitudes: Float32Array;
}

function sharesOf(list: ShareJson[] | null | undefined): [string, number][] {
  if (!Array.isArray(list)) return [];
  return list.filter((share) => Array.isArray(share) && typeof share[1] === 'number').map((share) => [String(share[0]), share[1]]);
}

function numberOf(value: unknown): number {
  return typeof value === 'number' && Number.isFinite(value) ? value : 0;
}

/** Throws PageError if the shapes do not fit the bodies; single ones that are no motion are left out. */
export function readVibrations(json: VibrationsJson, bodies: number, amplitudeCount: number, buffer: PageBuffer, report: (sentence: string) => void): VibrationData[] {
  const list = Array.isArray(json.list) ? json.list : [];
  if (list.length === 0) return [];
  const what = 'Shapes of the vibrations';
  const places = buffer.read(json.places, what, ['f32'], [list.length, 2, bodies, 6]) as Float32Array;
  const amplitudes = json.amplitudes && amplitudeCount > 0 ? (buffer.read(json.amplitudes, `${what}, amplitudes`, ['f32'], [list.length, 2, amplitudeCount]) as Float32Array) : new Float32Array(2 * amplitudeCount * list.length);
  const result: VibrationData[] = [];
  let wrong = 0;
  list.forEach((item, k) => {
    const part = (from: Float32Array, count: number, half: number): Float32Array => from.slice((2 * k + half) * count, (2 * k + half + 1) * count);
    const vibration: VibrationData = {
      number: typeof item?.number === 'number' ? item.number : null,
      kind: String(item?.kind ?? ''),
      frequency: numberOf(item?.frequency),
      undamped: numberOf(item?.undamped),
      damping: numberOf(item?.damping),
      moves: sharesOf(item?.moves),
      held: sharesOf(item?.held),
      real: part(places, 6 * bodies, 0),
      imaginary: part(places, 6 * bodies, 1),
      realAmplitudes: part(amplitudes, amplitudeCount, 0),
      imaginaryAmplitudes: part(amplitudes, amplitudeCount, 1),
    };
    const parts = [vibration.real, vibration.imaginary, vibration.realAmplitudes, vibration.imaginaryAmplitudes];
    if (parts.every((values) => values.every(Number.isFinite))) result.push(vibration);
    else ++wrong;
  });
  if (wrong > 0) report(`${wrong === 1 ? 'The shape of one vibration is' : `The shapes of ${wrong} vibrations are`} left out: they hold values that are no numbers.`);
  if (result.length === 0 && list.length > 0) throw new PageError('None of the vibrations has a shape that can be drawn.');
  return result;
}
