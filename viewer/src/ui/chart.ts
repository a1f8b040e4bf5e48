// A small chart with two axes as vectors: points and lines over a number or over words.

import { tickText } from '../data/format';
import { h, svg } from './dom';

const SIZES = { small: [420, 250], wide: [900, 330] };
const [LEFT, RIGHT, TOP, BOTTOM] = [66, 12, 10, 34];

export interface ChartLine {
  x: ArrayLike<number>;
  y: ArrayLike<number>;
  colour: string;
  width: number;
}

export interface ChartPoint {
  x: number;
  y: number;
  colour: string;
  title: string;
  strong: boolean;
  /** Called when it is clicked. */
  choose?: () => void;
}

export interface ChartSpec {
  title: string;
  wide?: boolean;
  /** Beside the title. */
  unit: string;
  x: { label: string; words: string[] | null; log?: boolean };
  lines: ChartLine[];
  points: ChartPoint[];
  /** What it shows, for those who do not see it. */
  description: string;
}

/** Round numbers between two, at most `most` of them. */
export function roundTicks(low: number, high: number, most: number): number[] {
  const rough = (high - low) / Math.max(1, most - 1);
  if (!(rough > 0) || !Number.isFinite(rough)) return [low];
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 2.5, 5, 10].map((k) => k * power).find((s) => s >= rough * (1 - 1e-9))!;
  const ticks: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) ticks.push(k * step);
  return ticks;
}

function extent(values: Iterable<number>, pad: number): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (const v of values) {
    if (!Number.isFinite(v)) continue;
    if (v < low) low = v;
    if (v > high) high = v;
  }
  if (low > high) return [0, 1];
  if (low === high) {
    const half = low === 0 ? 1 : 0.05 * Math.abs(low);
    return [low - half, high + half];
  }
  return [low - pad * (high - low), high + pad * (high - low)];
}

function* all(spec: ChartSpec, axis: 'x' | 'y'): Iterable<number> {
  for (const line of spec.lines) for (let i = 0; i < line[axis].length; ++i) yield line[axis][i];
  for (const point of spec.points) yield point[axis];
}

export function chart(spec: ChartSpec): HTMLElement {
  const [width, height] = SIZES[spec.wide ? 'wide' : 'small'];
  const { words, log } = spec.x;
  const scaled = (x: number): number => (log ? Math.log10(x) : x);
  const [x0, x1] = words ? [-0.5, words.length - 0.5] : extent(Array.from(all(spec, 'x'), scaled), spec.points.length > 0 ? 0.05 : 0);
  const [y0, y1] = extent(all(spec, 'y'), 0.07);
  const px = (x: number): number => LEFT + ((scaled(x) - x0) / (x1 - x0)) * (width - LEFT - RIGHT);
  const py = (y: number): number => height - BOTTOM - ((y - y0) / (y1 - y0)) * (height - TOP - BOTTOM);
  const picture = svg('svg', { viewBox: `0 0 ${width} ${height}`, class: 'chart', role: 'img', 'aria-label': spec.description });
  const text = (x: number, y: number, anchor: string, content: string): void => {
    picture.append(svg('text', { x, y, 'text-anchor': anchor }, content));
  };
  const yTicks = roundTicks(y0, y1, 6);
  const yTexts = tickText(yTicks);
  yTicks.forEach((y, k) => {
    picture.append(svg('line', { class: 'grid', x1: LEFT, x2: width - RIGHT, y1: py(y), y2: py(y) }));
    text(LEFT - 6, py(y) + 4, 'end', yTexts[k]);
  });
  const xTicks = words ? words.map((_, k) => k) : roundTicks(x0, x1, spec.wide ? 10 : 5);
  const xTexts = words ?? tickText(log ? xTicks.map((x) => 10 ** x) : xTicks);
  const room = ((width - LEFT - RIGHT) / Math.max(1, xTicks.length)) * (words ? 1 : 1.2);
  const fits = Math.max(3, Math.floor(room / 6.5));
  xTicks.forEach((x, k) => {
    const at = px(log && !words ? 10 ** x : x);
    picture.append(svg('line', { class: 'grid', x1: at, x2: at, y1: TOP, y2: height - BOTTOM }));
    const short = xTexts[k].length > fits ? `${xTexts[k].slice(0, fits - 1)}…` : xTexts[k];
    text(at, height - BOTTOM + 14, 'middle', short);
  });
  text((LEFT + width - RIGHT) / 2, height - 4, 'middle', spec.x.label);
  for (const line of spec.lines) {
    let path = '';
    let open = false;
    for (let i = 0; i < line.x.length; ++i) {
      const known = Number.isFinite(line.y[i]) && Number.isFinite(scaled(line.x[i]));
      if (known) path += `${open ? 'L' : 'M'}${px(line.x[i]).toFixed(1)} ${py(line.y[i]).toFixed(1)}`;
      open = known;
    }
    picture.append(svg('path', { d: path, fill: 'none', stroke: line.colour, 'stroke-width': line.width, 'stroke-linejoin': 'round' }));
  }
  // Those that matter lie above the others.
  for (const point of [...spec.points].sort((a, b) => Number(a.strong) - Number(b.strong))) {
    if (!Number.isFinite(point.y) || !Number.isFinite(scaled(point.x))) continue;
    const dot = svg('circle', { cx: px(point.x).toFixed(1), cy: py(point.y).toFixed(1), r: point.strong ? 6 : 4, fill: point.colour, class: point.strong ? 'dot strong' : 'dot' }, svg('title', {}, point.title));
    if (point.choose) dot.addEventListener('click', point.choose);
    picture.append(dot);
  }
  return h('figure', { class: 'plot' }, h('figcaption', {}, h('span', { class: 'plot-title' }, spec.title), spec.unit ? h('span', { class: 'unit' }, spec.unit) : null), picture as unknown as Node);
}
