// Which scalar the surfaces are coloured by, and its scale.

import { lengthUnit } from '../data/format';
import type { BodyData, SceneData } from '../data/scene_data';
import { fieldRange, largestDisplacement } from '../motion/elastic_range';
import type { Motion } from '../motion/motion';
import { extremesOfPlaces, has, quantile, rangeNow } from '../motion/scale_ranges';
import { largestStressOfModes } from '../motion/stress';
import { mapName, spreadOf, type BaseMap } from '../scene/palette';
import type { ColourChoice } from '../scene/stage';

export interface Scalar {
  /** null: elastic displacement. */
  field: string | null;
  label: string;
  unit: string;
}

/** What the scale is that of. */
export type Scope = 'run' | 'visible' | 'body' | 'now' | 'percentile' | 'limit' | 'typed';

/** What of the view a scale may depend on. */
export interface Shown {
  motion: Motion;
  visible: (body: number) => boolean;
  /** -1: none is chosen. */
  chosen: () => number;
}

type Range = [number, number];

function union(ranges: (Range | null)[]): Range | null {
  const known = ranges.filter((range) => range !== null);
  return known.length > 0 ? [Math.min(...known.map((range) => range[0])), Math.max(...known.map((range) => range[1]))] : null;
}

/** With an extent, however little there is to show. */
function opened([low, high]: Range): Range {
  if (low < high) return [low, high];
  return low === 0 ? [0, 1e-6] : [Math.min(low, 0), Math.max(low, 0)];
}

export class Colours {
  readonly scalars: Scalar[] = [];
  base: BaseMap = 'viridis';
  bands = 0;
  scope: Scope = 'run';
  /** Part of the places in percent that the scale of percentiles holds. */
  percent = 98;
  private readonly scene: SceneData;
  private readonly shown: Shown | null;
  private readonly modes = new Map<number, Float64Array>();
  /** Of modes and vibrations, whose scale has no choices. */
  private readonly fixed = new Map<string | null, Range>();
  private readonly ofBody = new Map<string, Range | null>();
  private readonly ofPlaces = new Map<string, { least: number[]; most: number[] }>();
  private readonly typed = new Map<string | null, Range>();
  private readonly limits = new Map<string | null, number>();
  /** Largest displacement of each body. */
  readonly largest: Float64Array;

  constructor(scene: SceneData, shown: Shown | null = null) {
    this.scene = scene;
    this.shown = shown;
    this.largest = new Float64Array(scene.bodies.length);
    const swings = scene.vibrations.length > 0;
    const flexible = scene.bodies.filter((body) => body.mesh?.modes);
    if (swings ? scene.bodies.some((body) => body.mesh) : flexible.length > 0) this.scalars.push({ field: null, label: swings ? 'Displacement' : 'Elastic displacement', unit: 'm' });
    for (const body of swings ? [] : scene.bodies) {
      for (const field of body.mesh?.fields ?? []) {
        if (!this.scalars.some((scalar) => scalar.field === field.name)) this.scalars.push({ field: field.name, label: field.name, unit: field.unit });
      }
    }
    // Of what swings: in parts of the largest.
    if (swings) {
      this.fixed.set(null, [0, 1]);
      return;
    }
    for (const body of flexible) this.largest[body.index] = largestDisplacement(scene, body);
  }

  /** Of a part whose modes swing. */
  setRange(field: string | null, range: Range): void {
    this.fixed.set(field, range);
  }

  /** Of the mode that swings: a stress is shown in parts of its largest. */
  setMode(body: number, mode: number, amplitude: number): void {
    const stress = this.scene.bodies[body].mesh?.stress;
    if (!stress) return;
    if (!this.modes.has(body)) this.modes.set(body, largestStressOfModes(this.scene.bodies[body], stress));
    const most = Math.max(1e-30, amplitude * this.modes.get(body)![mode]);
    for (const { name, stress: of } of this.scene.bodies[body].mesh!.fields) if (of) this.fixed.set(name, of.quantity === 'von_mises' ? [0, most] : [-most, most]);
  }

  /** A stress of a mode has no size of its own. */
  isStress(field: string | null | undefined): boolean {
    return this.scene.bodies.some((body) => body.mesh?.fields.some((candidate) => candidate.name === field && candidate.stress));
  }

  /** What the colours of a stress do not say themselves. */
  note(field: string | null | undefined): string {
    const shown = this.scene.bodies.flatMap((body) => (body.mesh?.fields ?? []).filter((candidate) => candidate.name === field && candidate.stress).map((candidate) => candidate.stress!));
    const sentences: string[] = [];
    if (shown.some(({ data }) => data.doubtful?.includes(1))) sentences.push('Grey: next to a rigid spider, not to be trusted.');
    const envelope = shown.length > 0 && shown[0].quantity === 'envelope';
    if (shown.some(({ data }) => data.several)) sentences.push(`Of sides and materials that meet at a place, the ${envelope ? 'largest' : 'one that the modes load most'}.`);
    if (envelope && !shown.every(({ data }) => data.allInstants)) sentences.push('Of the instants shown; more were recorded.');
    return sentences.join(' ');
  }

  /** Bodies whose stress is not in the page. */
  leftOut(): string {
    const without = this.scene.bodies.filter((body) => body.stressLeftOut !== null);
    if (without.length === 0) return '';
    return `Stress is left out for its size: ${without.map((body) => `${body.name} (${body.stressLeftOut!.toPrecision(3)} million numbers)`).join(', ')}. floatframe stress and the exported files have it.`;
  }

