// Bodies by name: show, hide, isolate, choose.

import type { Stage } from '../scene/stage';
import { button, h, setIcon } from './dom';

export class BodyList {
  readonly element: HTMLElement;
  private readonly stage: Stage;
  private readonly rows: { element: HTMLElement; eye: HTMLButtonElement; only: HTMLButtonElement; name: HTMLButtonElement }[] = [];
  private readonly all: HTMLButtonElement;

  constructor(stage: Stage, choose: (body: number) => void, goTo: (body: number) => void) {
    this.stage = stage;
    const list = h('ul', { class: 'body-list' });
    const bodies = stage.scene.bodies;
    for (const body of bodies) {
      const name = h('button', { type: 'button', class: 'body-name', onclick: () => choose(body.index), ondblclick: () => goTo(body.index) }, body.name);
      const eye = button('eye', `Hide ${body.name}`, () => this.set(body.index, !stage.bodies[body.index].group.visible));
      const only = button('only', `Show only ${body.name}`, () => this.isolate(body.index));
      const kind = body.modeCount > 0 ? `${body.modeCount} modes` : 'rigid';
      const swatch = h('span', { class: 'body-swatch', style: `background: #${stage.bodies[body.index].colour.getHexString()}` });
      const element = h('li', {}, swatch, name, h('span', { class: 'body-kind' }, kind), only, eye);
      this.rows.push({ element, eye, only, name });
      list.append(element);
    }
    this.all = h('button', { type: 'button', class: 'button', onclick: () => this.showAll() }, 'Show all');
    const search = h('input', { type: 'search', class: 'field', placeholder: 'Find a body', 'aria-label': 'Find a body' });
    search.addEventListener('input', () => {
      const word = search.value.trim().toLowerCase();
      this.rows.forEach((row, b) => (row.element.hidden = !bodies[b].name.toLowerCase().includes(word)));
    });
    this.element = h('div', {}, h('div', { class: 'row' }, search, this.all), list);
    this.update();
  }

  set(body: number, visible: boolean): void {
    this.stage.setVisible(body, visible);
    this.update();
  }

  showAll(): void {
    this.rows.forEach((_, b) => this.stage.setVisible(b, true));
    this.update();
  }

  isolate(body: number): void {
    const alone = this.stage.bodies.every((view, b) => view.group.visible === (b === body));
    this.rows.forEach((_, b) => this.stage.setVisible(b, alone || b === body));
    this.update();
  }

  choose(body: number): void {
    this.rows.forEach((row, b) => row.element.classList.toggle('chosen', b === body));
    // Within the list only: the page stays where it is.
    const list = this.rows[body]?.element.parentElement;
    const row = this.rows[body]?.element;
    if (list && row && (row.offsetTop < list.scrollTop || row.offsetTop > list.scrollTop + list.clientHeight - 30)) list.scrollTop = row.offsetTop - list.clientHeight / 2;
  }

  private update(): void {
    let hidden = 0;
    this.rows.forEach((row, b) => {
      const { visible } = this.stage.bodies[b].group;
      if (!visible) ++hidden;
      setIcon(row.eye, visible ? 'eye' : 'hidden');
      const label = `${visible ? 'Hide' : 'Show'} ${this.stage.scene.bodies[b].name}`;
      row.eye.title = label;
      row.eye.setAttribute('aria-label', label);
      row.element.classList.toggle('off', !visible);
    });
    this.all.disabled = hidden === 0;
  }
}
