// What is known of the chosen body, node, joint or force, and its history as curves made on the spot.

import type { Channel } from '../data/channels';
import { formatLength, formatNumber, lengthUnit } from '../data/format';
import type { BodyData, SceneData } from '../data/scene_data';
import { rangeOf } from '../data/series';
import { elastic, Motion } from '../motion/motion';
import { stressAt, vonMises } from '../motion/stress';
import type { Part } from '../scene/connections';
import type { Stage } from '../scene/stage';
import { h } from './dom';
import type { Hub } from './hub';
import { partTable, valuesOfPart } from './part_values';
import { TimePlot } from './plot';

interface Track {
  position: [Float64Array, Float64Array, Float64Array];
  displacement: Float64Array | null;
}

/** Place in the world and elastic displacement over all frames. */
export function trackOf(scene: SceneData, body: BodyData, vertex: number | null): Track {
  const n = scene.time.length;
  const motion = new Motion(scene);
  const position: Track['position'] = [new Float64Array(n), new Float64Array(n), new Float64Array(n)];
  const bends = vertex !== null && body.mesh?.modes;
  const displacement = bends ? new Float64Array(n) : null;
  for (let f = 0; f < n; ++f) {
    motion.go(scene.time[f]);
    let local: [number, number, number] = [0, 0, 0];
    if (vertex !== null && body.mesh) {
      const u = elastic(body, vertex, motion.amplitudes, body.firstMode);
      const { vertices } = body.mesh;
      local = [vertices[3 * vertex] + u[0], vertices[3 * vertex + 1] + u[1], vertices[3 * vertex + 2] + u[2]];
      if (displacement) displacement[f] = Math.hypot(...u);
    }
    const p = motion.toWorld(body.index, ...local);
    for (let i = 0; i < 3; ++i) position[i][f] = p[i] + scene.origin[i];
  }
  return { position, displacement };
}

function channel(name: string, label: string, unit: string, time: Float64Array, values: Float64Array): Channel {
  return { name, label, unit, body: null, kind: '', group: '', time, values, range: rangeOf(values), still: null, other: null, stated: null };
}

function row(name: string, value: string): HTMLElement {
  return h('tr', {}, h('th', { scope: 'row' }, name), h('td', {}, value));
}

export class Selection {
  readonly element = h('div', { class: 'selection' });
  private readonly stage: Stage;
  private readonly hub: Hub;
  private readonly largest: ArrayLike<number>;
  private readonly channels: Channel[];
  private plots: TimePlot[] = [];
  /** Brings the numbers of a part to a time. */
  private bring: ((time: number) => void) | null = null;

  constructor(stage: Stage, hub: Hub, largest: ArrayLike<number>, channels: Channel[]) {
    this.stage = stage;
    this.hub = hub;
    this.largest = largest;
    this.channels = channels;
    const nothing = (): void => {};
    hub.add({ rangeChanged: nothing, hoverChanged: nothing, dataChanged: nothing, timeChanged: () => hub.textsDue && this.bring?.(hub.player?.time ?? 0) });
    this.show(-1, null);
  }

  private clear(): void {
    for (const plot of this.plots) plot.dispose();
    this.plots = [];
    this.bring = null;
    this.element.replaceChildren();
  }

  private add(title: string, unit: string, channels: Channel[]): void {
    const plot = new TimePlot({ title, unit, channels, height: 130 }, this.hub);
    this.plots.push(plot);
    this.element.append(plot.element);
  }

  showPart(part: Part): void {
    this.clear();
    const { scene } = this.stage;
    const values = valuesOfPart(scene, part, this.channels);
    const table = partTable(values);
    this.element.append(h('h3', {}, values.title), h('p', { class: 'hint' }, values.about), values.note ? h('p', { class: 'hint' }, values.note) : table.element);
    this.bring = table.show;
    table.show(this.hub.player?.time ?? scene.time[0] ?? 0);
    for (const { name, unit, values: numbers } of values.curves) this.add(name.charAt(0).toUpperCase() + name.slice(1), unit, [channel(name, name, unit, scene.time, numbers)]);
  }

