// Status, trust, facts and speed: sentences, tables and a histogram.

import { groupChannels, type Channel } from '../data/channels';
import { formatNumber } from '../data/format';
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

export function factsSection(page: PageJson): HTMLElement | null {
  const facts = page.facts ?? [];
  const tables = page.tables ?? [];
  if (facts.length + tables.length === 0) return null;
  return h(
    'section',
    { id: 'facts', class: 'card' },
    h('div', { class: 'section-head' }, h('h2', {}, page.kind === 'reduce' ? 'The part' : 'Model')),
    facts.length > 0 ? h('div', { class: 'fact-grid' }, ...facts.map((fact) => h('div', { class: 'fact' }, h('h3', {}, fact.heading), tableOf({ ...fact, columns: null })))) : null,
    ...tables.map((table) => {
      const large = table.rows.length > 14;
      const body = tableOf(table);
      return large
        ? h('details', { class: 'fold' }, h('summary', {}, `${table.heading} (${table.rows.length} rows)`), body)
        : h('div', { class: 'fact wide' }, h('h3', {}, table.heading), body, table.note ? h('p', { class: 'hint' }, table.note) : null);
    }),
  );
}

const GROUPS: [string, string][] = [
  ['constraints', 'Constraints'],
  ['energy', 'Energy balance'],
  ['effort', 'Iterations and substeps'],
  ['range', 'Range of the method'],
];

export function trustSection(rows: string[][], channels: Channel[], hub: Hub): HTMLElement | null {
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
  const known = GROUPS.map(([key]) => key);
  for (const [key, heading] of [...GROUPS, ['', 'More'] as [string, string]]) {
    const members = channels.filter((c) => (key === '' ? !known.includes(c.group) : c.group === key));
    if (members.length === 0) continue;
    const grid = h('div', { class: 'plots' });
    const still: Channel[] = [];
    if (key === 'energy') {
      // All terms of the balance on one axis, whatever their size.
      const moving = members.filter((c) => !c.still);
      still.push(...members.filter((c) => c.still));
      for (let k = 0; k < moving.length; k += 8) grid.append(new TimePlot({ title: 'Terms', unit: moving[0].unit, channels: moving.slice(k, k + 8), height: 240 }, hub).element);
    } else {
      for (const group of groupChannels(members.map((c) => ({ ...c, body: null })))) {
        still.push(...group.still);
        for (const plot of group.plots) grid.append(new TimePlot({ title: plot.channels.length === 1 ? plot.channels[0].label : plot.kind.replace(/_/g, ' '), unit: plot.unit, channels: plot.channels }, hub).element);
      }
    }
    element.append(h('div', { class: 'body-group' }, h('h3', {}, heading), grid.childElementCount > 0 ? grid : null, stillList(still)));
  }
  return element;
}

function histogram(edges: number[], counts: number[]): HTMLElement {
  const largest = Math.max(1, ...counts);
  const total = counts.reduce((a, b) => a + b, 0);
  const bars = counts.map((count, k) => {
    const range = `${formatNumber(edges[k], 3)} to ${formatNumber(edges[k + 1], 3)} ms`;
    const bar = h('div', { class: 'bar', style: `height: ${count > 0 ? Math.max(1.5, (100 * count) / largest).toFixed(2) : 0}%` });
    return h('div', { class: 'slot', title: `${count} steps of ${range}` }, bar);
  });
  const marks = [0, 0.25, 0.5, 0.75, 1].map((part) => h('span', {}, `${formatNumber(edges[Math.round(part * (edges.length - 1))], 2)}`));
  return h(
    'figure',
    { class: 'histogram', role: 'img', 'aria-label': `Histogram of the time of ${total} steps` },
    h('figcaption', {}, h('span', { class: 'plot-title' }, 'Time of a step'), h('span', { class: 'unit' }, `ms, ${total} steps`)),
    h('div', { class: 'bars' }, ...bars),
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
    h('div', { class: 'speed-grid' }, rows.length > 0 ? tableOf({ heading: '', rows }) : null, good ? histogram(times.edges, times.counts) : null),
  );
}
