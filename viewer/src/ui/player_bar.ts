// Play, step, scrub, speed, loop.

import { formatNumber } from '../data/format';
import { SPEEDS, type Player } from '../motion/player';
import { button, h, setIcon } from './dom';
import { SWING } from './modes';

export function speedText(speed: number): string {
  return `${formatNumber(speed, 3)}×`;
}

/** What swings on the page at a rate of its own. */
interface Swinging {
  /** Of the real vibration [Hz]; null: it has none. */
  readonly frequency: number | null;
}

/** A speed that is the chosen one but for the jitter of a clock. */
const JITTER = 0.03;

/** What is played, measured: pictures a second and seconds of the record a second, or the part of the real rate of a vibration. */
export function rateText(pictures: number, measured: number, chosen: number, frequency?: number | null): string {
  const speed = Math.abs(measured - chosen) <= JITTER * chosen ? chosen : measured;
  const shown = `${pictures.toFixed(0)} fps`;
  if (frequency === undefined) return `${shown}, ${formatNumber(speed, 2)}×`;
  return frequency === null ? shown : `${shown}, ${formatNumber(speed / SWING / frequency, 2)}× real`;
}

export class PlayerBar {
  readonly element: HTMLElement;
  readonly scrubber: HTMLInputElement;
  private readonly player: Player;
  private readonly playButton: HTMLButtonElement;
  private readonly loopButton: HTMLButtonElement;
  private readonly now = h('output', { class: 'now' });
  private readonly rate = h('span', { class: 'rate', title: 'Pictures per second, and the speed that is played' });
  private readonly speed: HTMLSelectElement;
  private readonly decimals: number;
  private readonly swinging: Swinging | null;
  /** Of the clock: seconds, or degrees of a swing, whose seconds on the page mean nothing. */
  private readonly unit: string;
  private readonly factor: number;

  constructor(player: Player, swinging: Swinging | null) {
    this.player = player;
    this.swinging = swinging;
    this.unit = swinging ? '°' : 's';
    this.factor = swinging ? 360 / SWING : 1;
    const span = player.end - player.start;
    this.decimals = swinging ? 0 : span > 0 ? Math.min(6, Math.max(1, 3 - Math.floor(Math.log10(span)))) : 3;
    this.playButton = button('play', 'Play (space)', () => player.toggle(), { class: 'icon-button play' });
    this.loopButton = button('loop', 'Begin again at the end (L)', () => player.setLoop(!player.loop), { 'aria-pressed': String(player.loop) });
    this.scrubber = h('input', { type: 'range', class: 'scrubber', min: 0, max: 1, step: 'any', value: 0, 'aria-label': 'Time' });
    this.scrubber.addEventListener('input', () => {
      player.pause();
      player.set(player.start + Number(this.scrubber.value) * span);
    });
    this.speed = h('select', { class: 'field', 'aria-label': 'Speed', title: 'Speed ([ and ])' }, ...SPEEDS.map((s) => h('option', { value: s }, speedText(s))));
    this.speed.addEventListener('change', () => player.setSpeed(Number(this.speed.value)));
    const end = h('span', { class: 'end' }, `/ ${(player.end * this.factor).toFixed(this.decimals)} ${this.unit}`);
    this.element = h(
      'div',
      { class: 'player no-print', role: 'group', 'aria-label': 'Player' },
      button('first', 'To the start (Home)', () => {
        player.pause();
        player.set(player.start);
      }),
      button('back', 'Step back (←)', () => player.step(-1)),
      this.playButton,
      button('forward', 'Step forward (→)', () => player.step(1)),
      this.scrubber,
      h('span', { class: 'clock' }, this.now, end),
      this.speed,
      this.loopButton,
      this.rate,
    );
    player.onTime(() => this.showTime());
    player.onState(() => this.showState());
    this.showTime();
    this.showState();
  }

  private showTime(): void {
    const span = this.player.end - this.player.start;
    const part = span > 0 ? (this.player.time - this.player.start) / span : 0;
    this.scrubber.value = String(part);
    this.scrubber.style.setProperty('--part', `${(100 * part).toFixed(2)}%`);
    this.now.textContent = (this.player.time * this.factor).toFixed(this.decimals);
    this.scrubber.setAttribute('aria-valuetext', `${this.now.textContent} ${this.unit}`);
  }

  private showState(): void {
    setIcon(this.playButton, this.player.playing ? 'pause' : 'play');
    this.playButton.title = this.player.playing ? 'Pause (space)' : 'Play (space)';
    this.playButton.setAttribute('aria-label', this.playButton.title);
    this.loopButton.setAttribute('aria-pressed', String(this.player.loop));
    this.speed.value = String(this.player.speed);
    if (!this.player.playing) this.rate.textContent = '';
  }

  /** Pictures, and seconds of the record, in a second of the clock. */
  showRate(rate: number, measured: number): void {
    const { playing, speed } = this.player;
    this.rate.textContent = rate > 0 && playing ? rateText(rate, measured, speed, this.swinging?.frequency ?? (this.swinging ? null : undefined)) : '';
    this.rate.classList.toggle('slow', measured < (1 - JITTER) * speed);
  }
}
