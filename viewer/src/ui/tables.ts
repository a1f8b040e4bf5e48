// Status, trust, facts and speed: sentences, tables and a histogram.

import { groupChannels, type Channel } from '../data/channels';
import { distinctTexts, formatNumber, plural } from '../data/format';
import type { PageJson, TableJson } from '../data/page';
import { stillList } from './curves';
import { h, icon } from './dom';
import type { Hub } from './hub';
import { TimePlot } from './plot';

const STATES: Record<string, [string, string]> = {
  completed: ['Completed', 'ok'],
  interrupted: ['Interrupted', 'warn'],
  failed: ['Failed', 'failed'],
  agree: ['They agree', 'ok'],
  differ: ['They differ', 'failed'],
};

export function statusSection(page: PageJson, problems: string[]): { element: HTMLElement; add: (sentence: string) => void } {
  const status = page.status ?? {};
  const [word, look] = STATES[status.state ?? ''] ?? ['', 'ok'];
  const warnings = (status.warnings ?? []).map(String);
  const list = h('ul', { class: 'warnings' });
  const rest = h('details', { hidden: true }, h('summary', {}, 'More'));
  list.append(rest);
  const warn = (sentence: string): void => {
    const item = h('li', {}, icon('warn'), h('span', {}, sentence));
    if (list.childElementCount <= 6) return list.insertBefore(item, rest) as never;
    rest.hidden = false;
    rest.append(item);
    rest.firstElementChild!.textContent = `${rest.childElementCount - 1} more`;
  };
  warnings.forEach(warn);
  problems.forEach(warn);
  const sentences = (status.sentences ?? []).map((text) => h('p', {}, String(text)));
  const element = h(
    'section',
    { id: 'status', class: `card status ${look}` },
    h(
      'div',
      { class: 'status-row' },
      word ? h('span', { class: `badge ${look}` }, icon(look as 'ok'), word) : null,
      h('div', { class: 'sentences' }, ...(sentences.length > 0 ? sentences : word ? [] : [h('p', {}, 'No status is given.')])),
    ),
    list,
  );
  return { element, add: warn };
}

const NUMBER = /^[\s\u2212+-]?[\d.,]+(?:e[\u2212+-]?\d+)?(?:\s?(?:%|[a-zµ°][\w/²³·^]*))?$/i;

export function tableOf(table: TableJson): HTMLElement {
  const rows = (table.rows ?? []).filter(Array.isArray).map((row) => row.map(String));
  const columns = table.columns ?? null;
  const width = Math.max(columns?.length ?? 0, ...rows.map((row) => row.length));
  const numeric = Array.from({ length: width }, (_, k) => k > 0 && rows.some((row) => row[k]) && rows.every((row) => !row[k] || NUMBER.test(row[k])));
  return h(
    'div',
    { class: 'scroll' },
    h(
      'table',
      { class: columns ? null : 'pairs' },
      columns ? h('thead', {}, h('tr', {}, ...columns.map((text, k) => h('th', { class: numeric[k] ? 'number' : null }, String(text))))) : null,
      h('tbody', {}, ...rows.map((row) => h('tr', {}, ...row.map((text, k) => h(k === 0 && !columns ? 'th' : 'td', { class: numeric[k] && columns ? 'number' : null, scope: k === 0 && !columns ? 'row' : null }, text))))),
    ),
  );
}

/** A table with its heading and note; folded if it is long. */
function tableBlock(table: TableJson, open = false): HTMLElement {
  const body = tableOf(table);
  const note = table.note ? h('p', { class: 'hint' }, table.note) : null;
  return table.rows.length > 20
    ? h('details', { class: 'fold', open }, h('summary', {}, `${table.heading} (${table.rows.length} rows)`), body, note)
    : h('div', { class: 'fact wide' }, h('h3', {}, table.heading), body, note);
}

export function headingOfFacts({ kind }: PageJson): string {
  return kind === 'reduce' ? 'The part' : kind === 'sweep' ? 'Settings' : 'Model';
}

