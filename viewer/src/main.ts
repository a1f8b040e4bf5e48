// The page: reads its data, builds its sections in order, and says in sentences what it cannot show.

import './styles/page.css';
import 'uplot/dist/uPlot.min.css';
import { decodeBuffer, PageBuffer, PageError } from './data/buffer';
import { readChannel, type Channel } from './data/channels';
import type { ChannelJson, CurvesJson, PageJson, View } from './data/page';
import { readScene } from './data/scene_data';
import { readStudy } from './data/study';
import { offerInterface } from './interface';
import { Curves } from './ui/curves';
import { button, h, setIcon } from './ui/dom';
import { Hub } from './ui/hub';
import { buildHelp, listenToKeys } from './ui/keyboard';
import { listenToPrinting } from './ui/paper';
import { StudySection } from './ui/study';
import { factsSection, headingOfFacts, speedSection, statusSection, trustSection } from './ui/tables';
import { isDark, onTheme, toggleTheme } from './ui/theme';
import { ViewSection } from './ui/view';

const KINDS: Record<string, string> = { run: 'Run', check: 'Check', reduce: 'Reduced part', compare: 'Comparison', modes: 'Vibrations', sweep: 'Study' };
const SCHEMA = 1;

function textOf(id: string): string | null {
  return document.getElementById(id)?.textContent ?? null;
}

function sentence(error: unknown): string {
  return error instanceof PageError ? error.message : `Something in this page did not work: ${error instanceof Error ? error.message : String(error)}.`;
}

function readPage(): PageJson {
  const text = textOf('floatframe-page');
  if (text === null) throw new PageError('This page holds no data: it is the empty form that the program fills.');
  let page: PageJson;
  try {
    page = JSON.parse(text) as PageJson;
  } catch {
    throw new PageError('The data of this page are damaged or cut short: they cannot be read.');
  }
  if (typeof page !== 'object' || page === null || Array.isArray(page)) throw new PageError('The data of this page are damaged: no record is found.');
  if (page.schema !== SCHEMA) throw new PageError(`The data of this page are of version ${String(page.schema)}, expected ${SCHEMA}: page and program do not belong together.`);
  return page;
}

function readChannels(list: ChannelJson[], curves: CurvesJson, buffer: PageBuffer, report: (sentence: string) => void): Channel[] {
  if (list.length === 0) return [];
  const channels: Channel[] = [];
  try {
    const time = Float64Array.from(buffer.read(curves.time as View, 'Times of the curves', ['f64', 'f32'], [null]));
    for (let i = 1; i < time.length; ++i) {
      if (!(time[i] >= time[i - 1])) throw new PageError(`The curves are left out: their times do not increase at row ${i}.`);
    }
    for (const json of list) {
      try {
        channels.push(readChannel(json, curves, time, buffer));
      } catch (error) {
        report(sentence(error));
      }
    }
  } catch (error) {
    report(sentence(error));
  }
  return channels;
}

function header(page: PageJson | null, sections: [string, string][], help: () => void): HTMLElement {
  const title = page?.title || 'Floatframe';
  const theme = button(isDark() ? 'sun' : 'moon', 'Light or dark', toggleTheme);
  onTheme((dark) => setIcon(theme, dark ? 'sun' : 'moon'));
  return h(
    'header',
    { class: 'top' },
    h('div', { class: 'top-title' }, h('h1', {}, title), page ? h('span', { class: 'kind' }, KINDS[page.kind] ?? String(page.kind)) : null),
    h('nav', { 'aria-label': 'Sections', class: 'no-print' }, ...sections.map(([id, label]) => h('a', { href: `#${id}` }, label))),
    h('div', { class: 'top-tools no-print' }, button('help', 'Keys (?)', help), theme),
  );
}

function webglSentence(error: unknown): string {
  const reason = error instanceof Error && error.message ? ` (${error.message.replace(/\.$/, '')})` : '';
  return `The 3-D view needs WebGL 2, which this browser does not give${reason}. Everything else on this page works; another browser, or hardware acceleration switched on in this one, shows the view.`;
}

function hasWebgl(): boolean {
  return document.createElement('canvas').getContext('webgl2') !== null;
}

