// Which scalar the surfaces are coloured by, and its range over the run.

import type { SceneData } from '../data/scene_data';
import { fieldRange, largestDisplacement } from '../motion/elastic_range';
import { largestStressOfModes } from '../motion/stress';
import type { MapName } from '../scene/palette';
import type { ColourChoice } from '../scene/stage';

export interface Scalar {
  /** null: elastic displacement. */
  field: string | null;
  label: string;
  unit: string;
}

export class Colours {
  readonly scalars: Scalar[] = [];
  map: MapName = 'viridis';
  private readonly scene: SceneData;
  private readonly modes = new Map<number, Float64Array>();
  private readonly ranges = new Map<string | null, [number, number]>();
  /** Largest displacement of each body. */
  readonly largest: Float64Array;

  constructor(scene: SceneData) {
    this.scene = scene;
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
      this.ranges.set(null, [0, 1]);
      return;
    }
    for (const body of flexible) this.largest[body.index] = largestDisplacement(scene, body);
    const most = this.largest.reduce((a, b) => Math.max(a, b), 0);
    this.ranges.set(null, [0, most > 0 ? most : 1e-6]);
  }

  setRange(field: string | null, range: [number, number]): void {
    this.ranges.set(field, range);
  }

  /** Of the mode that swings: a stress is shown in parts of its largest. */
  setMode(body: number, mode: number, amplitude: number): void {
    const stress = this.scene.bodies[body].mesh?.stress;
    if (!stress) return;
    if (!this.modes.has(body)) this.modes.set(body, largestStressOfModes(this.scene.bodies[body], stress));
    const most = Math.max(1e-30, amplitude * this.modes.get(body)![mode]);
    for (const { name, stress: of } of this.scene.bodies[body].mesh!.fields) if (of) this.ranges.set(name, of.quantity === 'von_mises' ? [0, most] : [-most, most]);
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

  range(field: string | null): [number, number] {
    const known = this.ranges.get(field);
    if (known) return known;
    let low = Infinity;
    let high = -Infinity;
    for (const body of this.scene.bodies) {
      for (const candidate of body.mesh?.fields ?? []) {
        const range = candidate.name === field ? fieldRange(this.scene, body, candidate) : null;
        if (!range) continue;
        low = Math.min(low, range[0]);
        high = Math.max(high, range[1]);
      }
    }
    const range: [number, number] = low < high ? [low, high] : Number.isFinite(low) ? [low - 0.5, low + 0.5] : [0, 1];
    this.ranges.set(field, range);
    return range;
  }

  choice(field: string | null | undefined): ColourChoice {
    return { field, range: field === undefined ? [0, 1] : this.range(field), map: this.map };
  }

  unit(field: string | null | undefined): string {
    return this.scalars.find((scalar) => scalar.field === field)?.unit ?? '';
  }
}
