// Joints, springs, dampers, tyres, rods and what they exert: placed from their points at each time.

import { Color, Group, Mesh, MeshPhongMaterial, Quaternion, type Object3D } from 'three';
import type { ForceJson, JointJson } from '../data/page';
import type { SceneData, StrokeData } from '../data/scene_data';
import type { Motion } from '../motion/motion';
import { rotate } from '../motion/rotation';
import { EffortArrow, effortScale, type EffortScale } from './effort_arrows';
import { buildPlaceSymbol, isPlaceSymbol } from './element_symbols';
import { CUT_COLOUR, DAMPER_COLOUR, GUIDE_COLOUR, JOINT_COLOUR, ROD_COLOUR, SPRING_COLOUR } from './palette';
import { bar, buildJoint, buildTube, buildTyre, Coil, placeBar, plain, turnTo } from './symbols';

/** A joint, force or rod, by its place in the scene. */
export interface Part {
  kind: 'joint' | 'force' | 'rod';
  index: number;
}

export type Layer = 'joints' | 'springs' | 'tyres' | 'loads';

type Update = (motion: Motion, scale: number) => void;

const turned = new Quaternion();
const CHOSEN = new Color('#2f81c7');

export class Connections {
  readonly root = new Group();
  readonly layers: Record<Layer, Group> = { joints: new Group(), springs: new Group(), tyres: new Group(), loads: new Group() };
  readonly effortScale: EffortScale;
  /** What the forces of the scene exert, by their places; null: that is not known. */
  readonly arrows: (EffortArrow | null)[] = [];
  /** What belongs to bodies that may be hidden. */
  private readonly owners: { object: Object3D; bodies: number[]; part: Part | null }[] = [];
  private readonly updates: Update[] = [];
  private readonly wrench = new Float64Array(6);
  private readonly scene: SceneData;
  private readonly size: number;

  constructor(scene: SceneData, modelSize: number) {
    this.scene = scene;
    this.size = modelSize;
    this.effortScale = effortScale(scene, modelSize);
    for (const layer of Object.values(this.layers)) this.root.add(layer);
    scene.joints.forEach((joint, index) => this.addJoint(joint, { kind: 'joint', index }));
    scene.rods.forEach((rod, index) => this.addBar(rod.a, rod.b, 0.007 * modelSize, { kind: 'rod', index }));
    for (const stroke of scene.strokes) this.addStroke(stroke);
    scene.forces.forEach((force, index) => {
      this.addForce(force, { kind: 'force', index });
      this.arrows.push(this.addArrow(force, { kind: 'force', index }));
    });
  }

  /** What is drawn and takes clicks, with what it is. */
  picked(): { object: Object3D; part: Part }[] {
    const shown = (object: Object3D): boolean => object.visible && (object === this.root || object.parent === null || shown(object.parent));
    return this.owners.flatMap(({ object, part }) => (part && shown(object) ? [{ object, part }] : []));
  }

  /** Lights what belongs to a part, and nothing else. */
  choose(chosen: Part | null): void {
    for (const { object, part } of this.owners) {
      const on = chosen !== null && part?.kind === chosen.kind && part.index === chosen.index;
      object.traverse((mesh) => {
        const material = mesh instanceof Mesh && mesh.visible ? (mesh.material as unknown) : null;
        if (!(material instanceof MeshPhongMaterial)) return;
        const own = (material.userData.own ??= { colour: material.emissive.clone(), intensity: material.emissiveIntensity }) as { colour: Color; intensity: number };
        material.emissive.copy(on ? CHOSEN : own.colour);
        material.emissiveIntensity = on ? 0.6 : own.intensity;
      });
    }
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
    const index = this.scene.forces.findIndex((force) => force.name === stroke.name);
    this.own(mesh, 'springs', index >= 0 ? { kind: 'force', index } : null, stroke.a);
    this.updates.push((motion, scale) => {
      mesh.position.set(...this.at(stroke.a, motion, scale));
      if (body >= 0) mesh.quaternion.fromArray(motion.quaternion, 4 * body);
    });
  }

  count(layer: Layer): number {
    return this.layers[layer].children.length;
  }

