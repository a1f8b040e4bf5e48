// Numbers as text.

const MINUS = '\u2212';

/** About `digits` significant digits, without an exponent where that is readable. */
export function formatNumber(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? '–' : value > 0 ? '∞' : `${MINUS}∞`;
  if (value === 0) return '0';
  const size = Math.abs(value);
  let result: string;
  if (size >= 1e6 || size < 1e-4) result = value.toExponential(digits - 1).replace(/\.?0+e/, 'e').replace('e+', 'e');
  else {
    const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
    result = value.toFixed(Math.min(decimals, 10));
    if (result.includes('.')) result = result.replace(/\.?0+$/, '');
  }
  return result.replace(/^-/, MINUS).replace('e-', `e${MINUS}`);
}

export function withUnit(value: number, unit: string, digits = 4): string {
  return unit ? `${formatNumber(value, digits)} ${unit}` : formatNumber(value, digits);
}

/** The unit of lengths in which numbers up to `size` metres are easy to read. */
export function lengthUnit(size: number): { name: string; factor: number } {
  if (size >= 1) return { name: 'm', factor: 1 };
  if (size >= 1e-4) return { name: 'mm', factor: 1e3 };
  if (size >= 1e-7) return { name: 'µm', factor: 1e6 };
  return size > 0 ? { name: 'nm', factor: 1e9 } : { name: 'mm', factor: 1e3 };
}

export function formatLength(metres: number, digits = 3): string {
  const unit = lengthUnit(Math.abs(metres));
  return `${formatNumber(metres * unit.factor, digits)} ${unit.name}`;
}

/** The largest of 1, 2 and 5 times a power of ten that is at most `value`. */
export function niceBelow(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const lead = value / power;
  return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power;
}

/** The smallest of 1, 2 and 5 times a power of ten that is at least `value`. */
export function niceAbove(value: number): number {
  const below = niceBelow(value);
  if (below >= value) return below;
  const power = 10 ** Math.floor(Math.log10(value));
  const lead = Math.round(below / power);
  return (lead === 1 ? 2 : lead === 2 ? 5 : 10) * power;
}

/** Forces and torques with a prefix where that is readable: "2.5 kN". */
export function formatEffort(value: number, unit: string, digits = 3): string {
  const size = Math.abs(value);
  const [factor, prefix] = size >= 1e6 ? [1e-6, 'M'] : size >= 1e3 ? [1e-3, 'k'] : size >= 1 || size === 0 ? [1, ''] : size >= 1e-3 ? [1e3, 'm'] : [1, ''];
  return `${formatNumber(value * factor, digits)} ${prefix}${unit}`;
}

export function plural(count: number, one: string, many = `${one}s`): string {
  return `${count} ${count === 1 ? one : many}`;
}

/** Few digits, but as many as tell different numbers apart: the ends of a scale, the edges of classes. */
export function distinctTexts(values: number[], digits = 3): string[] {
  const different = new Set(values.filter(Number.isFinite)).size;
  for (let d = digits; d < 15; ++d) {
    const texts = values.map((value) => formatNumber(value, d));
    if (new Set(texts.filter((_, k) => Number.isFinite(values[k]))).size === different) return texts;
  }
  return values.map((value) => formatNumber(value, 15));
}

const MOST_DECIMALS = 14;

/** Numbers along an axis with all the digits that their step needs: none is rounded to another value. */
export function tickText(splits: number[]): string[] {
  const known = splits.filter(Number.isFinite);
  const steps = known.slice(1).map((v, k) => Math.abs(v - known[k])).filter((step) => step > 0);
  const largest = known.reduce((most, v) => Math.max(most, Math.abs(v)), 0);
  const step = steps.length > 0 ? Math.min(...steps) : largest > 0 ? largest * 1e-3 : 1;
  const exact = (text: (decimals: number) => (v: number) => string): string[] => {
    for (let decimals = 0; ; ++decimals) {
      const written = text(decimals);
      if (decimals < MOST_DECIMALS && !known.every((v) => Math.abs(Number(written(v)) - v) <= 1e-3 * step)) continue;
      return splits.map((v) => (Math.abs(v) < 1e-6 * step ? '0' : written(v).replace('e+', 'e').replace(/-/g, MINUS)));
    }
  };
  if (largest >= 1e6 || (largest < 1e-3 && largest > 0)) return exact((decimals) => (v) => v.toExponential(decimals));
  return exact((decimals) => (v) => v.toFixed(decimals));
}
