// Joints, springs, dampers, tyres, rods and loads: placed from their points at each time.

import { Group, Mesh, Quaternion, Vector3, type Object3D } from 'three';
import type { ForceJson, JointJson } from '../data/page';
import type { SceneData, StrokeData } from '../data/scene_data';
import { valueAt } from '../data/series';
import type { Motion } from '../motion/motion';
import { rotate } from '../motion/rotation';
import { buildPlaceSymbol, isPlaceSymbol } from './element_symbols';
import { CUT_COLOUR, DAMPER_COLOUR, FORCE_COLOUR, GUIDE_COLOUR, JOINT_COLOUR, ROD_COLOUR, SPRING_COLOUR } from './palette';
import { Arrow, bar, buildJoint, buildTube, buildTyre, Coil, placeBar, plain, turnTo } from './symbols';

export interface History {
  time: ArrayLike<number>;
  values: ArrayLike<number>;
  largest: number;
}

export type Layer = 'joints' | 'springs' | 'tyres' | 'loads';

type Update = (motion: Motion, scale: number, time: number) => void;

const turned = new Quaternion();
const place = new Vector3();

export class Connections {
  readonly root = new Group();
  readonly layers: Record<Layer, Group> = { joints: new Group(), springs: new Group(), tyres: new Group(), loads: new Group() };
  /** What belongs to bodies that may be hidden. */
  private readonly owners: { object: Object3D; bodies: number[] }[] = [];
  private readonly updates: Update[] = [];
  private readonly scene: SceneData;
  private readonly size: number;

  constructor(scene: SceneData, modelSize: number, history: (channel: string) => History | null) {
    this.scene = scene;
    this.size = modelSize;
    for (const layer of Object.values(this.layers)) this.root.add(layer);
    for (const joint of scene.joints) this.addJoint(joint);
    for (const rod of scene.rods) this.addBar(rod.a, rod.b, 0.007 * modelSize, ROD_COLOUR, rod.name);
    for (const stroke of scene.strokes) this.addStroke(stroke);
    for (const force of scene.forces) this.addForce(force, force.channel ? history(force.channel) : null);
  }

  /** What couplings and constraints hold: pitch circles, strands, guides. */
  private addStroke(stroke: StrokeData): void {
    // Seen through bodies: boxes that stand for wheels would hide them.
    const material = plain(GUIDE_COLOUR);
    material.depthTest = false;
    material.transparent = true;
    material.opacity = 0.85;
    const mesh = new Mesh(buildTube(stroke.points, 0.004 * this.size), material);
    mesh.name = stroke.name;
    mesh.renderOrder = 4;
    const body = this.scene.points[stroke.a].body;
    this.own(mesh, 'springs', stroke.a);
    this.updates.push((motion, scale) => {
      mesh.position.set(...this.at(stroke.a, motion, scale));
      if (body >= 0) mesh.quaternion.fromArray(motion.quaternion, 4 * body);
    });
  }

  count(layer: Layer): number {
    return this.layers[layer].children.length;
  }

  update(motion: Motion, scale: number, time: number): void {
    for (const update of this.updates) update(motion, scale, time);
  }

  hideWith(visible: (body: number) => boolean): void {
    for (const { object, bodies } of this.owners) {
      const real = bodies.filter((body) => body >= 0);
      object.visible = real.length === 0 || real.some(visible);
    }
  }

  private at(index: number, motion: Motion, scale: number): [number, number, number] {
    return motion.pointPosition(this.scene.points[index], scale);
  }

  private own(object: Object3D, layer: Layer, ...points: number[]): void {
    // Its own visibility may be switched by the object (arrows), so that a holder is hidden instead.
    const holder = new Group();
    holder.add(object);
    this.layers[layer].add(holder);
    this.owners.push({ object: holder, bodies: points.filter((p) => p >= 0).map((p) => this.scene.points[p].body) });
  }

  private direction(axis: ArrayLike<number>, body: number, motion: Motion): [number, number, number] {
    return body < 0 ? [axis[0], axis[1], axis[2]] : rotate(motion.quaternion, 4 * body, axis[0], axis[1], axis[2]);
  }

  private addJoint(joint: JointJson): void {
    const material = plain(joint.cut ? CUT_COLOUR : JOINT_COLOUR);
    const symbol = buildJoint(joint.turns, joint.slides, 0.0135 * this.size, material);
    // Whoever checks a model looks for wrong axes: they are seen through bodies, and long.
    if (this.scene.kind === 'check') {
      const half = 0.06 * this.size;
      if (joint.axis) symbol.add(bar([0, 0, -half], [0, 0, half], 0.0025 * this.size, material));
      material.depthTest = false;
      material.transparent = true;
      material.opacity = 0.85;
      // Not of groups: their order stands above that of all that is drawn, names among it.
      symbol.traverse((object) => {
        if (!(object instanceof Group)) object.renderOrder = 6;
      });
    }
    const local = new Quaternion();
    if (joint.axis) turnTo(joint.axis, local);
    else if (joint.axes) local.set(...joint.axes);
    this.own(symbol, 'joints', joint.a, joint.b);
    const body = this.scene.points[joint.a].body;
    this.updates.push((motion, scale) => {
      symbol.position.set(...this.at(joint.a, motion, scale));
      if (body >= 0) turned.fromArray(motion.quaternion, 4 * body);
      else turned.identity();
      symbol.quaternion.copy(turned).multiply(local);
    });
  }

