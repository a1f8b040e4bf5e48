// Small helpers for elements. Text is always set as text, so that names cannot be markup.

type Child = Node | string | null | undefined | false;
type Attributes = Record<string, string | number | boolean | null | undefined | ((event: never) => void)>;

function fill(element: Element, attributes: Attributes, children: Child[]): void {
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === 'function') element.addEventListener(key.replace(/^on/, ''), value as EventListener);
    else element.setAttribute(key, value === true ? '' : String(value));
  }
  for (const child of children) if (child) element.append(child);
}

export function h<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  fill(element, attributes, children);
  return element;
}

export function svg(tag: string, attributes: Attributes = {}, ...children: Child[]): SVGElement {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  fill(element, attributes, children);
  return element;
}

const ICONS = {
  play: 'M7 4.5v15l12.5-7.5z',
  pause: 'M6.5 5h3.8v14H6.5zM13.7 5h3.8v14h-3.8z',
  back: 'M16 5.5v13L7.5 12zM5 5.5h1.8v13H5z',
  forward: 'M8 5.5v13l8.5-6.5zM17.2 5.5H19v13h-1.8z',
  first: 'M20 5.5v13L12 12zM12 5.5v13L4 12z',
  loop: '!M17 3l3 3-3 3M4 11V9a3 3 0 0 1 3-3h13M7 21l-3-3 3-3M20 13v2a3 3 0 0 1-3 3H4',
  camera: '!M4 8h3.5L9 5.5h6L16.5 8H20v11H4zM12 16.5a3.3 3.3 0 1 0 0-6.6 3.3 3.3 0 0 0 0 6.6z',
  fit: '!M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5',
  full: '!M14 4h6v6M20 4l-7 7M10 20H4v-6M4 20l7-7',
  help: '!M9.2 9a2.9 2.9 0 1 1 4.3 2.6c-1 .6-1.5 1.1-1.5 2.2M12 17.4v.1M12 21a9 9 0 1 0 0-18 9 9 0 0 0 0 18z',
  eye: '!M2.5 12S6 5.5 12 5.5 21.5 12 21.5 12 18 18.5 12 18.5 2.5 12 2.5 12zM12 15a3 3 0 1 0 0-6 3 3 0 0 0 0 6z',
  hidden: '!M4 4l16 16M9.5 5.8A9 9 0 0 1 12 5.5c6 0 9.5 6.5 9.5 6.5a17 17 0 0 1-3 3.7M6 7.5A16 16 0 0 0 2.5 12S6 18.5 12 18.5a9 9 0 0 0 4-1',
  only: '!M12 3v4M12 17v4M3 12h4M17 12h4M12 15a3 3 0 1 0 0-6 3 3 0 0 0 0 6z',
  sun: '!M12 16.5a4.5 4.5 0 1 0 0-9 4.5 4.5 0 0 0 0 9zM12 2v2.5M12 19.5V22M2 12h2.5M19.5 12H22M4.9 4.9l1.8 1.8M17.3 17.3l1.8 1.8M4.9 19.1l1.8-1.8M17.3 6.7l1.8-1.8',
  moon: '!M20 14.5A8.3 8.3 0 0 1 9.5 4 8.3 8.3 0 1 0 20 14.5z',
  warn: '!M12 4L2.8 19.5h18.4zM12 10v4.5M12 17v.1',
  ok: '!M4.5 12.5l5 5 10-11',
  failed: '!M6 6l12 12M18 6L6 18',
  close: '!M6 6l12 12M18 6L6 18',
  overlay: '!M12 15V4M8 8l4-4 4 4M4 15v5h16v-5',
} as const;

export type IconName = keyof typeof ICONS;

export function icon(name: IconName): SVGElement {
  const path = ICONS[name];
  const lines = path.startsWith('!');
  return svg('svg', { viewBox: '0 0 24 24', class: lines ? 'icon lines' : 'icon', 'aria-hidden': 'true' }, svg('path', { d: lines ? path.slice(1) : path }));
}

export function setIcon(button: HTMLElement, name: IconName): void {
  button.querySelector('svg')?.replaceWith(icon(name));
}

export function button(name: IconName, label: string, action: () => void, attributes: Attributes = {}): HTMLButtonElement {
  return h('button', { type: 'button', class: 'icon-button', title: label, 'aria-label': label, onclick: action, ...attributes }, icon(name));
}

export function check(label: string, checked: boolean, change: (on: boolean) => void): HTMLLabelElement {
  const input = h('input', { type: 'checkbox', checked });
  input.addEventListener('change', () => change(input.checked));
  return h('label', { class: 'check' }, input, h('span', {}, label));
}
