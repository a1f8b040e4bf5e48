// Play, step, scrub, speed, loop.

import { formatNumber } from '../data/format';
import { SPEEDS, type Player } from '../motion/player';
import { button, h, setIcon } from './dom';

export function speedText(speed: number): string {
  return `${formatNumber(speed, 3)}×`;
}

export class PlayerBar {
  readonly element: HTMLElement;
  readonly scrubber: HTMLInputElement;
  private readonly player: Player;
  private readonly playButton: HTMLButtonElement;
  private readonly loopButton: HTMLButtonElement;
  private readonly now = h('output', { class: 'now' });
  private readonly rate = h('span', { class: 'rate', title: 'Pictures per second' });
  private readonly speed: HTMLSelectElement;
  private readonly decimals: number;

  constructor(player: Player, unit: string) {
    this.player = player;
    const span = player.end - player.start;
    this.decimals = span > 0 ? Math.min(6, Math.max(1, 3 - Math.floor(Math.log10(span)))) : 3;
    this.playButton = button('play', 'Play (space)', () => player.toggle(), { class: 'icon-button play' });
    this.loopButton = button('loop', 'Begin again at the end (L)', () => player.setLoop(!player.loop), { 'aria-pressed': String(player.loop) });
    this.scrubber = h('input', { type: 'range', class: 'scrubber', min: 0, max: 1, step: 'any', value: 0, 'aria-label': 'Time' });
    this.scrubber.addEventListener('input', () => {
      player.pause();
      player.set(player.start + Number(this.scrubber.value) * span);
    });
    this.speed = h('select', { class: 'field', 'aria-label': 'Speed', title: 'Speed ([ and ])' }, ...SPEEDS.map((s) => h('option', { value: s }, speedText(s))));
    this.speed.addEventListener('change', () => player.setSpeed(Number(this.speed.value)));
    const end = h('span', { class: 'end' }, `/ ${player.end.toFixed(this.decimals)} ${unit}`);
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
    this.now.textContent = this.player.time.toFixed(this.decimals);
    this.scrubber.setAttribute('aria-valuetext', `${this.now.textContent} s`);
  }

  private showState(): void {
    setIcon(this.playButton, this.player.playing ? 'pause' : 'play');
    this.playButton.title = this.player.playing ? 'Pause (space)' : 'Play (space)';
    this.playButton.setAttribute('aria-label', this.playButton.title);
    this.loopButton.setAttribute('aria-pressed', String(this.player.loop));
    const known = SPEEDS.includes(this.player.speed);
    if (known) this.speed.value = String(this.player.speed);
    if (!this.player.playing) this.rate.textContent = '';
  }

  showRate(rate: number): void {
    this.rate.textContent = rate > 0 && this.player.playing ? `${rate.toFixed(0)} fps` : '';
  }
}
