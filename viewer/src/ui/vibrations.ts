// Vibrations of the model: a list with frequency, damping and who moves; the chosen one swings in the view.

import { formatNumber } from '../data/format';
import type { VibrationData } from '../data/vibrations';
import type { Player } from '../motion/player';
import { drawingOf, LARGEST_TURN, PART_OF_MODEL, type Drawing } from '../motion/vibration';
import type { Stage } from '../scene/stage';
import { h } from './dom';
import { SWING } from './modes';

const SWINGS = ['vibration', 'unstable'];

function percent(part: number): string {
  return `${formatNumber(100 * part, part < 0.995 ? 2 : 3)} %`;
}

/** Of critical damping; less than the eigenvalues are good for is none. */
function dampingText({ damping, kind }: VibrationData): string {
  return `damping ${percent(Math.abs(damping) < 5e-7 ? 0 : damping)}${kind === 'unstable' ? ', unstable' : ''}`;
}

function sharesText(shares: [string, number][], most: number): string {
  return shares
    .filter(([, part], k) => k < most && (part >= 0.05 || k === 0))
    .map(([name, part]) => `${name} ${percent(part)}`)
    .join(', ');
}

function nameOf(vibration: VibrationData): string {
  return vibration.number === null ? 'Rigid motion' : `Mode ${vibration.number}`;
}

function frequencyText({ kind, frequency }: VibrationData): string {
  return SWINGS.includes(kind) ? `${formatNumber(frequency, 4)} Hz` : kind === 'rigid' ? 'rigid motion' : kind;
}

export class VibrationList {
  readonly element = h('div', { class: 'modes' });
  chosen = 0;
  private readonly stage: Stage;
  private readonly player: Player;
  private readonly rows: HTMLElement[] = [];
  private readonly drawings: (Drawing | undefined)[] = [];
  private readonly details = h('div', { class: 'mode-details' });
  private readonly told: (caption: string) => void;

  constructor(stage: Stage, player: Player, told: (caption: string) => void) {
    this.stage = stage;
    this.player = player;
    this.told = told;
    const list = h('ol', { class: 'mode-list', 'aria-label': 'Vibrations' });
    stage.scene.vibrations.forEach((vibration, k) => {
      const { number, kind, moves } = vibration;
      const swings = SWINGS.includes(kind);
      const element = h(
        'button',
        { type: 'button', class: `mode vibration${kind === 'unstable' || kind === 'growth' ? ' grows' : ''}`, onclick: () => this.choose(k) },
        h('span', { class: 'mode-number' }, number === null ? '–' : String(number)),
        h('span', { class: 'mode-what' }, h('span', { class: 'mode-line' }, h('span', {}, frequencyText(vibration)), swings ? h('span', { class: 'mode-damping' }, dampingText(vibration)) : null), h('span', { class: 'mode-who' }, sharesText(moves, 3))),
      );
      this.rows.push(element);
      list.append(h('li', {}, element));
    });
    this.element.append(
      this.details,
      list,
      h(
        'p',
        { class: 'hint' },
        `All are animated at the same slow rate without decay: the place that moves most by ${percent(PART_OF_MODEL)} of the size of the model, or bodies turn by up to ${formatNumber((LARGEST_TURN * 180) / Math.PI, 2)}°, times the amplitude. Modes that do not oscillate are animated as if they did. Up and down arrows change the mode.`,
      ),
    );
    stage.shape = (time) => this.shape(time);
    this.choose(Math.max(0, stage.scene.vibrations.findIndex((vibration) => vibration.number !== null)));
  }

  get count(): number {
    return this.rows.length;
  }

  /** Of what swings [Hz]; null: it does not. */
  get frequency(): number | null {
    const { kind, frequency } = this.stage.scene.vibrations[this.chosen];
    return SWINGS.includes(kind) && frequency > 0 ? frequency : null;
  }

  /** What is drawn, in a line. */
  get caption(): string {
    const vibration = this.stage.scene.vibrations[this.chosen];
    const { kind, frequency, undamped } = vibration;
    const name = nameOf(vibration);
    if (kind === 'rigid') return `${name}: nothing holds it`;
    if (SWINGS.includes(kind)) return `${name}: ${formatNumber(frequency, 4)} Hz, ${dampingText(vibration)}`;
    const time = undamped > 0 ? `, by e in ${formatNumber(1 / (2 * Math.PI * undamped), 3)} s` : '';
    return `${name}: ${kind === 'growth' ? 'grows' : 'decays'} without swinging${time}`;
  }

  step(count: number): void {
    const next = Math.min(this.rows.length - 1, Math.max(0, this.chosen + count));
    if (next !== this.chosen) this.choose(next);
    const element = this.rows[next];
    const list = element.closest('.mode-list');
    if (list) list.scrollTop = element.offsetTop - list.clientHeight / 2;
  }

  choose(row: number): void {
    this.chosen = row;
    this.rows.forEach((element, k) => element.setAttribute('aria-pressed', String(k === row)));
    const { moves, held } = this.stage.scene.vibrations[row];
    const line = (what: string, text: string): HTMLElement => h('p', {}, h('span', { class: 'what' }, what), text);
    this.details.replaceChildren(h('h3', {}, this.caption));
    if (moves.length > 0) this.details.append(line('Moves ', sharesText(moves, 5)));
    if (held.length > 0) this.details.append(line('Held by ', sharesText(held, 5)));
    this.told(this.caption);
    this.stage.go(this.player.time);
  }

  private shape(time: number): void {
    const vibration = this.stage.scene.vibrations[this.chosen];
    const drawing = (this.drawings[this.chosen] ??= drawingOf(this.stage.scene, this.stage.rest!, vibration, this.stage.size));
    this.stage.swing(vibration, drawing, (2 * Math.PI * time) / SWING);
  }
}
