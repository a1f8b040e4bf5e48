// Keys of the player and the view, and the little page that lists them.

import { button, h } from './dom';
import type { ViewSection } from './view';

const KEYS: [string, string][] = [
  ['Space', 'play, pause'],
  ['← →', 'a frame back, forward (with shift: ten)'],
  ['Home End', 'to the start, to the end'],
  ['[ ]', 'slower, faster'],
  ['↑ ↓', 'another mode, where there are modes'],
  ['L', 'loop'],
  ['F', 'go to what is chosen, else the whole motion (with shift: always)'],
  ['1 2 3 4', 'iso, front, side, top'],
  ['Esc', 'nothing chosen'],
  ['?', 'this help'],
];

const POINTER: [string, string][] = [
  ['Drag', 'turn; right button or two fingers: move'],
  ['Wheel', 'nearer, farther'],
  ['Click', 'choose a body and its node'],
  ['Double-click', 'go to a body; beside it: the whole motion'],
];

export function buildHelp(): { dialog: HTMLDialogElement; open: () => void } {
  const rows = (keys: [string, string][]): HTMLElement =>
    h('dl', {}, ...keys.flatMap(([key, text]) => [h('dt', {}, ...key.split(' ').map((k) => (keys === KEYS ? h('kbd', {}, k) : k + ' '))), h('dd', {}, text)]));
  const dialog = h('dialog', { class: 'help', 'aria-label': 'Help' });
  dialog.append(
    h('div', { class: 'section-head' }, h('h2', {}, 'Keys'), button('close', 'Close', () => dialog.close())),
    rows(KEYS),
    h('h3', {}, 'In the view'),
    rows(POINTER),
  );
  dialog.addEventListener('click', (event) => {
    if (event.target === dialog) dialog.close();
  });
  return { dialog, open: () => dialog.showModal() };
}

export function listenToKeys(view: ViewSection | null, help: () => void): void {
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    const target = event.target as HTMLElement;
    if (document.querySelector('dialog[open]')) return;
    const scrubber = target.classList.contains('scrubber');
    if (!scrubber && target.matches('input:not([type=checkbox]), select, textarea')) return;
    if (event.key === '?') {
      event.preventDefault();
      return help();
    }
    if (!view) return;
    const { player, stage } = view;
    // A button that has the keyboard's focus keeps its own keys.
    if (event.key === ' ' && target.matches('button:focus-visible, summary, input')  && !scrubber) return;
    const actions: Record<string, () => void> = {
      ' ': () => player.toggle(),
      ArrowLeft: () => player.step(event.shiftKey ? -10 : -1),
      ArrowRight: () => player.step(event.shiftKey ? 10 : 1),
      Home: () => (player.pause(), player.set(player.start)),
      End: () => (player.pause(), player.set(player.end)),
      '[': () => player.changeSpeed(-1),
      ']': () => player.changeSpeed(1),
      l: () => player.setLoop(!player.loop),
      f: () => (event.shiftKey ? view.fit() : view.goToChosen()),
      1: () => stage.standard('iso'),
      2: () => stage.standard('front'),
      3: () => stage.standard('side'),
      4: () => stage.standard('top'),
      Escape: () => view.choose(-1, null, false),
    };
    if (view.modes) {
      actions.ArrowUp = () => view.modes!.step(-1);
      actions.ArrowDown = () => view.modes!.step(1);
    }
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action || (!player.moves && /^( |Arrow|Home|End|\[|\]|l$)/.test(event.key))) return;
    event.preventDefault();
    action();
  });
}
