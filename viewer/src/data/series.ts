// Functions given by samples over time.

/** Index k with time[k] <= t < time[k + 1], within 0 and n - 2; `guess` is tried first. */
export function interval(time: ArrayLike<number>, t: number, guess = 0): number {
  const last = time.length - 2;
  if (last <= 0) return 0;
  if (guess >= 0 && guess <= last && time[guess] <= t) {
    if (t < time[guess + 1]) return guess;
    if (guess < last && t < time[guess + 2]) return guess + 1;
  }
  let low = 0;
  let high = last;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (time[middle] <= t) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** Linear between samples, NaN outside them. */
export function valueAt(time: ArrayLike<number>, values: ArrayLike<number>, t: number): number {
  const n = Math.min(time.length, values.length);
  if (n === 0 || !(t >= time[0] && t <= time[n - 1])) return NaN;
  if (n === 1) return values[0];
  const k = interval(time, t);
  const step = time[k + 1] - time[k];
  const s = step > 0 ? (t - time[k]) / step : 0;
  // The ends are returned as they are, also next to a gap.
  if (s <= 0) return values[k];
  if (s >= 1) return values[k + 1];
  return values[k] + s * (values[k + 1] - values[k]);
}

/** All instants of both, in order, each once. */
export function union(a: ArrayLike<number>, b: ArrayLike<number>): Float64Array {
  const result = new Float64Array(a.length + b.length);
  let n = 0;
  for (let i = 0, k = 0; i < a.length || k < b.length; ) {
    const next = k >= b.length || (i < a.length && a[i] <= b[k]) ? a[i++] : b[k++];
    if (n === 0 || next > result[n - 1]) result[n++] = next;
  }
  return result.subarray(0, n);
}

export function resample(time: ArrayLike<number>, values: ArrayLike<number>, at: ArrayLike<number>): Float64Array {
  const result = new Float64Array(at.length);
  let k = 0;
  const n = Math.min(time.length, values.length);
  for (let i = 0; i < at.length; ++i) {
    const t = at[i];
    if (n === 0 || !(t >= time[0] && t <= time[n - 1])) {
      result[i] = NaN;
    } else if (n === 1) {
      result[i] = values[0];
    } else {
      k = interval(time, t, k);
      const step = time[k + 1] - time[k];
      const s = step > 0 ? (t - time[k]) / step : 0;
      result[i] = s <= 0 ? values[k] : s >= 1 ? values[k + 1] : values[k] + s * (values[k + 1] - values[k]);
    }
  }
  return result;
}

export interface Difference {
  max: number;
  rms: number;
  at: number;
}

/** Largest and root-mean-square difference (over time, trapezoidal) on the instants that both have; null without any. */
export function difference(timeA: ArrayLike<number>, a: ArrayLike<number>, timeB: ArrayLike<number>, b: ArrayLike<number>): Difference | null {
  const time = union(timeA, timeB);
  const first = resample(timeA, a, time);
  const second = resample(timeB, b, time);
  let max = -1;
  let at = 0;
  let integral = 0;
  let length = 0;
  let before = NaN;
  for (let i = 0; i < time.length; ++i) {
    const d = second[i] - first[i];
    if (Math.abs(d) > max) {
      max = Math.abs(d);
      at = time[i];
    }
    if (i > 0 && Number.isFinite(d) && Number.isFinite(before)) {
      const step = time[i] - time[i - 1];
      integral += (step * (d * d + d * before + before * before)) / 3;
      length += step;
    }
    before = d;
  }
  if (max < 0) return null;
  return { max, rms: length > 0 ? Math.sqrt(integral / length) : max, at };
}

export interface Range {
  min: number;
  max: number;
}

export function rangeOf(values: ArrayLike<number>): Range | null {
  let min = Infinity;
  let max = -Infinity;
  for (let i = 0; i < values.length; ++i) {
    const value = values[i];
    if (value < min) min = value;
    if (value > max) max = value;
  }
  return min <= max && Number.isFinite(min) && Number.isFinite(max) ? { min, max } : null;
}