  private get bodies(): BodyData[] {
    return this.scene.bodies;
  }

  private get visible(): BodyData[] {
    return this.bodies.filter((body) => !this.shown || this.shown.visible(body.index));
  }

  /** Of one body over the whole run. */
  private rangeOfBody(body: BodyData, field: string | null): Range | null {
    const key = JSON.stringify([body.index, field]);
    if (!this.ofBody.has(key)) {
      const of = field === null ? null : body.mesh?.fields.find((candidate) => candidate.name === field);
      const range: Range | null = field === null ? (has(body, null) ? [0, this.largest[body.index]] : null) : of ? fieldRange(this.scene, body, of) : null;
      this.ofBody.set(key, range);
    }
    return this.ofBody.get(key)!;
  }

  /** Of bodies over the whole run. */
  private runRange(field: string | null, bodies: BodyData[]): Range | null {
    return union(bodies.map((body) => this.rangeOfBody(body, field)));
  }

  /** The body whose scale is asked for: that which is chosen, if it has what is shown. */
  private chosenBody(field: string | null): BodyData | null {
    const body = this.bodies[this.shown?.chosen() ?? -1];
    return body && has(body, field) ? body : null;
  }

  private percentileRange(field: string | null): Range | null {
    const [least, most]: number[][] = [[], []];
    for (const body of this.visible) {
      const key = JSON.stringify([body.index, field]);
      if (!this.ofPlaces.has(key)) this.ofPlaces.set(key, extremesOfPlaces(this.scene, body, field));
      least.push(...this.ofPlaces.get(key)!.least);
      most.push(...this.ofPlaces.get(key)!.most);
    }
    if (most.length === 0) return null;
    const low = Math.min(...least);
    return [low >= 0 ? 0 : quantile(least, 1 - this.percent / 100), quantile(most, this.percent / 100)];
  }

  /** From zero where nothing is negative. */
  private instantRange(field: string | null): Range | null {
    const range = this.shown ? union(this.visible.map((body) => rangeNow(this.shown!.motion, body, field))) : null;
    return range && [Math.min(0, range[0]), range[1]];
  }

  private limitRange(field: string | null): Range | null {
    const limit = this.limits.get(field);
    const whole = this.runRange(field, this.bodies);
    return limit === undefined ? null : [whole && whole[0] < 0 ? -limit : 0, limit];
  }

  range(field: string | null): Range {
    const fixed = this.fixed.get(field);
    if (fixed) return fixed;
    const whole = this.runRange(field, this.bodies) ?? [0, 1];
    const chosen = this.chosenBody(field);
    const found: Record<Scope, () => Range | null> = {
      run: () => whole,
      visible: () => this.runRange(field, this.visible),
      body: () => chosen && this.rangeOfBody(chosen, field),
      now: () => this.instantRange(field),
      percentile: () => this.percentileRange(field),
      limit: () => this.limitRange(field),
      typed: () => this.typed.get(field) ?? null,
    };
    return opened(found[this.scope]() ?? whole);
  }

  /** What the scale is of, in words. */
  scopeText(field: string | null): string {
    if (this.fixed.has(field)) return '';
    const body = this.chosenBody(field);
    const whole = 'whole run, all bodies';
    const texts: Record<Scope, () => string> = {
      run: () => whole,
      visible: () => 'whole run, visible bodies',
      body: () => (body ? `whole run, ${body.name}` : `no body is chosen that has it: ${whole}`),
      now: () => 'this instant, visible bodies',
      percentile: () => `${this.percent} % of the places of visible bodies stay within it all the time`,
      limit: () => (this.limits.has(field) ? 'up to the limit' : `no limit is given: ${whole}`),
      typed: () => (this.typed.has(field) ? 'as typed' : whole),
    };
    return texts[this.scope]();
  }

  /** Whether visible bodies go below or above the scale at some time of the run. */
  beyond(field: string | null): [boolean, boolean] {
    const full = this.fixed.has(field) ? null : this.runRange(field, this.visible);
    if (!full) return [false, false];
    const [low, high] = this.range(field);
    const slack = 1e-6 * (high - low);
    return [full[0] < low - slack, full[1] > high + slack];
  }

  type(field: string | null, range: Range): void {
    this.typed.set(field, range);
    this.scope = 'typed';
  }

  setLimit(field: string | null, limit: number): void {
    this.limits.set(field, limit);
  }

  limit(field: string | null): number | undefined {
    return this.limits.get(field);
  }

  /** Whether the scale changes with time. */
  get moves(): boolean {
    return this.scope === 'now';
  }

  /** The scale has the colours of the map; `spread` is what they are stretched over. */
  choice(field: string | null | undefined): ColourChoice & { scale: Range } {
    const over = typeof field !== 'undefined' && this.scope === 'limit' && !this.fixed.has(field) && this.limits.has(field);
    const map = mapName({ base: this.base, bands: this.bands, over });
    const scale: Range = field === undefined ? [0, 1] : this.range(field);
    return { field, range: spreadOf(scale, map), map, scale };
  }

  /** Of the numbers of the scale, the same whatever its range: lengths in what suits the largest of the run. */
  unit(field: string | null | undefined): { name: string; factor: number } {
    if (field !== null) return { name: this.scalars.find((scalar) => scalar.field === field)?.unit ?? '', factor: 1 };
    return lengthUnit(this.fixed.get(null)?.[1] ?? this.runRange(null, this.bodies)?.[1] ?? 0);
  }
}