async function build(app: HTMLElement): Promise<void> {
  const problems: string[] = [];
  let add: ((sentence: string) => void) | null = null;
  const report = (text: string): void => {
    problems.push(text);
    add?.(text);
  };
  const help = buildHelp();
  document.body.append(help.dialog);
  let page: PageJson;
  try {
    page = readPage();
  } catch (error) {
    app.replaceChildren(header(null, [], help.open), h('main', {}, h('section', { class: 'card status failed' }, h('p', {}, sentence(error)))));
    offerInterface(null, [sentence(error)], []);
    return;
  }
  document.title = page.title ? `${page.title} · Floatframe` : 'Floatframe';

  let buffer = new PageBuffer(new Uint8Array(0));
  try {
    buffer = await decodeBuffer(textOf('floatframe-buffer') ?? '', page.compression);
  } catch (error) {
    report(sentence(error));
  }

  const hub = new Hub();
  const curvesJson: CurvesJson = page.curves ?? { time: { type: 'f64', offset: 0, shape: [0] }, channels: [] };
  const channels = readChannels(page.curves?.channels ?? [], curvesJson, buffer, report);
  const trusted = readChannels(page.trust?.channels ?? [], page.trust?.time ? { time: page.trust.time, channels: [] } : curvesJson, buffer, report);
  let view: ViewSection | null = null;
  let noView: HTMLElement | null = null;
  if (page.scene) {
    try {
      const scene = readScene(page.scene, page.kind, buffer, report);
      view = new ViewSection(scene, hub, [...channels, ...trusted], page.title || 'floatframe');
    } catch (error) {
      const text = error instanceof PageError ? error.message : hasWebgl() ? sentence(error) : webglSentence(error);
      noView = h('section', { id: 'view', class: 'card no-view' }, h('p', {}, text));
      problems.push(text);
    }
  }

  const sections: [string, string, HTMLElement | null][] = [];
  const shown = view || !noView ? problems : problems.slice(0, -1);
  let status: ReturnType<typeof statusSection>;
  try {
    status = statusSection(page, shown);
  } catch {
    status = statusSection({ ...page, status: undefined }, [...shown, 'The status of the run is left out: its record is damaged.']);
  }
  add = status.add;
  // Damage of one section is a sentence; the others stay.
  const part = <T,>(what: string, make: () => T): T | null => {
    try {
      return make();
    } catch (error) {
      report(error instanceof PageError ? error.message : `${what} left out: the record is damaged.`);
      return null;
    }
  };
  const curves = part('The curves are', () => (channels.length > 0 ? new Curves(channels, hub, page.kind === 'compare' || page.curves?.names ? (page.curves?.names ?? ['first', 'second']) : null) : null));
  sections.push(['view', '3-D view', view?.element ?? noView]);
  sections.push(['study', 'Study', part('The runs of the study are', () => (page.study ? new StudySection(readStudy(page.study, buffer)).element : null))]);
  sections.push(['curves', 'Curves', curves?.element ?? null]);
  sections.push(['trust', 'Trust', part('What tells whether to trust the run is', () => trustSection((page.trust?.rows ?? []) as string[][], page.trust?.tables ?? [], trusted, page.trust?.notes ?? {}, hub))]);
  sections.push(['facts', headingOfFacts(page), part('The tables of the model are', () => factsSection(page))]);
  sections.push(['speed', 'Speed', part('The times of the steps are', () => speedSection(page, report))]);
  const present = sections.filter(([, , element]) => element !== null);
  const links = present.map(([id, label]): [string, string] => [id, label]);
  const pair = h('div', { class: `pair${view && curves ? ' both' : ''}` }, view?.element ?? noView, curves?.element);
  app.replaceChildren(
    header(page, links, help.open),
    h('main', {}, status.element, pair.childElementCount > 0 ? pair : null, ...present.filter(([id]) => id !== 'view' && id !== 'curves').map(([, , element]) => element)),
    h('footer', {}, page.program ?? ''),
  );
  onTheme(() => hub.redraw());
  listenToKeys(view, help.open);
  view?.start();
  offerInterface(view, problems, [...channels, ...trusted]);
}

listenToPrinting();
const app = document.getElementById('app')!;
build(app).catch((error: unknown) => {
  // Whatever happens, a sentence stays on the page.
  app.replaceChildren(h('main', {}, h('section', { class: 'card status failed' }, h('p', {}, sentence(error)))));
  offerInterface(null, [sentence(error)], []);
});