  private addBar(a: number, b: number, radius: number, colour: string, name: string): void {
    const mesh = bar([0, 0, 0], [0, 0, 1], radius, plain(colour));
    mesh.name = name;
    this.own(mesh, 'springs', a, b);
    this.updates.push((motion, scale) => placeBar(mesh, this.at(a, motion, scale), this.at(b, motion, scale), radius));
  }

  private addForce(force: ForceJson, history: History | null): void {
    if (force.picture === 'wheel') this.addTyre(force, history);
    else if (force.picture === 'torque') this.addLoad(force, history, 2);
    else if (force.picture === 'spring') this.addStrut(force);
    else if (isPlaceSymbol(force.picture)) this.addPlaceSymbol(force);
    else if (force.picture === 'force') this.addLoad(force, history, 1);
  }

  /** A coil about a telescope. */
  private addStrut(force: ForceJson): void {
    const start = this.length(force);
    const radius = Math.min(0.2 * start, 0.021 * this.size);
    if (!(radius > 0)) return;
    const group = new Group();
    const coil = new Coil(7, radius, 0.17 * radius, SPRING_COLOUR);
    const tube = bar([0, 0, 0], [0, 0, 1], 0.5 * radius, plain(DAMPER_COLOUR));
    const piston = bar([0, 0, 0], [0, 0, 1], 0.24 * radius, plain('#c9cfd6'));
    group.add(coil.mesh, tube, piston);
    this.own(group, 'springs', force.a, force.b);
    this.updates.push((motion, scale) => {
      const a = this.at(force.a, motion, scale);
      const b = this.at(force.b, motion, scale);
      coil.place(a, b);
      const length = Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
      const part = length > 0 ? Math.min(1, (0.55 * start) / length) : 0;
      const end: [number, number, number] = [a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]), a[2] + part * (b[2] - a[2])];
      placeBar(tube, a, end, 0.5 * radius);
      placeBar(piston, a, b, 0.24 * radius);
    });
  }

  private length(force: ForceJson): number {
    const motion = this.startMotion;
    const a = motion(force.a);
    const b = motion(force.b);
    return Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  }

  /** Place of a point in the first frame. */
  private startMotion = (index: number): [number, number, number] => {
    const point = this.scene.points[index];
    if (point.body < 0 || this.scene.time.length === 0) return [point.p[0], point.p[1], point.p[2]];
    const { pose } = this.scene;
    const at = 7 * point.body;
    const p = rotate(pose, at + 3, point.p[0], point.p[1], point.p[2]);
    return [p[0] + pose[at], p[1] + pose[at + 1], p[2] + pose[at + 2]];
  };

  private addPlaceSymbol(force: ForceJson): void {
    const symbol = buildPlaceSymbol(force.picture, 0.009 * this.size, force.radius ?? 0);
    const at = force.a >= 0 ? force.a : force.b;
    if (at < 0) return;
    const local = turnTo(force.axis ?? [0, 0, 1]);
    const body = this.scene.points[at].body;
    this.own(symbol, 'springs', force.a, force.b);
    this.updates.push((motion, scale) => {
      symbol.position.set(...this.at(at, motion, scale));
      if (body >= 0) turned.fromArray(motion.quaternion, 4 * body);
      else turned.identity();
      symbol.quaternion.copy(turned).multiply(local);
    });
  }

  private addTyre(force: ForceJson, history: History | null): void {
    if (force.a < 0) return;
    const radius = force.radius && force.radius > 0 ? force.radius : 0.05 * this.size;
    const tyre = buildTyre(radius, force.width && force.width > 0 ? force.width : 0.55 * radius);
    tyre.name = force.name;
    const body = this.scene.points[force.a].body;
    const local = turnTo(force.axis ?? [0, 1, 0]);
    this.own(tyre, 'tyres', force.a);
    this.updates.push((motion, scale) => {
      tyre.position.set(...this.at(force.a, motion, scale));
      if (body >= 0) turned.fromArray(motion.quaternion, 4 * body);
      else turned.identity();
      tyre.quaternion.copy(turned).multiply(local);
    });
    const up = this.scene.up;
    this.addArrow(force, history, 1, () => up, -radius);
  }

  private addLoad(force: ForceJson, history: History | null, heads: number): void {
    // A load acts on b; its axis turns with that body or stands in the world.
    const at = force.b >= 0 ? force.b : force.a;
    if (at < 0) return;
    const axis = force.axis ?? [0, 0, 1];
    const body = force.follows === false ? -1 : this.scene.points[at].body;
    this.addArrow({ ...force, a: at }, history, heads, (motion) => this.direction(axis, body, motion), 0);
  }

  private addArrow(force: ForceJson, history: History | null, heads: number, direction: (motion: Motion) => ArrayLike<number>, shift: number): void {
    const arrow = new Arrow(0.0045 * this.size, FORCE_COLOUR, heads);
    this.own(arrow.group, 'loads', force.a);
    this.updates.push((motion, scale, time) => {
      const d = direction(motion);
      const from = this.at(force.a, motion, scale);
      place.set(from[0] + shift * d[0], from[1] + shift * d[1], from[2] + shift * d[2]);
      let part = 0.6;
      if (history) {
        const value = valueAt(history.time, history.values, time);
        part = history.largest > 0 && Number.isFinite(value) ? value / history.largest : 0;
      }
      arrow.place([place.x, place.y, place.z], d, 0.2 * this.size * part);
    });
  }
}

