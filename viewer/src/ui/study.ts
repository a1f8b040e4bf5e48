// A parameter study: which run is best and worst by a figure, what each variable does to it, curves of the runs, all rows.

import { formatNumber, plural, withUnit } from '../data/format';
import { isLogarithmic, mainEffect, rankedRuns, type StudyData, type Variable } from '../data/study';
import { chart, type ChartPoint } from './chart';
import { h } from './dom';

const COLOURS = { best: 'var(--c0)', worst: 'var(--c1)', chosen: 'var(--c2)', other: 'var(--muted)' };
const MOST_ROWS = 500;

function option(value: string | number, text: string, selected: boolean): HTMLOptionElement {
  return h('option', { value, selected }, text);
}

export class StudySection {
  readonly element: HTMLElement;
  private readonly study: StudyData;
  private readonly ranked = h('div', { class: 'study-cards' });
  private readonly effects = h('div', { class: 'plots' });
  private readonly scatter = h('div', { class: 'plots' });
  private readonly overlay = h('div', { class: 'plots' });
  private readonly table = h('div', { class: 'scroll' });
  private measure = 0;
  private largest = false;
  private channel = 0;
  private chosen = -1;
  private order: number[] = [];
  /** Column that the table is sorted by: -1 the run, then variables, then the figure. */
  private sorted = NaN;
  private descending = false;
  private across: number;

  constructor(study: StudyData) {
    this.study = study;
    this.measure = study.ranking?.measure ?? Math.max(0, study.measures.findIndex(({ name }) => / (final|max|rms|min)$/.test(name)));
    this.largest = study.ranking?.largest ?? false;
    this.across = 0;
    this.channel = this.channelOf(this.measure);
    const figure = h('select', { class: 'field', 'aria-label': 'Figure' }, ...study.measures.map(({ name }, k) => option(k, name, k === this.measure)));
    figure.addEventListener('change', () => {
      this.measure = Number(figure.value);
      this.sorted = NaN;
      this.show();
    });
    const better = h('select', { class: 'field', 'aria-label': 'Which run is the best' }, option(0, 'the smallest is best', !this.largest), option(1, 'the largest is best', this.largest));
    better.addEventListener('change', () => {
      this.largest = better.value === '1';
      this.sorted = NaN;
      this.show();
    });
    this.element = h(
      'section',
      { id: 'study', class: 'card study', 'aria-label': 'Study' },
      h('div', { class: 'section-head' }, h('h2', {}, 'Study'), h('div', { class: 'tools' }, h('span', { class: 'hint-inline' }, 'Runs by'), figure, better)),
      this.ranked,
      h('h3', {}, 'Main effects'),
      h('p', { class: 'hint' }, 'Means over the runs that share a value, all with the same axis; a bar from the smallest to the largest of them.'),
      this.effects,
      this.scatterHead(),
      this.scatter,
      ...this.curvesHead(),
      h('h3', { class: 'study-head' }, 'Runs'),
      this.table,
    );
    this.show();
  }

  /** The output that a figure is of. */
  private channelOf(measure: number): number {
    const name = this.study.measures[measure]?.name ?? '';
    return Math.max(0, this.study.channels.findIndex((channel) => name.startsWith(`${channel.name} `)));
  }

  private scatterHead(): HTMLElement {
    const select = h('select', { class: 'field', 'aria-label': 'Variable of the scatter' }, ...this.study.variables.map(({ name }, k) => option(k, name, k === this.across)));
    select.addEventListener('change', () => {
      this.across = Number(select.value);
      this.showScatter();
    });
    return h('div', { class: 'section-head study-head' }, h('h3', {}, 'All runs'), h('div', { class: 'tools' }, h('span', { class: 'hint-inline' }, 'over'), select));
  }

  private curvesHead(): Node[] {
    const { channels, runsWithoutCurves } = this.study;
    if (channels.length === 0) return [h('h3', { class: 'study-head' }, 'Curves'), h('p', { class: 'hint' }, 'The results of the runs were not kept.')];
    const select = h('select', { class: 'field', 'aria-label': 'Output of the curves' }, ...channels.map(({ name }, k) => option(k, name, k === this.channel)));
    select.addEventListener('change', () => {
      this.channel = Number(select.value);
      this.showCurves();
    });
    const left = runsWithoutCurves > 0 ? h('p', { class: 'hint' }, `${plural(runsWithoutCurves, 'run')} between best and worst ${runsWithoutCurves === 1 ? 'is' : 'are'} left out of the curves.`) : null;
    return [h('div', { class: 'section-head study-head' }, h('h3', {}, 'Curves of the runs'), h('div', { class: 'tools' }, h('span', { class: 'hint-inline' }, 'of'), select)), this.overlay, ...(left ? [left] : [])];
  }