export function factsSection(page: PageJson): HTMLElement | null {
  const facts = page.facts ?? [];
  const tables = page.tables ?? [];
  if (facts.length + tables.length === 0) return null;
  return h(
    'section',
    { id: 'facts', class: 'card' },
    h('div', { class: 'section-head' }, h('h2', {}, headingOfFacts(page))),
    facts.length > 0 ? h('div', { class: 'fact-grid' }, ...facts.map((fact) => h('div', { class: 'fact' }, h('h3', {}, fact.heading), tableOf({ ...fact, columns: null })))) : null,
    // The result of a page of vibrations is its first table: it stands open, on paper, too.
    ...tables.map((table, k) => tableBlock(table, page.kind === 'modes' && k === 0)),
  );
}

const GROUPS: [string, string][] = [
  ['constraints', 'Constraints'],
  ['energy', 'Energy balance'],
  ['effort', 'Iterations and substeps'],
  ['range', 'Range of the method'],
];

function largest(channel: Channel): number {
  return channel.range ? Math.max(Math.abs(channel.range.min), Math.abs(channel.range.max)) : 0;
}

function inEights(channels: Channel[]): Channel[][] {
  return Array.from({ length: Math.ceil(channels.length / 8) }, (_, k) => channels.slice(8 * k, 8 * k + 8));
}

// Terms below this part of the largest are flat on its axis: they get one of their own.
const SMALL_TERM = 0.02;

function energyPlots(channels: Channel[], hub: Hub): HTMLElement[] {
  const most = Math.max(0, ...channels.map(largest));
  const small = channels.filter((c) => largest(c) < SMALL_TERM * most);
  const large = channels.filter((c) => !small.includes(c));
  const plots = (list: Channel[], title: string): HTMLElement[] => inEights(list).map((part) => new TimePlot({ title, unit: part[0].unit, channels: part, height: 240 }, hub).element);
  return [...plots(large, 'Terms of the balance'), ...plots(small, 'Small terms')];
}

/** Bodies of one kind share an axis, those that deform most first. */
function rangePlots(channels: Channel[], hub: Hub): HTMLElement[] {
  const kinds = [...new Set(channels.map((c) => c.kind))];
  return kinds.flatMap((kind) => {
    const members = channels.filter((c) => c.kind === kind).sort((a, b) => largest(b) - largest(a));
    return inEights(members).map((part) => new TimePlot({ title: kind, unit: part[0].unit, channels: part, limit: part[0].limit }, hub).element);
  });
}

function sharedPlots(channels: Channel[], hub: Hub): HTMLElement[] {
  return groupChannels(channels.map((c) => ({ ...c, body: null }))).flatMap((group) =>
    group.plots.map((plot) => {
      const title = plot.channels.length === 1 ? plot.channels[0].label : plot.kind.replace(/_/g, ' ');
      return new TimePlot({ title: title.charAt(0).toUpperCase() + title.slice(1), unit: plot.unit, channels: plot.channels }, hub).element;
    }),
  );
}

export function trustSection(rows: string[][], tables: TableJson[], channels: Channel[], notes: Record<string, string>, hub: Hub): HTMLElement | null {
  if (rows.length + channels.length === 0) return null;
  const element = h('section', { id: 'trust', class: 'card' }, h('div', { class: 'section-head' }, h('h2', {}, 'Can I trust it?')));
  if (rows.length > 0) {
    element.append(
      h(
        'ul',
        { class: 'verdicts' },
        ...rows.map((row) => {
          const look = row[2] === 'warn' ? 'warn' : row[2] === 'ok' ? 'ok' : 'plain';
          return h('li', { class: look }, look === 'plain' ? h('span', { class: 'dot' }) : icon(look), h('span', { class: 'what' }, String(row[0])), h('span', { class: 'value' }, String(row[1] ?? '')));
        }),
      ),
    );
  }
  element.append(...tables.map((table) => tableBlock(table)));
  const known = GROUPS.map(([key]) => key);
  for (const [key, heading] of [...GROUPS, ['', 'More'] as [string, string]]) {
    const members = channels.filter((c) => (key === '' ? !known.includes(c.group) : c.group === key));
    if (members.length === 0) continue;
    const moving = members.filter((c) => !c.still);
    const plots = key === 'energy' ? energyPlots(moving, hub) : key === 'range' ? rangePlots(moving, hub) : sharedPlots(moving, hub);
    const note = notes[key] ? h('p', { class: 'hint' }, String(notes[key])) : null;
    element.append(
      h('div', { class: `body-group trust-${key || 'more'}` }, h('h3', {}, heading), note, plots.length > 0 ? h('div', { class: 'plots' }, ...plots) : null, stillList(members.filter((c) => c.still))),
    );
  }
  return element;
}

