// What elements exert and where joints stand, at each frame: columns of numbers that forces and joints name.

import { PageBuffer } from './buffer';
import type { EffortsJson } from './page';
import { interval } from './series';

export class Efforts {
  private readonly time: ArrayLike<number>;
  /** [frames, columns]; columns behind them are constants. */
  private readonly data: ArrayLike<number>;
  private readonly columns: number;
  private readonly constants: (number | null)[];

  constructor(time: ArrayLike<number>, data: ArrayLike<number>, columns: number, constants: (number | null)[]) {
    this.time = time;
    this.data = data;
    this.columns = columns;
    this.constants = constants;
  }

  get frames(): number {
    return this.time.length;
  }

  private given(column: number, frame: number): number {
    return column < this.columns ? this.data[frame * this.columns + column] : (this.constants[column - this.columns] ?? NaN);
  }

  constant(column: number): boolean {
    return column >= this.columns;
  }

  /** NaN: there is none. */
  atFrame(column: number, frame: number): number {
    return frame >= 0 && frame < this.frames ? this.given(column, frame) : NaN;
  }

  /** A part of the way from a frame to the next, linear; NaN next to what is no number. */
  between(column: number, frame: number, part: number): number {
    if (part <= 0 || frame + 1 >= this.frames) return this.atFrame(column, frame);
    if (part >= 1) return this.atFrame(column, frame + 1);
    return (1 - part) * this.atFrame(column, frame) + part * this.atFrame(column, frame + 1);
  }

  /** NaN outside the frames. */
  at(column: number, time: number): number {
    const n = this.frames;
    if (n === 0 || !(time >= this.time[0] && time <= this.time[n - 1])) return NaN;
    const k = interval(this.time, time);
    const step = n > 1 ? this.time[k + 1] - this.time[k] : 0;
    return this.between(column, k, step > 0 ? (time - this.time[k]) / step : 0);
  }

  history(column: number): Float64Array {
    return Float64Array.from(this.time, (_, frame) => this.given(column, frame));
  }
}

/** Throws PageError. `given`: frames of the page, of which those at `time` are valid. */
export function readEfforts(json: EffortsJson, buffer: PageBuffer, time: ArrayLike<number>, given: number): Efforts {
  const data = json.data ? (buffer.read(json.data, 'Efforts', ['f32'], [given, null]) as Float32Array) : new Float32Array(0);
  return new Efforts(time, data, given > 0 ? data.length / given : 0, Array.isArray(json.constants) ? json.constants : []);
}
