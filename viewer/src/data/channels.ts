// Channels and how they share axes: by body, kind and unit, and only with others that an axis fits as well.

import { PageBuffer, PageError } from './buffer';
import type { ChannelJson, CurvesJson } from './page';
import { rangeOf, type Range } from './series';

export interface Channel {
  name: string;
  label: string;
  unit: string;
  body: string | null;
  kind: string;
  group: string;
  limit?: number | null;
  time: Float64Array;
  values: Float64Array;
  range: Range | null;
  /** One line of text instead of an axis. */
  still: 'constant' | 'noise' | null;
  other: { time: Float64Array; values: Float64Array } | null;
  stated: ChannelJson['difference'];
}

export interface PlotGroup {
  body: string | null;
  kind: string;
  unit: string;
  channels: Channel[];
}

export interface BodyGroup {
  body: string | null;
  plots: PlotGroup[];
  still: Channel[];
}

function shifted(data: ArrayLike<number>, offset: number): Float64Array {
  const values = new Float64Array(data.length);
  for (let i = 0; i < data.length; ++i) values[i] = offset + data[i];
  return values;
}

function text(value: unknown): string {
  return typeof value === 'string' ? value : '';
}

/** Single precision about an offset cannot tell numbers this near to zero from it. */
function snap(values: Float64Array, offset: number): void {
  let largest = 0;
  for (const value of values) if (Number.isFinite(value)) largest = Math.max(largest, Math.abs(value - offset));
  const resolution = largest * 2 ** -23;
  values.forEach((value, i) => {
    if (Math.abs(value) < resolution) values[i] = 0;
  });
}

export function readChannel(json: ChannelJson, curves: CurvesJson, time: Float64Array, buffer: PageBuffer): Channel {
  const name = text(json.name) || 'channel without a name';
  const data = buffer.read(json.data, `Channel "${name}"`, ['f32', 'f64'], [time.length]);
  const values = shifted(data, Number(json.offset ?? 0));
  if (json.data.type === 'f32') snap(values, Number(json.offset ?? 0));
  const range = rangeOf(values);
  let other: Channel['other'] = null;
  if (json.other) {
    if (!curves.other_time) throw new PageError(`Channel "${name}": a second curve is given without its times.`);
    const otherTime = buffer.read(curves.other_time, 'Times of the second run', ['f64', 'f32'], [null]);
    const second = buffer.read(json.other, `Second curve of channel "${name}"`, ['f32', 'f64'], [otherTime.length]);
    other = { time: Float64Array.from(otherTime), values: shifted(second, Number(json.other_offset ?? json.offset ?? 0)) };
  }
  // Under the heading of its body a channel needs no more than the rest of its name.
  const body = text(json.body);
  const long = text(json.label) || name;
  const label = body && long.startsWith(`${body}.`) && long.length > body.length + 1 ? long.slice(body.length + 1) : long;
  const flat = range !== null && range.min === range.max && !other;
  return {
    name,
    label,
    unit: text(json.unit),
    body: body || null,
    kind: text(json.kind) || 'other',
    group: text(json.group) || 'other',
    limit: typeof json.limit === 'number' && Number.isFinite(json.limit) ? json.limit : null,
    time,
    values,
    range,
    still: json.constant || flat ? 'constant' : json.noise ? 'noise' : null,
    other,
    stated: json.difference ?? null,
  };
}

function fullRange(channel: Channel): Range {
  const own = channel.range ?? { min: 0, max: 0 };
  const second = channel.other ? rangeOf(channel.other.values) : null;
  return second ? { min: Math.min(own.min, second.min), max: Math.max(own.max, second.max) } : own;
}

// A curve that would use less than this part of a shared axis gets an axis of its own.
const SMALLEST_SHARE = 1 / 7;
const MOST_CURVES = 8;

/** Channels of one body, kind and unit split so that each axis fits all its curves. */
export function shareAxes(channels: Channel[]): Channel[][] {
  const groups: { channels: Channel[]; range: Range; smallest: number }[] = [];
  for (const channel of channels) {
    const range = fullRange(channel);
    const span = range.max - range.min;
    const place = groups.find((group) => {
      const union = Math.max(group.range.max, range.max) - Math.min(group.range.min, range.min);
      return group.channels.length < MOST_CURVES && Math.min(group.smallest, span) >= SMALLEST_SHARE * union;
    });
    if (place) {
      place.channels.push(channel);
      place.range = { min: Math.min(place.range.min, range.min), max: Math.max(place.range.max, range.max) };
      place.smallest = Math.min(place.smallest, span);
    } else {
      groups.push({ channels: [channel], range, smallest: span });
    }
  }
  return groups.map((group) => group.channels);
}

/** Groups in the order in which bodies and kinds first appear; channels of no body come first. */
export function groupChannels(channels: Channel[]): BodyGroup[] {
  const bodies = new Map<string, BodyGroup>();
  const kinds = new Map<string, Channel[]>();
  for (const channel of channels) {
    const body = channel.body ?? '';
    let group = bodies.get(body);
    if (!group) bodies.set(body, (group = { body: channel.body, plots: [], still: [] }));
    if (channel.still && !channel.other) {
      group.still.push(channel);
      continue;
    }
    const key = JSON.stringify([body, channel.kind, channel.unit]);
    const list = kinds.get(key);
    if (list) list.push(channel);
    else kinds.set(key, [channel]);
  }
  for (const list of kinds.values()) {
    const { body, kind, unit } = list[0];
    const group = bodies.get(body ?? '')!;
    for (const shared of shareAxes(list)) group.plots.push({ body, kind, unit, channels: shared });
  }
  return [...bodies.values()].sort((a, b) => Number(a.body !== null) - Number(b.body !== null));
}
