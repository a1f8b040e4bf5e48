// window.floatframe: what scripts and tests may read and set.

import type { Channel } from './data/channels';
import type { Triple } from './data/page';
import { valueAt } from './data/series';
import type { ViewSection } from './ui/view';

export interface FloatframeInterface {
  ready: boolean;
  problems: string[];
  readonly time: number;
  setTime(time: number): void;
  bodies: { name: string; readonly visible: boolean }[];
  worldPosition(body: number, local: Triple, modes?: Triple[] | null): Triple | null;
  vertexPosition(body: number, vertex: number): Triple | null;
  pointPosition(index: number): Triple | null;
  /** Where a place in the world is drawn: pixels from the left and from the top of the view; null behind the camera. */
  pixelOf(place: Triple): [number, number] | null;
  channelValue(name: string): number;
  readonly scale: number;
  setScale(scale: number): void;
  /** The mode that is drawn, by its place in the list. */
  readonly mode: number | null;
  chooseMode(row: number): void;
  readonly selected: { body: number; vertex: number | null } | null;
  /** Where the camera looks. */
  cameraTarget(): Triple | null;
  /** A joint, force or rod that is chosen in the place of a body. */
  readonly selectedPart: { kind: 'joint' | 'force' | 'rod'; name: string } | null;
  /** Newtons of an arrow of one metre, newton metres of an arc of a quarter of a turn; 0: there are none. */
  readonly effortScale: { force: number; torque: number } | null;
  /** What is drawn of what a force exerts: where its arrow begins and ends, and the angle of its arc [rad]; null: no arrow, no arc, or the layer of forces is not shown. */
  effortDrawn(force: string): { from: Triple; to: Triple; angle: number } | null;
  /** Median of the last 120 pictures, milliseconds. */
  frameScriptTime(): number;
  /** Pictures since resetScriptTime. */
  framesDrawn(): number;
  resetScriptTime(): void;
  frameRate(): number;
  /** The picture as a data URL. */
  screenshot(): string | null;
}

declare global {
  interface Window {
    floatframe?: FloatframeInterface;
  }
}

export function offerInterface(view: ViewSection | null, problems: string[], channels: Channel[]): void {
  const shifted = (p: Triple): Triple => {
    const { origin } = view!.stage.scene;
    return [p[0] + origin[0], p[1] + origin[1], p[2] + origin[2]];
  };
  /** From the objects that are drawn: the matrix of the body's group. */
  const throughScene = (body: number, local: Triple): Triple => {
    const { group } = view!.stage.bodies[body];
    group.updateMatrix();
    const e = group.matrix.elements;
    const [x, y, z] = local;
    return [e[0] * x + e[4] * y + e[8] * z + e[12], e[1] * x + e[5] * y + e[9] * z + e[13], e[2] * x + e[6] * y + e[10] * z + e[14]];
  };
  window.floatframe = {
    ready: true,
    problems,
    get time() {
      return view?.player.time ?? 0;
    },
    setTime: (time) => {
      view?.player.pause();
      view?.player.set(time);
      view?.stage.draw(true);
    },
    bodies: (view?.stage.bodies ?? []).map((body) => ({
      name: body.data.name,
      get visible() {
        return body.group.visible;
      },
    })),
    worldPosition: (body, local, modes) => {
      if (!view?.stage.bodies[body]) return null;
      const { motion, deformation, scene } = view.stage;
      return shifted(throughScene(body, motion.deformed(scene.bodies[body], local, modes ?? null, deformation)));
    },
    vertexPosition: (body, vertex) => (view?.stage.bodies[body]?.data.mesh ? shifted(view.stage.vertexPosition(body, vertex)) : null),
    pointPosition: (index) => {
      const point = view?.stage.scene.points[index];
      return view && point ? shifted(view.stage.motion.pointPosition(point, view.stage.deformation)) : null;
    },
    pixelOf: ([x, y, z]) => {
      if (!view) return null;
      const { origin } = view.stage.scene;
      return view.stage.pixelOf(x - origin[0], y - origin[1], z - origin[2]);
    },
    channelValue: (name) => {
      const channel = channels.find((c) => c.name === name);
      return channel ? valueAt(channel.time, channel.values, view?.player.time ?? channel.time[0]) : NaN;
    },
    get scale() {
      return view?.stage.scale ?? 1;
    },
    setScale: (scale) => view?.display.setScale(scale),
    get mode() {
      return view?.modes?.chosen ?? null;
    },
    chooseMode: (row) => {
      if (view?.modes && row >= 0 && row < view.modes.count) view.modes.choose(row);
    },
    get selected() {
      return view?.stage.selected ?? null;
    },
    cameraTarget: () => view?.stage.controls.target.toArray() ?? null,
    get selectedPart() {
      const part = view?.stage.part;
      if (!view || !part) return null;
      const { joints, forces, rods } = view.stage.scene;
      return { kind: part.kind, name: { joint: joints, force: forces, rod: rods }[part.kind][part.index].name };
    },
    get effortScale() {
      return view?.stage.connections.effortScale ?? null;
    },
    effortDrawn: (name) => {
      const arrow = view?.stage.connections.arrows[view.stage.scene.forces.findIndex((force) => force.name === name)];
      const drawn = view?.stage.connections.layers.loads.visible ? arrow?.drawn() : null;
      return drawn ? { from: shifted(drawn.from), to: shifted(drawn.to), angle: drawn.angle } : null;
    },
    frameScriptTime: () => view?.scriptTime() ?? 0,
    framesDrawn: () => view?.pictures ?? 0,
    resetScriptTime: () => view?.resetScriptTime(),
    frameRate: () => view?.rate ?? 0,
    screenshot: () => view?.picture().toDataURL('image/png') ?? null,
  };
}