  show(index: number, vertex: number | null): void {
    this.clear();
    const { scene } = this.stage;
    const body = scene.bodies[index];
    if (!body) {
      this.element.append(h('p', { class: 'hint' }, 'Click a body, a joint, a spring, a tyre or an arrow in the view, or a name in the list of bodies: what is known of it and its history appear here.'));
      return;
    }
    const node = vertex !== null ? (body.mesh?.nodes?.[vertex] ?? null) : null;
    const title = vertex === null ? body.name : `${body.name}, ${node !== null ? `node ${node}` : `vertex ${vertex}`}`;
    const rows = [...body.facts.map(([name, value]) => row(name, value))];
    if (body.mass !== null && !body.facts.some(([name]) => name.toLowerCase() === 'mass')) rows.unshift(row('mass', `${formatNumber(body.mass, 5)} kg`));
    if (vertex !== null && body.mesh) {
      const [x, y, z] = body.mesh.vertices.subarray(3 * vertex, 3 * vertex + 3);
      rows.push(row('place in the body', `${[x, y, z].map((v) => formatNumber(v, 4)).join(', ')} m`));
    }
    if (this.largest[index] > 0) {
      const part = body.size > 0 ? `, ${formatNumber((100 * this.largest[index]) / body.size, 2)} % of its size` : '';
      rows.push(row('largest displacement', `${formatLength(this.largest[index])}${part}`));
    }
    const stress = vertex !== null ? body.mesh?.stress : null;
    if (stress?.envelope && vertex !== null) {
      const when = stress.when ? ` at ${formatNumber(stress.when[vertex], 4)} s` : '';
      rows.push(row('largest von Mises stress', `${formatNumber(stress.envelope[vertex], 4)} MPa${when}`));
    }
    if (body.stressLeftOut !== null) rows.push(row('stress', 'left out of the page for its size'));
    if (stress?.doubtful?.[vertex!]) rows.push(row('stress', 'not to be trusted: next to a rigid spider'));
    this.element.append(h('h3', {}, title), h('table', { class: 'pairs' }, h('tbody', {}, ...rows)));
    this.addHistory(body, vertex);
    if (body.modeCount > 0) this.element.append(this.modesOf(body));
  }

  private modesOf(body: BodyData): HTMLElement {
    const rows = Array.from({ length: body.modeCount }, (_, j) => {
      const f = body.frequencies[j];
      return h('tr', {}, h('td', {}, body.modeNames[j] ?? `mode ${j + 1}`), h('td', { class: 'number' }, typeof f === 'number' ? `${formatNumber(f, 5)} Hz` : '–'));
    });
    return h('details', { class: 'fold', open: body.modeCount <= 8 }, h('summary', {}, `${body.modeCount} modes`), h('table', {}, h('tbody', {}, ...rows)));
  }

  private addHistory(body: BodyData, vertex: number | null): void {
    const { scene } = this.stage;
    if (scene.time.length < 2) return;
    const { position, displacement } = trackOf(scene, body, vertex);
    const add = this.add.bind(this);
    if (displacement) {
      const unit = lengthUnit(displacement.reduce((a, b) => Math.max(a, b), 0));
      add('Elastic displacement', unit.name, [channel('displacement', 'magnitude', unit.name, scene.time, displacement.map((v) => v * unit.factor))]);
    }
    const stress = vertex !== null ? body.mesh?.stress : null;
    if (stress && scene.amplitudes) {
      const values = Float64Array.from(scene.time, (_, f) => vonMises(stressAt(body, stress, vertex!, scene.amplitudes!, f * scene.amplitudeCount + body.firstMode, f * scene.amplitudeCount)));
      add('Von Mises stress', 'MPa', [channel('von Mises stress', 'von Mises', 'MPa', scene.time, values)]);
    }
    // Each axis its own picture where the ranges differ much.
    const spans = position.map((p) => (rangeOf(p) ?? { min: 0, max: 0 })).map((r) => r.max - r.min);
    const largest = Math.max(...spans);
    const together: Channel[] = [];
    position.forEach((p, i) => {
      const c = channel(`position ${'xyz'[i]}`, 'xyz'[i], 'm', scene.time, p);
      if (spans[i] === largest || spans[i] > largest / 4) together.push(c);
      else if (spans[i] > 1e-9 * this.stage.size) add(`Position ${'xyz'[i]}`, 'm', [c]);
    });
    if (largest > 1e-9 * this.stage.size) {
      for (const c of together) add(`Position ${c.label}`, 'm', [c]);
    } else this.element.append(h('p', { class: 'hint' }, 'It does not move.'));
  }
}
