// The section of curves: groups by body and kind, a filter, a second run laid over them.

import { groupChannels, type Channel } from '../data/channels';
import { parseCsv } from '../data/csv';
import { formatNumber, plural, withUnit } from '../data/format';
import { difference } from '../data/series';
import { button, h, icon } from './dom';
import type { Hub } from './hub';
import { TimePlot } from './plot';

const LARGEST_FILE = 400e6;

export function stillText(channel: Channel): string {
  const range = channel.range;
  if (!range) return 'no values';
  if (channel.still === 'constant') return range.min === 0 && range.max === 0 ? 'zero' : `constant ${withUnit((range.min + range.max) / 2, channel.unit, 6)}`;
  const middle = (range.min + range.max) / 2;
  const half = (range.max - range.min) / 2;
  if (Math.abs(middle) < 3 * half) return `rounding noise, at most ${withUnit(Math.max(Math.abs(range.min), Math.abs(range.max)), channel.unit, 2)}`;
  return `${withUnit(middle, channel.unit, 6)}, but for rounding noise of ${withUnit(half, channel.unit, 2)}`;
}

export function stillList(channels: Channel[]): HTMLElement | null {
  if (channels.length === 0) return null;
  return h('ul', { class: 'still' }, ...channels.map((channel) => h('li', { title: channel.name }, h('span', {}, channel.label), h('span', { class: 'still-value' }, stillText(channel)))));
}

function listed(names: string[]): string {
  const shown = names.slice(0, 6).join(', ');
  return names.length > 6 ? `${shown} and ${names.length - 6} more` : shown;
}

function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1).replace(/_/g, ' ');
}

export class Curves {
  readonly element: HTMLElement;
  private readonly hub: Hub;
  private readonly channels: Channel[];
  private readonly compares: boolean;
  private readonly message = h('p', { class: 'message', role: 'status', hidden: true });
  private readonly clear: HTMLButtonElement;
  private readonly reset: HTMLButtonElement;
  private readonly differences = h('div', {});
  private readonly modeSwitch: HTMLElement;
  private readonly groups: { element: HTMLElement; plots: { element: HTMLElement; words: string }[]; words: string }[] = [];

  constructor(channels: Channel[], hub: Hub, names: [string, string] | null) {
    this.compares = names !== null;
    this.hub = hub;
    this.channels = channels;
    this.clear = button('close', 'Take the second run away', () => this.setOverlay(null, ''), { hidden: true });
    this.reset = h('button', { type: 'button', class: 'button', disabled: true, onclick: () => hub.setRange(null) }, 'Whole run');
    hub.onRange(() => (this.reset.disabled = hub.range === null));
    const file = h('input', { type: 'file', accept: '.csv,text/csv', hidden: true, 'aria-label': 'results.csv of a second run' });
    file.addEventListener('change', () => {
      if (file.files?.[0]) void this.load(file.files[0]);
      file.value = '';
    });
    const filter = h('input', { type: 'search', class: 'field', placeholder: 'Filter channels', 'aria-label': 'Filter channels' });
    filter.addEventListener('input', () => this.filter(filter.value));
    const both = h('button', { type: 'button', 'aria-pressed': 'true' }, 'Both');
    const only = h('button', { type: 'button', 'aria-pressed': 'false' }, 'Difference');
    const choose = (on: boolean): void => {
      both.setAttribute('aria-pressed', String(!on));
      only.setAttribute('aria-pressed', String(on));
      hub.setDifference(on);
    };
    both.addEventListener('click', () => choose(false));
    only.addEventListener('click', () => choose(true));
    this.modeSwitch = h('div', { class: 'segmented', role: 'group', 'aria-label': 'What is drawn of two runs', hidden: !channels.some((c) => c.other) }, both, only);
    const overlay = h('button', { type: 'button', class: 'button', onclick: () => file.click() }, icon('overlay'), 'Lay results.csv over');
    this.element = h(
      'section',
      { id: 'curves', class: 'card' },
      h('div', { class: 'section-head' }, h('h2', {}, 'Curves'), h('div', { class: 'tools no-print' }, filter, this.modeSwitch, this.reset, overlay, this.clear, file)),
      this.message,
      names ? h('p', { class: 'key' }, h('span', { class: 'line solid' }), names[0], h('span', { class: 'line dashed' }), names[1]) : null,
      this.differences,
    );
    for (const group of groupChannels(channels)) this.addGroup(group);
    this.element.append(this.grid);
    this.element.append(h('p', { class: 'hint no-print' }, 'Drag over a curve to zoom all, double-click for the whole run, shift and wheel to zoom at the pointer, click to set the time. Drop a results.csv of another run anywhere on the page.'));
    if (names) this.listDifferences();
    this.listenToDrops();
  }

