// One axis with its curves (uPlot), its legend and its part in the hub.

import uPlot from 'uplot';
import type { Channel } from '../data/channels';
import { formatNumber, tickText, withUnit } from '../data/format';
import { difference, resample, union, valueAt, type Difference } from '../data/series';
import { CURVE_COLOURS } from '../scene/palette';
import { h } from './dom';
import type { Hub, HubMember } from './hub';
import { cssColour, isDark } from './theme';
import { listenToTouches } from './touch';

const DARK_CURVES = ['#56a9e8', '#f0853f', '#2fc092', '#e2a0c6', '#9fd7f7', '#f0b840', '#a99dff', '#bcc3ca'];

interface Entry {
  channel: Channel;
  shown: boolean;
  chip: HTMLButtonElement;
  value: HTMLElement;
  note: HTMLElement;
}

interface Line {
  entry: Entry;
  time: ArrayLike<number>;
  values: ArrayLike<number>;
  dashed: boolean;
}

export interface PlotSpec {
  title: string;
  unit: string;
  channels: Channel[];
  height?: number;
  /** What the values are to stay below. */
  limit?: number | null;
}

// The limit belongs on the axis where the curves reach this part of it; further away it is said in words.
const NEAR_LIMIT = 1 / 3;

const FONT = '11px system-ui, -apple-system, "Segoe UI", sans-serif';
const LEAST_AXIS = 62;
let pen: CanvasRenderingContext2D | null = null;

/** Width of the widest text of an axis, in pixels. */
function widest(texts: readonly (string | number | null)[] | null): number {
  pen ??= document.createElement('canvas').getContext('2d')!;
  pen.font = FONT;
  return (texts ?? []).reduce<number>((most, text) => Math.max(most, pen!.measureText(String(text ?? '')).width), 0);
}

/** Distance of numbers on the axis of time so that they do not touch, with the digits that a zoomed range needs. */
function timeSpace(min: number, max: number, width: number): number {
  const step = (60 * (max - min)) / Math.max(1, width);
  return Math.max(60, widest(tickText([max - step, max])) + 22);
}

function gaps(values: Float64Array): ArrayLike<number> | (number | null)[] {
  return values.every(Number.isFinite) ? values : Array.from(values, (value) => (Number.isFinite(value) ? value : null));
}

export class TimePlot implements HubMember {
  readonly element: HTMLElement;
  private readonly spec: PlotSpec;
  private readonly hub: Hub;
  private readonly entries: Entry[];
  private readonly box: HTMLElement;
  private readonly cursor = h('div', { class: 'time-cursor' });
  private plot: uPlot | null = null;
  private lines: Line[] = [];
  private visible = false;
  private guard = false;
  private readonly observer: IntersectionObserver;
  private readonly sizes: ResizeObserver;

  constructor(spec: PlotSpec, hub: Hub) {
    this.spec = spec;
    this.hub = hub;
    this.entries = spec.channels.map((channel, k) => this.makeEntry(channel, k));
    this.box = h('div', { class: 'plot-box', style: `height: ${spec.height ?? 180}px` });
    this.element = h(
      'figure',
      { class: 'plot' },
      h('figcaption', {}, h('span', { class: 'plot-title' }, spec.title), spec.unit ? h('span', { class: 'unit' }, spec.unit) : null, spec.limit == null ? null : h('span', { class: 'plot-note' }, `limit ${withUnit(spec.limit, spec.unit, 3)}`)),
      this.box,
      h('div', { class: 'chips' }, ...this.entries.map((entry) => entry.chip)),
    );
    this.observer = new IntersectionObserver(
      (changes) => {
        this.visible = changes[changes.length - 1].isIntersecting;
        if (!this.visible) return;
        if (!this.plot) this.build();
        this.timeChanged();
        this.rangeChanged();
      },
      { rootMargin: '250px' },
    );
    this.observer.observe(this.box);
    this.sizes = new ResizeObserver(() => {
      if (this.plot && this.box.clientWidth > 0) this.plot.setSize({ width: this.box.clientWidth, height: this.spec.height ?? 180 });
      this.timeChanged();
    });
    this.sizes.observe(this.box);
    window.addEventListener('beforeprint', this.toPaper);
    hub.add(this);
  }

  /** Plots are drawn when they come into view; paper shows all. */
  private readonly toPaper = (): void => {
    if (!this.plot) this.build();
  };

  dispose(): void {
    window.removeEventListener('beforeprint', this.toPaper);
    this.hub.remove(this);
    this.observer.disconnect();
    this.sizes.disconnect();
    this.plot?.destroy();
    this.element.remove();
  }