  private get values(): Float64Array {
    return this.study.measures[this.measure]?.values ?? new Float64Array(this.study.runs).fill(NaN);
  }

  private get best(): number {
    return this.order[0] ?? -1;
  }

  private get worst(): number {
    return this.order.length > 1 ? this.order[this.order.length - 1] : -1;
  }

  private settings(run: number): string {
    return this.study.variables.map(({ name, values }) => `${name} = ${values[run]}`).join(', ');
  }

  private colourOf(run: number): string {
    return run === this.best ? COLOURS.best : run === this.worst ? COLOURS.worst : run === this.chosen ? COLOURS.chosen : COLOURS.other;
  }

  private marked(run: number): boolean {
    return run === this.best || run === this.worst || run === this.chosen;
  }

  choose(run: number): void {
    this.chosen = run === this.chosen ? -1 : run;
    this.showScatter();
    this.showCurves();
    this.showTable();
    this.showRanked();
  }

  private show(): void {
    this.order = rankedRuns(this.study, this.measure, this.largest);
    this.showRanked();
    this.showEffects();
    this.showScatter();
    this.showCurves();
    this.showTable();
  }

  private card(what: string, run: number, colour: string): HTMLElement {
    const { pages, measures } = this.study;
    const page = pages.find((candidate) => candidate.run === run);
    const value = this.values[run];
    const has = this.study.channels.some(({ curves }) => curves.some((curve) => curve.run === run));
    return h(
      'div',
      { class: 'study-card' },
      h('h3', {}, h('span', { class: 'study-mark', style: `background: ${colour}` }), `${what}: run ${run + 1}`),
      h('p', { class: 'study-value' }, withUnit(value, measures[this.measure]?.unit ?? '', 5)),
      h('p', {}, this.settings(run)),
      h('p', { class: 'study-links no-print' }, page ? h('a', { href: page.address }, 'Open its page') : null, has ? h('button', { type: 'button', class: 'button', onclick: () => this.overlay.scrollIntoView({ block: 'center' }) }, 'Its curves') : null),
    );
  }

  private showRanked(): void {
    const cards: [string, number, string][] = [['Best', this.best, COLOURS.best], ['Worst', this.worst, COLOURS.worst], ['Chosen', this.chosen, COLOURS.chosen]];
    const shown = cards.filter(([, run]) => run >= 0);
    this.ranked.replaceChildren(...(this.order.length > 0 ? shown.map(([what, run, colour]) => this.card(what, run, colour)) : [h('p', {}, 'No completed run has this figure.')]));
  }

  private axisOf(variable: Variable): { label: string; words: string[] | null; log: boolean } {
    return { label: variable.name, words: variable.numbers ? null : variable.levels, log: isLogarithmic(variable) };
  }

  private showEffects(): void {
    const { variables, measures } = this.study;
    const effects = variables.map((variable) => mainEffect(variable, this.values, this.order));
    const ends = effects.flat().flatMap(({ least, most }) => [least, most]);
    const [low, high] = [Math.min(...ends), Math.max(...ends)];
    this.effects.replaceChildren(
      ...variables.flatMap((variable, k) => {
        const found = effects[k];
        if (found.length === 0) return [];
        const title = ({ level, mean, runs }: (typeof found)[number]): string => `${variable.name} ${variable.numbers ? 'about ' : ''}${level}: mean ${formatNumber(mean, 5)} of ${plural(runs, 'run')}`;
        return [
          chart({
            title: `${measures[this.measure].name} over ${variable.name}`,
            unit: measures[this.measure].unit,
            x: this.axisOf(variable),
            lines: [
              // Holds the axis of all effects, without a mark.
              { x: [found[0].at, found[0].at], y: [low, high], colour: 'none', width: 0 },
              ...found.map(({ at, least, most }) => ({ x: [at, at], y: [least, most], colour: 'var(--grid-strong)', width: 5 })),
              ...(variable.numbers ? [{ x: found.map(({ at }) => at), y: found.map(({ mean }) => mean), colour: COLOURS.best, width: 1.8 }] : []),
            ],
            points: found.map((effect) => ({ x: effect.at, y: effect.mean, colour: COLOURS.best, title: title(effect), strong: false })),
            description: `Mean of ${measures[this.measure].name} by ${variable.name}: ${found.map(({ level, mean }) => `${level}: ${formatNumber(mean, 4)}`).join('; ')}`,
          }),
        ];
      }),
    );
  }

  private showScatter(): void {
    const variable = this.study.variables[this.across];
    if (!variable) return;
    const { values } = this;
    const points = this.order.map((run): ChartPoint => ({
      x: variable.numbers ? variable.numbers[run] : variable.levels.indexOf(variable.values[run]),
      y: values[run],
      colour: this.colourOf(run),
      title: `run ${run + 1}: ${formatNumber(values[run], 5)} (${this.settings(run)})`,
      strong: this.marked(run),
      choose: () => this.choose(run),
    }));
    const { name, unit } = this.study.measures[this.measure] ?? { name: '', unit: '' };
    this.scatter.replaceChildren(chart({ title: `${name} of each run`, unit, x: this.axisOf(variable), lines: [], points, description: `${name} of ${plural(points.length, 'run')} over ${variable.name}` }));
  }

