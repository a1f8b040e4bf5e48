// What is known of a joint, a force or a rod, with its numbers at the time of the view.

import type { Channel } from '../data/channels';
import { formatEffort, formatNumber, withUnit } from '../data/format';
import type { ForceJson, JointJson } from '../data/page';
import type { SceneData } from '../data/scene_data';
import { valueAt } from '../data/series';
import type { Part } from '../scene/connections';
import { h } from './dom';

/** A line of the table: what it says at a time. */
export interface PartLine {
  name: string;
  text: (time: number) => string;
}

/** A number over the frames, for a curve. */
export interface PartCurve {
  name: string;
  unit: string;
  values: Float64Array;
}

export interface PartValues {
  title: string;
  about: string;
  lines: PartLine[];
  curves: PartCurve[];
  /** Why there are no numbers; empty: there are some. */
  note: string;
}

function bodyOf(scene: SceneData, point: number): string {
  const body = scene.points[point]?.body ?? -1;
  return body < 0 ? 'ground' : scene.bodies[body].name;
}

function numberText(value: number, unit: string): string {
  if (!Number.isFinite(value)) return 'not known';
  if (unit === 'N' || unit === 'N m') return formatEffort(value, unit, 4);
  const text = withUnit(value, unit);
  return unit === 'rad' ? `${text} (${formatNumber((180 / Math.PI) * value)}°)` : text;
}

function vectorText(xyz: number[], unit: string): string {
  if (!xyz.every(Number.isFinite)) return 'not known';
  return `${formatEffort(Math.hypot(...xyz), unit, 4)}: ${xyz.map((x) => formatNumber(x, 4)).join(', ')}`;
}

function addWrench(scene: SceneData, force: ForceJson, lines: PartLine[]): void {
  const { wrench } = force;
  const efforts = scene.efforts!;
  if (!wrench) return;
  const body = bodyOf(scene, wrench.at);
  const add = (name: string, unit: string, columns: number[]): void => {
    if (columns.every((c) => efforts.constant(c) && efforts.atFrame(c, 0) === 0)) return;
    lines.push({ name: `${name} on ${body}: x, y, z [${unit}]`, text: (time) => vectorText(columns.map((c) => efforts.at(c, time)), unit) });
  };
  add('force', 'N', wrench.columns.slice(0, 3));
  add('torque', 'N m', wrench.columns.slice(3));
}

/** `channels`: those of the page, of which those about the part are shown, too. */
export function valuesOfPart(scene: SceneData, part: Part, channels: Channel[]): PartValues {
  const entity = part.kind === 'joint' ? scene.joints[part.index] : part.kind === 'force' ? scene.forces[part.index] : scene.rods[part.index];
  const lines: PartLine[] = [];
  const curves: PartCurve[] = [];
  const { efforts } = scene;
  const values = (entity as JointJson | ForceJson).values ?? [];
  if (efforts) {
    for (const { name, unit, column } of values) {
      lines.push({ name, text: (time) => numberText(efforts.at(column, time), unit ?? '') });
      if (!efforts.constant(column)) curves.push({ name, unit: unit ?? '', values: efforts.history(column) });
    }
    if (part.kind === 'force') addWrench(scene, entity as ForceJson, lines);
  }
  for (const channel of channels) {
    if (channel.body === entity.name) lines.push({ name: channel.label, text: (time) => numberText(valueAt(channel.time, channel.values, time), channel.unit) });
  }
  const type = part.kind === 'rod' ? 'rod' : (entity as JointJson | ForceJson).type.replace(/_/g, ' ');
  const ends = [entity.a, entity.b].filter((end) => end >= 0).map((end) => bodyOf(scene, end));
  const about = [type, (entity as JointJson).cut ? 'cut' : '', ends.length > 1 ? `${ends[0]} to ${ends[1]}` : ends.length > 0 ? `on ${ends[0]}` : ''].filter(Boolean).join(', ');
  const note = lines.length > 0 ? '' : 'This page holds no values of it. An output of the model file gives its reaction.';
  return { title: entity.name, about, lines, curves, note };
}

/** The table, and what brings it to a time. */
export function partTable(values: PartValues): { element: HTMLElement; show: (time: number) => void } {
  const cells = values.lines.map(() => h('td', {}));
  const rows = values.lines.map((line, k) => h('tr', {}, h('th', { scope: 'row' }, line.name), cells[k]));
  return {
    element: h('table', { class: 'pairs part-values' }, h('tbody', {}, ...rows)),
    show: (time) => values.lines.forEach((line, k) => (cells[k].textContent = line.text(time))),
  };
}