  private readonly grid = h('div', { class: 'groups' });

  private addGroup(group: ReturnType<typeof groupChannels>[number]): void {
    const grid = h('div', { class: 'plots' });
    const plots = group.plots.map((spec) => {
      const plot = new TimePlot({ title: spec.channels.some((c) => c.name === spec.kind) ? spec.kind : capital(spec.kind), unit: spec.unit, channels: spec.channels }, this.hub);
      grid.append(plot.element);
      return { element: plot.element, words: spec.channels.map((c) => `${c.name} ${c.label} ${c.kind}`).join(' ').toLowerCase() };
    });
    const still = stillList(group.still);
    const element = h('div', { class: plots.length + (still ? 1 : 0) > 1 ? 'body-group many' : 'body-group' }, h('h3', {}, group.body ?? (this.compares ? 'Channels' : 'Model')), plots.length > 0 ? grid : null, still);
    this.groups.push({ element, plots, words: `${group.body ?? 'model'} ${group.still.map((c) => `${c.name} ${c.label}`).join(' ')}`.toLowerCase() });
    this.grid.append(element);
  }

  private filter(text: string): void {
    const words = text.toLowerCase().split(/\s+/).filter(Boolean);
    for (const group of this.groups) {
      let any = false;
      for (const plot of group.plots) {
        const fits = words.every((word) => plot.words.includes(word) || group.words.includes(word));
        plot.element.hidden = !fits;
        any ||= fits;
      }
      group.element.hidden = !any && !words.every((word) => group.words.includes(word));
    }
  }

  private listDifferences(): void {
    const rows = this.channels
      .filter((channel) => channel.other)
      .map((channel) => {
        const own = channel.stated?.max == null ? difference(channel.time, channel.values, channel.other!.time, channel.other!.values) : null;
        const max = channel.stated?.max ?? own?.max ?? NaN;
        const rms = channel.stated?.rms ?? own?.rms ?? NaN;
        const span = channel.range ? channel.range.max - channel.range.min : 0;
        return { channel, max, rms, part: span > 0 ? max / span : max > 0 ? Infinity : 0 };
      })
      // Those of a comparison come in its order: rounding beside larger values is last.
      .sort((a, b) => (a.channel.stated && b.channel.stated ? 0 : b.part - a.part));
    if (rows.length === 0) return;
    const head = ['channel', 'unit', 'largest difference', 'RMS difference', 'of its range'];
    this.differences.append(
      h(
        'details',
        { class: 'fold', open: rows.length <= 12 },
        h('summary', {}, `Differences of ${plural(rows.length, 'channel')}, the largest first`),
        h(
          'div',
          { class: 'scroll' },
          h(
            'table',
            {},
            h('thead', {}, h('tr', {}, ...head.map((text, k) => h('th', { class: k >= 2 ? 'number' : null }, text)))),
            h(
              'tbody',
              {},
              ...rows.map(({ channel, max, rms, part }) =>
                h(
                  'tr',
                  { class: channel.stated?.beyond ? 'beyond' : null },
                  h('td', { title: channel.name }, channel.label),
                  h('td', {}, channel.unit),
                  h('td', { class: 'number' }, formatNumber(max, 3)),
                  h('td', { class: 'number' }, formatNumber(rms, 3)),
                  h('td', { class: 'number' }, Number.isFinite(part) ? `${formatNumber(100 * part, 3)} %` : '–'),
                ),
              ),
            ),
          ),
        ),
      ),
    );
  }

  private say(text: string, wrong = false): void {
    this.message.textContent = text;
    this.message.hidden = text === '';
    this.message.classList.toggle('wrong', wrong);
  }