  update(motion: Motion, scale: number): void {
    for (const update of this.updates) update(motion, scale);
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

  private own(object: Object3D, layer: Layer, part: Part | null, ...points: number[]): void {
    // Its own visibility may be switched by the object (arrows), so that a holder is hidden instead.
    const holder = new Group();
    holder.add(object);
    this.layers[layer].add(holder);
    this.owners.push({ object: holder, part, bodies: points.filter((p) => p >= 0).map((p) => this.scene.points[p].body) });
  }

  private addJoint(joint: JointJson, part: Part): void {
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
    this.own(symbol, 'joints', part, joint.a, joint.b);
    const body = this.scene.points[joint.a].body;
    this.updates.push((motion, scale) => {
      symbol.position.set(...this.at(joint.a, motion, scale));
      if (body >= 0) turned.fromArray(motion.quaternion, 4 * body);
      else turned.identity();
      symbol.quaternion.copy(turned).multiply(local);
    });
  }

  private addBar(a: number, b: number, radius: number, part: Part): void {
    const mesh = bar([0, 0, 0], [0, 0, 1], radius, plain(ROD_COLOUR));
    mesh.name = this.scene.rods[part.index].name;
    this.own(mesh, 'springs', part, a, b);
    this.updates.push((motion, scale) => placeBar(mesh, this.at(a, motion, scale), this.at(b, motion, scale), radius));
  }

  private addForce(force: ForceJson, part: Part): void {
    if (force.picture === 'wheel') this.addTyre(force, part);
    else if (force.picture === 'spring') this.addStrut(force, part);
    else if (isPlaceSymbol(force.picture)) this.addPlaceSymbol(force, part);
  }

  /** A coil about a telescope. */
  private addStrut(force: ForceJson, part: Part): void {
    const start = this.length(force);
    const radius = Math.min(0.2 * start, 0.021 * this.size);
    if (!(radius > 0)) return;
    const group = new Group();
    const coil = new Coil(7, radius, 0.17 * radius, SPRING_COLOUR);
    const tube = bar([0, 0, 0], [0, 0, 1], 0.5 * radius, plain(DAMPER_COLOUR));
    const piston = bar([0, 0, 0], [0, 0, 1], 0.24 * radius, plain('#c9cfd6'));
    // The coil takes its shape in the shader: a bar of its size takes its clicks.
    const hull = bar([0, 0, 0], [0, 0, 1], radius, coil.mesh.material as MeshPhongMaterial);
    hull.visible = false;
    hull.userData.takesClicks = true;
    coil.mesh.raycast = () => {};
    group.add(coil.mesh, tube, piston, hull);
    this.own(group, 'springs', part, force.a, force.b);
    this.updates.push((motion, scale) => {
      const a = this.at(force.a, motion, scale);
      const b = this.at(force.b, motion, scale);
      coil.place(a, b);
      const length = Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
      const part = length > 0 ? Math.min(1, (0.55 * start) / length) : 0;
      const end: [number, number, number] = [a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]), a[2] + part * (b[2] - a[2])];
      placeBar(tube, a, end, 0.5 * radius);
      placeBar(piston, a, b, 0.24 * radius);
      placeBar(hull, a, b, 1.17 * radius);
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

  private addPlaceSymbol(force: ForceJson, part: Part): void {
    const symbol = buildPlaceSymbol(force.picture, 0.009 * this.size, force.radius ?? 0);
    const at = force.a >= 0 ? force.a : force.b;
    if (at < 0) return;
    const local = turnTo(force.axis ?? [0, 0, 1]);
    const body = this.scene.points[at].body;
    this.own(symbol, 'springs', part, force.a, force.b);
    this.updates.push((motion, scale) => {
      symbol.position.set(...this.at(at, motion, scale));
      if (body >= 0) turned.fromArray(motion.quaternion, 4 * body);
      else turned.identity();
      symbol.quaternion.copy(turned).multiply(local);
    });
  }

  private tyreRadius(force: ForceJson): number {
    return force.radius && force.radius > 0 ? force.radius : 0.05 * this.size;
  }

  private addTyre(force: ForceJson, part: Part): void {
    if (force.a < 0) return;
    const radius = this.tyreRadius(force);
    const tyre = buildTyre(radius, force.width && force.width > 0 ? force.width : 0.55 * radius);
    tyre.name = force.name;
    const body = this.scene.points[force.a].body;
    const local = turnTo(force.axis ?? [0, 1, 0]);
    this.own(tyre, 'tyres', part, force.a);
    this.updates.push((motion, scale) => {
      tyre.position.set(...this.at(force.a, motion, scale));
      if (body >= 0) turned.fromArray(motion.quaternion, 4 * body);
      else turned.identity();
      tyre.quaternion.copy(turned).multiply(local);
    });
  }

  /** What a force exerts on one of its bodies, at the point where it acts; that of a tyre below its hub, where it touches the road. */
  private addArrow(force: ForceJson, part: Part): EffortArrow | null {
    const { efforts, up } = this.scene;
    const { wrench } = force;
    if (!efforts || !wrench) return null;
    const wheel = force.picture === 'wheel';
    const arrow = new EffortArrow(this.effortScale, this.size, !wheel);
    const below = wheel ? this.tyreRadius(force) / Math.hypot(...up) : 0;
    this.own(arrow.group, 'loads', part, wrench.at);
    this.updates.push((motion, scale) => {
      for (let i = 0; i < 6; ++i) this.wrench[i] = efforts.between(wrench.columns[i], motion.frame, motion.part);
      const p = this.at(wrench.at, motion, scale);
      for (let i = 0; i < 3; ++i) p[i] -= below * up[i];
      arrow.place(p, this.wrench);
    });
    return arrow;
  }
}
