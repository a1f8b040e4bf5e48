// What colours mean.

import { formatNumber, lengthUnit } from '../data/format';
import { mapCss, type MapName } from '../scene/palette';
import type { ColourChoice } from '../scene/stage';
import { h } from './dom';

export class Legend {
  readonly element: HTMLElement;
  private readonly title = h('div', { class: 'legend-title' });
  private readonly bar = h('div', { class: 'legend-bar' });
  private readonly ticks = h('div', { class: 'legend-ticks' });
  private readonly note = h('div', { class: 'legend-note' });
  text = '';
  values: string[] = [];
  map: MapName = 'viridis';

  constructor() {
    this.element = h('div', { class: 'legend', 'aria-live': 'off' }, this.title, this.bar, this.ticks, this.note);
  }

  show(choice: ColourChoice, unit: string, relative: boolean, note = ''): void {
    this.element.hidden = choice.field === undefined;
    if (choice.field === undefined) return;
    const [low, high] = choice.range;
    let factor = 1;
    let name = relative ? '' : unit;
    if (choice.field === null && !relative) {
      const length = lengthUnit(high);
      factor = length.factor;
      name = length.name;
    }
    const signed = relative && low < 0;
    const what = choice.field !== null && relative ? `${choice.field} of the mode, relative` : choice.field === null ? (relative ? 'Displacement of the mode, relative' : 'Elastic displacement') : choice.field;
    this.text = name ? `${what} [${name}]` : what;
    this.title.textContent = this.text;
    this.note.textContent = note;
    this.note.hidden = note === '';
    this.bar.style.background = mapCss(choice.map);
    const values = relative ? (signed ? [-1, 0, 1] : [0, 0.5, 1]) : [low, (low + high) / 2, high].map((v) => v * factor);
    this.map = choice.map;
    this.values = values.map((v) => formatNumber(v, 3));
    this.ticks.replaceChildren(...this.values.map((text) => h('span', {}, text)));
  }
}
