// What colours mean.

import { distinctTexts } from '../data/format';
import { lookOf, mapCss, OVER_COLOUR, type MapName } from '../scene/palette';
import { h } from './dom';

export interface LegendContent {
  /** With its unit. */
  title: string;
  /** Ends of the scale in that unit. */
  scale: [number, number];
  map: MapName;
  /** Values go below or above the scale. */
  beyond: [boolean, boolean];
  /** What the scale is of. */
  scope: string;
  note: string;
}

/** More numbers do not fit below the bar. */
const MOST_TICKS = 6;

/** Parts of the scale that have numbers: ends and middle, or edges of bands. */
export function tickParts(map: MapName): number[] {
  const { bands } = lookOf(map);
  if (bands < 2) return [0, 0.5, 1];
  const every = [1, 2, 3, 4, 5, 6].find((n) => bands % n === 0 && bands / n < MOST_TICKS) ?? bands;
  return Array.from({ length: bands / every + 1 }, (_, k) => (k * every) / bands);
}

export class Legend {
  readonly element: HTMLElement;
  private readonly title = h('div', { class: 'legend-title' });
  private readonly bar = h('div', { class: 'legend-bar' });
  private readonly over = h('div', { class: 'legend-over' });
  private readonly ticks = h('div', { class: 'legend-ticks' });
  private readonly scope = h('div', { class: 'legend-scope' });
  private readonly note = h('div', { class: 'legend-note' });
  text = '';
  scopeText = '';
  ticksShown: { part: number; text: string }[] = [];
  map: MapName = 'viridis';

  constructor() {
    this.element = h('div', { class: 'legend', 'aria-live': 'off' }, this.title, h('div', { class: 'legend-row' }, this.bar, this.over), this.ticks, this.scope, this.note);
    this.over.style.background = OVER_COLOUR;
  }

  /** Null: colours are those of bodies. */
  show(content: LegendContent | null): void {
    this.element.hidden = content === null;
    if (!content) return;
    const { scale, map, beyond } = content;
    const [low, high] = scale;
    this.text = content.title;
    this.map = map;
    this.scopeText = content.scope ? `Scale: ${content.scope}` : '';
    this.title.textContent = content.title;
    for (const [element, text] of [[this.scope, this.scopeText], [this.note, content.note]] as const) {
      element.textContent = text;
      element.hidden = text === '';
    }
    this.bar.style.background = mapCss(map);
    const { over } = lookOf(map);
    this.over.hidden = !over;
    this.over.title = 'Above the limit';
    const parts = tickParts(map);
    const texts = distinctTexts(parts.map((part) => low + part * (high - low)));
    // A colour of its own says what is above.
    if (beyond[0]) texts[0] = `≤ ${texts[0]}`;
    if (beyond[1] && !over) texts[texts.length - 1] = `≥ ${texts[texts.length - 1]}`;
    this.ticksShown = parts.map((part, k) => ({ part, text: texts[k] }));
    this.ticks.replaceChildren(...this.ticksShown.map(({ part, text }) => h('span', { style: `left: ${(100 * part).toFixed(2)}%`, class: part === 0 ? 'first' : part === 1 ? 'last' : null }, text)));
    this.ticks.classList.toggle('beside-over', over);
  }
}
