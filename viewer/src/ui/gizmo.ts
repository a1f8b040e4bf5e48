// In a corner of the view: the axes as the camera sees them, and a bar of known length.

import { Quaternion, Vector3 } from 'three';
import { formatLength, niceBelow } from '../data/format';
import type { Stage } from '../scene/stage';
import { h, svg } from './dom';

const AXES: [string, Vector3, string][] = [
  ['x', new Vector3(1, 0, 0), 'axis-x'],
  ['y', new Vector3(0, 1, 0), 'axis-y'],
  ['z', new Vector3(0, 0, 1), 'axis-z'],
];
const REACH = 25;
const LONGEST_BAR = 130;

export function buildGizmo(stage: Stage): HTMLElement {
  const parts = AXES.map(([name, , kind]) => {
    const line = svg('line', { class: kind });
    const disc = svg('circle', { r: 7, class: kind });
    const text = svg('text', { 'text-anchor': 'middle', 'dominant-baseline': 'central' }, name);
    return { group: svg('g', {}, line, disc, text), line, disc, text };
  });
  const picture = svg('svg', { viewBox: '-34 -34 68 68', width: 68, height: 68, class: 'axes', role: 'img', 'aria-label': 'Axes of the world' }, ...parts.map((part) => part.group));
  const bar = h('span', { class: 'scale-bar' });
  const text = h('span', { class: 'scale-text' });
  const inverse = new Quaternion();
  const axis = new Vector3();
  const update = (): void => {
    inverse.copy(stage.camera.quaternion).invert();
    const order = AXES.map(([, direction], k) => {
      axis.copy(direction).applyQuaternion(stage.root.quaternion).applyQuaternion(inverse);
      const [x, y] = [axis.x * REACH, -axis.y * REACH];
      parts[k].line.setAttribute('x2', x.toFixed(1));
      parts[k].line.setAttribute('y2', y.toFixed(1));
      for (const [element, names] of [
        [parts[k].disc, ['cx', 'cy']],
        [parts[k].text, ['x', 'y']],
      ] as const) {
        element.setAttribute(names[0], x.toFixed(1));
        element.setAttribute(names[1], y.toFixed(1));
      }
      return { k, depth: axis.z };
    }).sort((a, b) => a.depth - b.depth);
    for (const { k } of order) picture.append(parts[k].group);
    const pixel = stage.pixelSize();
    const length = niceBelow(pixel * LONGEST_BAR);
    bar.style.width = `${(length / pixel).toFixed(1)}px`;
    text.textContent = formatLength(length, 3);
  };
  stage.onView(update);
  update();
  return h('div', { class: 'gizmo' }, picture as unknown as HTMLElement, h('span', { class: 'scale' }, bar, text));
}
