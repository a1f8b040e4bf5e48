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

/** Numbers along an axis, with the digits that tell them apart. */
export function tickText(splits: number[]): string[] {
  const step = splits.length > 1 ? Math.abs(splits[1] - splits[0]) : 1;
  const largest = Math.max(...splits.map(Math.abs));
  if (largest >= 1e6 || (largest < 1e-3 && largest > 0)) {
    const digits = Math.max(0, Math.ceil(Math.log10(largest / step)));
    return splits.map((v) => (Math.abs(v) < step * 1e-6 ? '0' : v.toExponential(Math.min(digits, 8)).replace('e+', 'e').replace(/-/g, '\u2212')));
  }
  // As many as the step needs: 0.5 has one, 2.5 one, 0.025 three.
  let decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  while (decimals < 10 && Math.abs(step * 10 ** decimals - Math.round(step * 10 ** decimals)) > 1e-6 * step * 10 ** decimals) ++decimals;
  return splits.map((v) => (Math.abs(v) < step * 1e-6 ? '0' : v.toFixed(decimals).replace('-', '\u2212')));
}
