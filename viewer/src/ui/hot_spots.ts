// The hottest places of a run as a list: a line sets the time, chooses the place and brings the camera there.

import { Vector3 } from 'three';
import { distinctTexts, formatNumber } from '../data/format';
import type { Triple } from '../data/page';
import { hotSpots, type HotSpot } from '../motion/hot_spots';
import type { Player } from '../motion/player';
import type { Stage } from '../scene/stage';
import { h } from './dom';

/** Lines of each body. */
const MOST = 10;

/** Distance of the camera, in parts of the size of the body; how far to the side the surface may be turned away. */
const NEAR = 1.3;
const FACING = 0.35;

/** Sum of the normals of the triangles at a vertex, in the body's frame. */
function outward(stage: Stage, spot: HotSpot): Triple {
  const { vertices, triangles } = stage.scene.bodies[spot.body].mesh!;
  const sum = new Vector3();
  const corners = [new Vector3(), new Vector3(), new Vector3()];
  for (let i = 0; i < triangles.length; i += 3) {
    if (triangles[i] !== spot.vertex && triangles[i + 1] !== spot.vertex && triangles[i + 2] !== spot.vertex) continue;
    corners.forEach((corner, k) => corner.fromArray(vertices, 3 * triangles[i + k]));
    sum.add(corners[1].sub(corners[0]).cross(corners[2].sub(corners[0])));
  }
  return [sum.x, sum.y, sum.z];
}

/** The camera turns about the place, near, on the side from which it is seen. */
export function lookAtSpot(stage: Stage, spot: HotSpot): void {
  const { root, controls, camera } = stage;
  root.updateMatrixWorld(true);
  const turn = (direction: Triple): Vector3 => {
    const at = stage.motion.toWorld(spot.body, 0, 0, 0);
    const to = stage.motion.toWorld(spot.body, ...direction);
    return new Vector3(to[0] - at[0], to[1] - at[1], to[2] - at[2]).transformDirection(root.matrixWorld);
  };
  const place = new Vector3(...stage.vertexPosition(spot.body, spot.vertex)).applyMatrix4(root.matrixWorld);
  const from = camera.position.clone().sub(controls.target).normalize();
  const normal = turn(outward(stage, spot)).normalize();
  if (normal.lengthSq() > 0.5) {
    const facing = normal.dot(from);
    if (facing < FACING) from.addScaledVector(normal, FACING - facing + 0.3).normalize();
  }
  const { size } = stage.scene.bodies[spot.body];
  const distance = Math.min(camera.position.distanceTo(controls.target), NEAR * (size > 0 ? size : stage.size));
  controls.target.copy(place);
  camera.position.copy(place).addScaledVector(from, distance);
  controls.update();
  stage.invalidate();
}

export class HotSpotList {
  readonly element = h('div', { class: 'hot-spots' });
  readonly spots: HotSpot[];
  private readonly rows: HTMLElement[] = [];

  /** `show` makes the body visible, chooses the place and colours by stress. */
  constructor(stage: Stage, player: Player, show: (spot: HotSpot) => void) {
    this.spots = hotSpots(stage.scene, MOST);
    const texts = distinctTexts(this.spots.map((spot) => spot.stress));
    const rows = this.spots.map((spot, k) => {
      const { name } = stage.scene.bodies[spot.body];
      const go = h(
        'button',
        {
          type: 'button',
          class: 'spot',
          title: `Show ${name}, ${spot.node === null ? `vertex ${spot.vertex}` : `node ${spot.node}`} at ${formatNumber(spot.time, 4)} s`,
          onclick: () => {
            this.choose(k);
            player.pause();
            // Before the camera, which may follow a body.
            player.set(spot.time);
            show(spot);
            lookAtSpot(stage, spot);
          },
        },
        h('span', { class: 'spot-body' }, name),
        h('span', { class: 'spot-node' }, spot.node === null ? `v ${spot.vertex}` : String(spot.node)),
        h('span', { class: 'spot-stress' }, texts[k]),
        h('span', { class: 'spot-time' }, formatNumber(spot.time, 4)),
      );
      this.rows.push(go);
      return h('li', {}, go);
    });
    this.element.append(
      h('div', { class: 'spot spot-head', 'aria-hidden': 'true' }, h('span', { class: 'spot-body' }, 'body'), h('span', { class: 'spot-node' }, 'node'), h('span', { class: 'spot-stress' }, 'MPa'), h('span', { class: 'spot-time' }, 's')),
      h('ol', { 'aria-label': 'Hot spots' }, ...rows),
      h('p', { class: 'hint' }, 'Places whose largest von Mises stress of the run is larger than that of all next to them, those that are not to be trusted left out. A line goes to the place and the instant.'),
    );
  }

  private choose(row: number): void {
    this.rows.forEach((element, k) => element.setAttribute('aria-pressed', String(k === row)));
  }
}
