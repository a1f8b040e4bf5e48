// Modes of a reduced part: a list with frequencies, each animated at its own amplitude.

import { formatNumber } from '../data/format';
import type { SceneData } from '../data/scene_data';
import { largestOfModes } from '../motion/elastic_range';
import type { Player } from '../motion/player';
import type { Stage } from '../scene/stage';
import { h } from './dom';

/** Seconds of one swing on the page, at speed 1. */
export const SWING = 2;
const PART_OF_SIZE = 0.1;

export class ModeList {
  readonly element = h('div', { class: 'modes' });
  private readonly stage: Stage;
  private readonly player: Player;
  private readonly rows: { element: HTMLElement; body: number; mode: number; amplitude: number }[] = [];
  chosen = 0;
  /** Called with the body, the mode that swings and its amplitude. */
  onChoice: (body: number, mode: number, amplitude: number) => void = () => {};

  constructor(stage: Stage, player: Player) {
    this.stage = stage;
    this.player = player;
    const list = h('ol', { class: 'mode-list', 'aria-label': 'Modes' });
    for (const body of stage.scene.bodies) {
      const largest = largestOfModes(body);
      const size = body.size > 0 ? body.size : stage.size;
      for (let mode = 0; mode < body.modeCount; ++mode) {
        const f = body.frequencies[mode];
        const row = this.rows.length;
        const element = h(
          'button',
          { type: 'button', class: 'mode', onclick: () => this.choose(row) },
          h('span', { class: 'mode-number' }, String(mode + 1)),
          h('span', { class: 'mode-name' }, body.modeNames[mode] ?? 'mode'),
          h('span', { class: 'mode-frequency' }, typeof f === 'number' ? `${formatNumber(f, 5)} Hz` : 'static'),
        );
        this.rows.push({ element, body: body.index, mode, amplitude: largest[mode] > 0 ? (PART_OF_SIZE * size) / largest[mode] : 0 });
        list.append(h('li', {}, element));
      }
    }
    this.element.append(list, h('p', { class: 'hint' }, 'Each mode swings so that its largest displacement is a tenth of the size of the part, times the deformation. Up and down arrows change the mode.'));
    stage.shape = (time) => this.shape(time);
    if (this.rows.length > 0) this.choose(0);
  }

  get count(): number {
    return this.rows.length;
  }

  /** Of the mode that swings [Hz]; null: it has none. */
  get frequency(): number | null {
    const chosen = this.rows[this.chosen];
    const f = chosen && this.stage.scene.bodies[chosen.body].frequencies[chosen.mode];
    return typeof f === 'number' && f > 0 ? f : null;
  }

  step(count: number): void {
    const next = Math.min(this.rows.length - 1, Math.max(0, this.chosen + count));
    if (next !== this.chosen) this.choose(next);
    const { element } = this.rows[next];
    const list = element.closest('.mode-list');
    if (list) list.scrollTop = element.offsetTop - list.clientHeight / 2;
  }

  choose(row: number): void {
    this.chosen = row;
    this.rows.forEach(({ element }, k) => element.setAttribute('aria-pressed', String(k === row)));
    const { body, mode, amplitude } = this.rows[row];
    this.onChoice(body, mode, amplitude);
    this.stage.go(this.player.time);
  }

  static range(scene: SceneData): [number, number] {
    return [0, PART_OF_SIZE * Math.max(...scene.bodies.map((body) => body.size || 0), 1e-9)];
  }

  private shape(time: number): void {
    const { amplitudes } = this.stage.motion;
    amplitudes.fill(0);
    const chosen = this.rows[this.chosen];
    if (!chosen) return;
    const body = this.stage.scene.bodies[chosen.body];
    amplitudes[body.firstMode + chosen.mode] = chosen.amplitude * Math.sin((2 * Math.PI * time) / SWING);
  }
}