  private makeEntry(channel: Channel, k: number): Entry {
    const value = h('span', { class: 'chip-value' });
    const note = h('span', { class: 'chip-note' });
    const chip = h(
      'button',
      { type: 'button', class: 'chip', 'aria-pressed': 'true', title: channel.name },
      h('span', { class: `swatch curve-${k % CURVE_COLOURS.length}` }),
      h('span', { class: 'chip-label' }, channel.label),
      value,
      note,
    );
    const entry: Entry = { channel, shown: true, chip, value, note };
    chip.addEventListener('click', () => {
      entry.shown = !entry.shown;
      chip.setAttribute('aria-pressed', String(entry.shown));
      this.lines.forEach((line, i) => {
        if (line.entry === entry) this.plot?.setSeries(i + 1, { show: entry.shown });
      });
    });
    return entry;
  }

  /** The curve of a second run, from a comparison or dropped on the page. */
  private second(channel: Channel): { time: Float64Array; values: Float64Array } | null {
    const column = this.hub.overlay?.columns.get(channel.name);
    return column ? { time: this.hub.overlay!.time, values: column } : channel.other;
  }

  private collect(): void {
    this.lines = [];
    for (const entry of this.entries) {
      const { channel } = entry;
      const second = this.second(channel);
      entry.note.textContent = '';
      if (second) {
        const found: Partial<Difference> | null = channel.stated && !this.hub.overlay ? { max: channel.stated.max ?? undefined, rms: channel.stated.rms ?? undefined } : difference(channel.time, channel.values, second.time, second.values);
        if (found?.max !== undefined) {
          entry.note.textContent = `Δ max ${withUnit(found.max, '', 3)}${found.rms !== undefined ? `, rms ${withUnit(found.rms, '', 3)}` : ''}`;
        }
      }
      if (second && this.hub.showDifference) {
        const time = union(channel.time, second.time);
        const a = resample(channel.time, channel.values, time);
        const b = resample(second.time, second.values, time);
        this.lines.push({ entry, time, values: b.map((value, i) => value - a[i]), dashed: false });
        continue;
      }
      this.lines.push({ entry, time: channel.time, values: channel.values, dashed: false });
      if (second) this.lines.push({ entry, time: second.time, values: second.values, dashed: true });
    }
  }

  private build(): void {
    this.collect();
    this.plot?.destroy();
    const times: ArrayLike<number>[] = [];
    for (const line of this.lines) if (!times.includes(line.time)) times.push(line.time);
    const x = times.length > 1 ? times.reduce((a, b) => union(a, b)) : times[0];
    const data = [x, ...this.lines.map((line) => gaps(line.time === x ? Float64Array.from(line.values) : resample(line.time, line.values, x)))] as unknown as uPlot.AlignedData;
    const palette = isDark() ? DARK_CURVES : CURVE_COLOURS;
    const axis: Partial<uPlot.Axis> = {
      stroke: () => cssColour('--muted'),
      grid: { stroke: () => cssColour('--grid'), width: 1 },
      ticks: { stroke: () => cssColour('--grid'), width: 1, size: 4 },
      font: FONT,
      gap: 4,
    };
    let lastTime = '';
    const options: uPlot.Options = {
      width: Math.max(120, this.box.clientWidth),
      height: this.spec.height ?? 180,
      // Half of the last number of the axis stands beside it.
      padding: [8, () => Math.max(10, Math.ceil(widest([lastTime]) / 2) + 2), 0, 0],
      legend: { show: false },
      cursor: { y: false, drag: { x: true, y: false, setScale: true }, points: { size: 6 } },
      scales: {
        x: { time: false, range: (_u, min, max) => (min === max ? [min - 0.5, max + 0.5] : [min, max]) },
        y: {
          range: (_u, min, max) => {
            if (min === null || max === null || !Number.isFinite(min) || !Number.isFinite(max)) return [0, 1];
            const limit = this.spec.limit;
            if (limit != null && max >= NEAR_LIMIT * limit) max = Math.max(max, limit);
            const pad = max > min ? 0.07 * (max - min) : Math.max(Math.abs(max) * 0.01, 1e-12);
            return [min - pad, max + pad];
          },
        },
      },
      axes: [
        {
          ...axis,
          size: 26,
          values: (_u, splits) => {
            const texts = tickText(splits);
            lastTime = `${texts[texts.length - 1] ?? ''} s`;
            return texts.map((text, i) => (i === texts.length - 1 ? lastTime : text));
          },
          space: (_u, _axis, min, max, width) => timeSpace(min, max, width),
        },
        { ...axis, size: (_u, values) => Math.max(LEAST_AXIS, Math.ceil(widest(values)) + 14), values: (_u, splits) => tickText(splits), space: 30 },
      ],
      series: [
        {},
        ...this.lines.map((line) => ({
          stroke: palette[this.entries.indexOf(line.entry) % palette.length],
          width: line.dashed ? 1.3 : 1.6,
          dash: line.dashed ? [5, 4] : undefined,
          show: line.entry.shown,
          spanGaps: true,
          points: { show: false },
        })),
      ],
      hooks: {
        setScale: [
          (u, key) => {
            if (key !== 'x' || this.guard || !this.plot) return;
            const { min, max } = u.scales.x;
            const first = u.data[0][0];
            const last = u.data[0][u.data[0].length - 1];
            if (min == null || max == null) return;
            this.hub.setRange(min <= first && max >= last ? null : [min, max]);
          },
        ],
        draw: [(u) => this.drawLimit(u)],
        setCursor: [
          (u) => {
            if (this.guard) return;
            const left = u.cursor.left ?? -1;
            this.hub.setHover(left >= 0 ? u.posToVal(left, 'x') : null);
          },
        ],
      },
    };
    this.guard = true;
    this.box.replaceChildren();
    this.plot = new uPlot(options, data, this.box);
    this.listen(this.plot);
    this.plot.over.append(this.cursor);
    this.guard = false;
    this.rangeChanged();
    this.timeChanged();
  }