  private setOverlay(table: Hub['overlay'], text: string): void {
    this.clear.hidden = table === null;
    this.modeSwitch.hidden = table === null && !this.channels.some((c) => c.other);
    this.say(text);
    this.hub.setOverlay(table);
  }

  async load(file: File): Promise<void> {
    if (file.size > LARGEST_FILE) return this.say(`${file.name} is larger than ${LARGEST_FILE / 1e6} MB; it is not laid over.`, true);
    try {
      const table = parseCsv(await file.text());
      const here = new Set(this.channels.map((channel) => channel.name));
      const last = this.channels.reduce((most, channel) => Math.max(most, channel.time[channel.time.length - 1] ?? -Infinity), -Infinity);
      const first = this.channels.reduce((least, channel) => Math.min(least, channel.time[0] ?? Infinity), Infinity);
      const [from, to] = [table.time[0], table.time[table.time.length - 1]];
      if (from > last || to < first) return this.say(`${file.name} is not laid over: its times, ${formatNumber(from)} to ${formatNumber(to)} s, lie outside those of this page, ${formatNumber(first)} to ${formatNumber(last)} s.`, true);
      // What cannot be compared does not go over.
      const left: string[] = [];
      for (const channel of this.channels) {
        const unit = table.units.get(channel.name);
        const column = table.columns.get(channel.name);
        if (!column) continue;
        if (unit !== undefined && unit !== channel.unit) left.push(`${channel.name} is in ${unit}, here in ${channel.unit || 'no unit'}`);
        else if (!column.some(Number.isFinite)) left.push(`${channel.name} has no numbers`);
        else continue;
        table.columns.delete(channel.name);
        here.delete(channel.name);
      }
      const both = [...table.columns.keys()].filter((name) => here.has(name));
      const onlyThere = [...table.columns.keys()].filter((name) => !here.has(name));
      const onlyHere = [...here].filter((name) => !table.columns.has(name));
      if (both.length === 0) return this.say(left.length > 0 ? `${file.name} is not laid over: ${listed(left)}.` : `${file.name} has no channel of this page; its columns are ${listed(onlyThere)}.`, true);
      const sentences = [`${file.name}: ${both.length} of ${plural(here.size, 'channel')} ${both.length === 1 ? 'is' : 'are'} laid over, dashed.`];
      if (onlyHere.length > 0) sentences.push(`The file has no ${listed(onlyHere)}.`);
      if (onlyThere.length > 0) sentences.push(`This page has no ${listed(onlyThere)}.`);
      if (table.skipped > 0) sentences.push(`${plural(table.skipped, 'line')} of the file ${table.skipped === 1 ? 'holds' : 'hold'} no numbers and ${table.skipped === 1 ? 'is' : 'are'} ignored.`);
      if (left.length > 0) sentences.push(`Left out: ${listed(left)}.`);
      const still = this.channels.filter((c) => c.still && table.columns.has(c.name)).length;
      if (still > 0) sentences.push(`${plural(still, 'channel')} without a curve ${still === 1 ? 'stays' : 'stay'} as text.`);
      this.setOverlay(table, sentences.join(' '));
    } catch (error) {
      this.say(`${file.name} cannot be laid over: ${error instanceof Error ? error.message : String(error)}.`, true);
    }
  }

  private listenToDrops(): void {
    let depth = 0;
    const veil = h('div', { class: 'veil', hidden: true }, h('p', {}, 'Drop a results.csv to lay its curves over these'));
    document.body.append(veil);
    const hasFiles = (event: DragEvent): boolean => event.dataTransfer?.types.includes('Files') ?? false;
    window.addEventListener('dragenter', (event) => {
      if (!hasFiles(event)) return;
      ++depth;
      veil.hidden = false;
    });
    window.addEventListener('dragleave', (event) => {
      if (hasFiles(event) && --depth <= 0) veil.hidden = true;
    });
    window.addEventListener('dragover', (event) => {
      if (hasFiles(event)) event.preventDefault();
    });
    window.addEventListener('drop', (event) => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      depth = 0;
      veil.hidden = true;
      const file = event.dataTransfer?.files[0];
      if (!file) return;
      this.element.scrollIntoView({ block: 'start', behavior: 'smooth' });
      void this.load(file);
    });
  }
}
