// What the length of arrows and the angle of arcs mean, shown while forces are.

import { formatEffort, niceBelow } from '../data/format';
import type { Stage } from '../scene/stage';
import { h } from './dom';

const LONGEST = 90;

export class ArrowKey {
  readonly element: HTMLElement;
  private readonly stage: Stage;
  private readonly shaft = h('span', { class: 'arrow-key-shaft' });
  private readonly sample = h('span', {});

  constructor(stage: Stage) {
    this.stage = stage;
    const { force, torque } = stage.connections.effortScale;
    const forceLine = h('div', { class: 'arrow-key-line' }, this.shaft, this.sample, h('span', { class: 'arrow-key-scale' }, `arrow of 1 m = ${formatEffort(force, 'N')}`));
    const torqueLine = h('div', { class: 'arrow-key-line' }, h('span', { class: 'arrow-key-arc' }), h('span', { class: 'arrow-key-scale' }, `arc of 90° = ${formatEffort(torque, 'N m')}`));
    this.element = h('div', { class: 'arrow-key', 'aria-live': 'off' }, force > 0 ? forceLine : null, torque > 0 ? torqueLine : null);
    stage.onView(() => this.update());
    this.update();
  }

  /** In one line, for pictures; empty while no arrows are shown. */
  get text(): string {
    const { force, torque } = this.stage.connections.effortScale;
    if (this.element.hidden) return '';
    return [force > 0 ? `arrow of 1 m = ${formatEffort(force, 'N')}` : '', torque > 0 ? `arc of 90° = ${formatEffort(torque, 'N m')}` : ''].filter(Boolean).join(', ');
  }

  /** The sample is as long as such an arrow where the camera looks. */
  private update(): void {
    const { connections } = this.stage;
    const { force, torque } = connections.effortScale;
    this.element.hidden = !connections.layers.loads.visible || (force === 0 && torque === 0);
    if (this.element.hidden || force === 0) return;
    const pixel = this.stage.pixelSize();
    const newtons = niceBelow(LONGEST * pixel * force);
    this.shaft.style.width = `${(newtons / force / pixel).toFixed(1)}px`;
    this.sample.textContent = formatEffort(newtons, 'N');
  }
}