  private drawLimit(u: uPlot): void {
    const { limit } = this.spec;
    if (limit == null || !(limit >= u.scales.y.min! && limit <= u.scales.y.max!)) return;
    const y = Math.round(u.valToPos(limit, 'y', true));
    u.ctx.save();
    u.ctx.strokeStyle = cssColour('--warn');
    u.ctx.lineWidth = devicePixelRatio;
    u.ctx.setLineDash([6 * devicePixelRatio, 4 * devicePixelRatio]);
    u.ctx.beginPath();
    u.ctx.moveTo(u.bbox.left, y);
    u.ctx.lineTo(u.bbox.left + u.bbox.width, y);
    u.ctx.stroke();
    u.ctx.restore();
  }

  private listen(u: uPlot): void {
    let down = 0;
    u.over.addEventListener('mousedown', (event) => (down = event.clientX));
    u.over.addEventListener('click', (event) => {
      if (Math.abs(event.clientX - down) < 4) this.hub.seek(u.posToVal(event.clientX - u.over.getBoundingClientRect().left, 'x'));
    });
    u.over.addEventListener(
      'wheel',
      (event) => {
        if (!event.ctrlKey && !event.metaKey && !event.shiftKey) return;
        event.preventDefault();
        const at = u.posToVal(event.clientX - u.over.getBoundingClientRect().left, 'x');
        const factor = Math.exp(0.0015 * (event.deltaY || event.deltaX));
        this.showRange(u, at - factor * (at - u.scales.x.min!), at + factor * (u.scales.x.max! - at));
      },
      { passive: false },
    );
    listenToTouches(u, () => this.hub.range !== null, (min, max) => this.showRange(u, min, max));
  }

  /** What of it there is. */
  private showRange(u: uPlot, from: number, to: number): void {
    const first = u.data[0][0];
    const last = u.data[0][u.data[0].length - 1];
    const min = Math.max(first, from);
    const max = Math.min(last, to);
    if (max - min > 1e-9 * (last - first)) this.hub.setRange(min <= first && max >= last ? null : [min, max]);
  }

  rangeChanged(): void {
    const u = this.plot;
    if (!u || !this.visible) return;
    const x = u.data[0];
    const [min, max] = this.hub.range ?? [x[0], x[x.length - 1]];
    if (u.scales.x.min !== min || u.scales.x.max !== max) {
      this.guard = true;
      u.setScale('x', { min, max });
      // The scale is set with the next drawing.
      queueMicrotask(() => {
        this.guard = false;
        this.timeChanged();
      });
    }
  }

  hoverChanged(): void {
    const u = this.plot;
    if (!u || !this.visible) return;
    const { hover } = this.hub;
    this.guard = true;
    u.setCursor({ left: hover === null ? -10 : u.valToPos(hover, 'x'), top: hover === null ? -10 : 10 }, false);
    this.guard = false;
    this.writeValues();
  }

  timeChanged(): void {
    const u = this.plot;
    const player = this.hub.player;
    if (!u || !this.visible || !player) {
      this.cursor.style.display = 'none';
      if (u && this.visible) this.writeValues();
      return;
    }
    const left = u.valToPos(player.time, 'x');
    const inside = left >= 0 && left <= u.over.clientWidth;
    this.cursor.style.display = inside ? '' : 'none';
    this.cursor.style.transform = `translateX(${left.toFixed(1)}px)`;
    if (this.hub.textsDue) this.writeValues();
  }

  private writeValues(): void {
    const time = this.hub.hover ?? this.hub.player?.time ?? null;
    for (const entry of this.entries) {
      const value = time === null ? NaN : valueAt(entry.channel.time, entry.channel.values, time);
      const text = Number.isNaN(value) ? '' : formatNumber(value, 5);
      if (entry.value.textContent !== text) entry.value.textContent = text;
    }
  }

  dataChanged(): void {
    if (this.plot) this.build();
  }
}