  private showCurves(): void {
    const channel = this.study.channels[this.channel];
    if (!channel) return;
    const curves = [...channel.curves].sort((a, b) => Number(this.marked(a.run)) - Number(this.marked(b.run)));
    const strong = curves.filter(({ run }) => this.marked(run));
    this.overlay.replaceChildren(
      h(
        'div',
        { class: 'study-overlay' },
        chart({
          title: channel.name,
          wide: true,
          unit: channel.unit,
          x: { label: 'time [s]', words: null },
          lines: curves.map(({ run, time, values }) => ({ x: time, y: values, colour: this.marked(run) ? this.colourOf(run) : 'var(--grid-strong)', width: this.marked(run) ? 2 : 0.8 })),
          points: [],
          description: `${channel.name} over time of ${plural(curves.length, 'run')}`,
        }),
        h('p', { class: 'chips' }, ...strong.map(({ run }) => h('span', { class: 'chip' }, h('span', { class: 'swatch', style: `background: ${this.colourOf(run)}` }), `run ${run + 1}${run === this.best ? ', best' : run === this.worst ? ', worst' : ''}`))),
      ),
    );
  }

  private rows(): number[] {
    const { variables, runs } = this.study;
    const rank = new Map(this.order.map((run, k) => [run, k]));
    const all = Array.from({ length: runs }, (_, k) => k);
    const key = (run: number): number | string => {
      if (Number.isNaN(this.sorted)) return rank.get(run) ?? runs + run;
      if (this.sorted === -1) return run;
      const variable = variables[this.sorted];
      return variable ? (variable.numbers ? variable.numbers[run] : variable.values[run]) : (this.values[run] ?? NaN);
    };
    const compare = (a: number, b: number): number => {
      const [x, y] = [key(a), key(b)];
      // What has no number is last.
      if (typeof x === 'number' && typeof y === 'number' && Number.isNaN(x) !== Number.isNaN(y)) return Number.isNaN(x) ? 1 : -1;
      const way = typeof x === 'number' && typeof y === 'number' ? x - y : String(x).localeCompare(String(y));
      return (this.descending ? -way : way) || a - b;
    };
    return all.sort(compare);
  }

  private showTable(): void {
    const { variables, measures, states, messages } = this.study;
    const figure = measures[this.measure];
    const heads: [string, number][] = [['run', -1], ...variables.map(({ name }, k): [string, number] => [name, k]), [figure ? (figure.unit ? `${figure.name} [${figure.unit}]` : figure.name) : 'figure', variables.length]];
    const head = heads.map(([text, column]) => {
      const now = this.sorted === column || (Number.isNaN(this.sorted) && column === variables.length);
      const button = h('button', { type: 'button', class: 'sort', onclick: () => this.sort(column) }, text);
      return h('th', { scope: 'col', class: column < 0 || column === variables.length || variables[column].numbers ? 'number' : null, 'aria-sort': now ? (this.descending ? 'descending' : 'ascending') : null }, button);
    });
    const rows = this.rows();
    // With the digits that tell runs apart.
    const known = this.order.map((run) => this.values[run]);
    const texts = new Map(this.order.map((run, k) => [run, formatNumber(known[k], 7)]));
    const body = rows.slice(0, MOST_ROWS).map((run) => {
      const done = states[run] === 'completed';
      const number = h('button', { type: 'button', class: 'sort', 'aria-pressed': String(run === this.chosen), onclick: () => this.choose(run) }, String(run + 1));
      return h(
        'tr',
        { class: !done ? 'beyond' : run === this.chosen ? 'chosen' : null },
        h('td', { class: 'number' }, this.marked(run) ? h('span', { class: 'study-mark', style: `background: ${this.colourOf(run)}` }) : null, number),
        ...variables.map((variable) => h('td', { class: variable.numbers ? 'number' : null }, variable.values[run])),
        done ? h('td', { class: 'number' }, texts.get(run) ?? '–') : h('td', {}, `${states[run]}: ${messages[run]}`),
      );
    });
    this.table.replaceChildren(h('table', { class: 'study-table' }, h('thead', {}, h('tr', {}, ...head)), h('tbody', {}, ...body)), rows.length > MOST_ROWS ? h('p', { class: 'hint' }, `The first ${MOST_ROWS} of ${rows.length} runs; sweep.csv has all.`) : '');
  }

  private sort(column: number): void {
    this.descending = this.sorted === column ? !this.descending : false;
    this.sorted = column;
    this.showTable();
  }
}