interface StepTimes {
  edges: number[];
  counts: number[];
  median?: number | null;
  percent_99?: number | null;
}

/** Place of a time among bins of equal width on the page, 0 to 1. */
export function placeAmongBins(edges: number[], value: number): number {
  const bins = edges.length - 1;
  let k = 0;
  while (k < bins - 1 && value >= edges[k + 1]) ++k;
  const part = (value - edges[k]) / (edges[k + 1] - edges[k]);
  return (k + Math.min(1, Math.max(0, part))) / bins;
}

function histogram({ edges, counts, median, percent_99 }: StepTimes): HTMLElement {
  const most = Math.max(1, ...counts);
  const total = counts.reduce((a, b) => a + b, 0);
  const bars = counts.map((count, k) => {
    const range = `${formatNumber(edges[k], 3)} to ${formatNumber(edges[k + 1], 3)} ms`;
    const bar = h('div', { class: 'bar', style: `height: ${count > 0 ? Math.max(1.5, (100 * count) / most).toFixed(2) : 0}%` });
    return h('div', { class: 'slot', title: `${plural(count, 'step')} of ${range}` }, bar);
  });
  const lines = (
    [
      ['median', median],
      ['99 %', percent_99],
    ] as [string, number | null | undefined][]
  )
    .filter(([, value]) => typeof value === 'number' && Number.isFinite(value))
    .map(([name, value]) => {
      const place = placeAmongBins(edges, value!);
      return h('div', { class: `quantile${place > 0.6 ? ' left' : ''}`, style: `left: ${(100 * place).toFixed(2)}%` }, h('span', {}, `${name} ${formatNumber(value!, 3)} ms`));
    });
  // Each below its edge.
  const marked = [...new Set([0, 0.25, 0.5, 0.75, 1].map((part) => Math.round(part * counts.length)))];
  const texts = distinctTexts(marked.map((k) => edges[k]), 2);
  const marks = marked.map((k, i) => h('span', { style: `left: ${((100 * k) / counts.length).toFixed(2)}%` }, texts[i]));
  return h(
    'figure',
    { class: 'histogram', 'aria-label': `Histogram of the time of ${total} steps` },
    h('figcaption', {}, h('span', { class: 'plot-title' }, 'Processor time of a step'), h('span', { class: 'unit' }, 'ms'), h('span', { class: 'plot-note' }, plural(total, 'step'))),
    h('div', { class: 'bars' }, ...bars, ...lines),
    h('div', { class: 'marks' }, ...marks),
  );
}

export function speedSection(page: PageJson, report: (sentence: string) => void): HTMLElement | null {
  const speed = page.speed;
  if (!speed) return null;
  const rows = speed.rows ?? [];
  const times = speed.step_times;
  const good = times && Array.isArray(times.edges) && Array.isArray(times.counts) && times.edges.length === times.counts.length + 1 && times.counts.length > 0;
  if (times && !good) report('The histogram of step times is left out: its edges and counts do not fit.');
  if (rows.length === 0 && !good) return null;
  return h(
    'section',
    { id: 'speed', class: 'card' },
    h('div', { class: 'section-head' }, h('h2', {}, 'Speed')),
    h('div', { class: 'speed-grid' }, rows.length > 0 ? tableOf({ heading: '', rows }) : null, good ? histogram(times) : null),
  );
}
