// What a picture must hold, and where the camera stands for it.

import { Box3, type Matrix4, type PerspectiveCamera, Quaternion, Vector3 } from 'three';
import type { SceneData } from '../data/scene_data';
import { Motion } from '../motion/motion';
import type { BodyView } from './bodies';

/** Paths of the main body beyond so many sizes of the machine are followed. */
const LONG_PATH = 3;
/** Points of the ground so many sizes of the motion off are left out. */
const NEAR_GROUND = 1.5;
/** Places of all bodies over the frames that are looked at. */
const MOST_PLACES = 20_000;
const MOST_FRAMES = 150;

/** Balls in the axes of the view: x, y, z, radius of each. */
export class Cloud {
  private readonly values: number[] = [];
  private readonly moved = new Vector3();

  constructor(private readonly toView: Matrix4) {}

  get empty(): boolean {
    return this.values.length === 0;
  }

  add(x: number, y: number, z: number, radius = 0, shift?: Vector3): void {
    const p = this.moved.set(x, y, z).applyMatrix4(this.toView);
    if (shift) p.sub(shift);
    if (Number.isFinite(p.x + p.y + p.z + radius)) this.values.push(p.x, p.y, p.z, radius);
  }

  each(visit: (x: number, y: number, z: number, radius: number) => void): void {
    const { values } = this;
    for (let i = 0; i < values.length; i += 4) visit(values[i], values[i + 1], values[i + 2], values[i + 3]);
  }

  box(): Box3 {
    const box = new Box3();
    this.each((x, y, z, r) => {
      box.expandByPoint(this.moved.set(x - r, y - r, z - r));
      box.expandByPoint(this.moved.set(x + r, y + r, z + r));
    });
    return box;
  }
}

/** Where a camera that looks from a direction holds all of a cloud, its balls larger by `more`: the place it turns about, and its distance from there. */
export function frameOf(cloud: Cloud, from: Vector3, camera: PerspectiveCamera, margin: number, least: number, more = 0): { target: Vector3; distance: number } {
  const right = new Vector3().crossVectors(camera.up, from).normalize();
  const up = new Vector3().crossVectors(from, right).normalize();
  const tangent = Math.tan((camera.fov * Math.PI) / 360) / margin;
  const slopes = [tangent * camera.aspect, tangent];
  // A camera at c with the depth D holds a place p of depth z if |p - c| <= slope (D - z), in both directions across.
  const high = [-Infinity, -Infinity];
  const low = [-Infinity, -Infinity];
  let near = -Infinity;
  let far = Infinity;
  const p = new Vector3();
  cloud.each((x, y, z, radius) => {
    const r = radius + more;
    p.set(x, y, z);
    const depth = p.dot(from);
    [p.dot(right), p.dot(up)].forEach((across, i) => {
      const reach = slopes[i] * depth + r * Math.hypot(1, slopes[i]);
      high[i] = Math.max(high[i], across + reach);
      low[i] = Math.max(low[i], reach - across);
    });
    near = Math.max(near, depth + r);
    far = Math.min(far, depth - r);
  });
  const depth = Math.max((high[0] + low[0]) / (2 * slopes[0]), (high[1] + low[1]) / (2 * slopes[1]), near);
  const middle = (near + far) / 2;
  const target = new Vector3()
    .addScaledVector(right, (high[0] - low[0]) / 2)
    .addScaledVector(up, (high[1] - low[1]) / 2)
    .addScaledVector(from, middle);
  return { target, distance: Math.max(depth - middle, least) };
}

export interface Shown {
  scene: SceneData;
  bodies: BodyView[];
  deformation: number;
  size: number;
  tyres: boolean;
  strokes: boolean;
  /** From the world to the axes of the view. */
  toView: Matrix4;
}

/** Places of what is shown, at an instant or over the whole motion. */
export class Framing {
  constructor(private readonly shown: () => Shown) {}

  /** Of all frames; with `follow`, as seen by who goes with this body, which is now at `here`. */
  whole(follow: number, here: Vector3): Cloud {
    const shown = this.shown();
    const { scene } = shown;
    const motion = new Motion(scene);
    const cloud = new Cloud(shown.toView);
    const shift = new Vector3();
    for (const time of instantsOf(scene)) {
      motion.go(time);
      if (follow >= 0) shift.set(...motion.toWorld(follow, 0, 0, 0)).applyMatrix4(shown.toView).sub(here);
      this.addInstant(shown, motion, cloud, shift, null);
    }
    // Who follows sees the ground pass.
    if (follow < 0) this.addGround(shown, cloud);
    return cloud;
  }

  /** As it is now: all, or these bodies only. */
  present(motion: Motion, only: number[] | null): Cloud {
    const shown = this.shown();
    const cloud = new Cloud(shown.toView);
    this.addInstant(shown, motion, cloud, new Vector3(), only);
    if (!only) this.addGround(shown, cloud);
    return cloud;
  }

  private addInstant(shown: Shown, motion: Motion, cloud: Cloud, shift: Vector3, only: number[] | null): void {
    const { scene, bodies } = shown;
    const any = bodies.some((view) => view.group.visible);
    const held = (body: number): boolean => body >= 0 && (only ? only.includes(body) : bodies[body].group.visible || !any);
    for (const view of bodies) {
      const b = view.data.index;
      if (!held(b)) continue;
      const { min, max } = view.restBox;
      if (view.restBox.isEmpty()) cloud.add(...motion.toWorld(b, 0, 0, 0), 0, shift);
      else for (let k = 0; k < 8; ++k) cloud.add(...motion.toWorld(b, k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z), 0, shift);
    }
    for (const point of scene.points) if (held(point.body)) cloud.add(...motion.pointPosition(point, shown.deformation), 0, shift);
    if (shown.tyres) {
      for (const force of scene.forces) {
        if (force.picture !== 'wheel' || !force.radius || force.a < 0) continue;
        const point = scene.points[force.a];
        if (held(point.body)) cloud.add(...motion.pointPosition(point, shown.deformation), force.radius, shift);
      }
    }
    if (!shown.strokes) return;
    for (const { a, points } of scene.strokes) {
      const { body } = scene.points[a];
      if (!held(body)) continue;
      const local = new Box3().setFromArray(points);
      const from = motion.pointPosition(scene.points[a], shown.deformation);
      const turned = new Quaternion().fromArray(motion.quaternion, 4 * body);
      const p = new Vector3();
      for (let k = 0; k < 8; ++k) {
        p.set(k & 1 ? local.max.x : local.min.x, k & 2 ? local.max.y : local.min.y, k & 4 ? local.max.z : local.min.z).applyQuaternion(turned);
        cloud.add(from[0] + p.x, from[1] + p.y, from[2] + p.z, 0, shift);
      }
    }
  }

  /** Points of the ground, and lines fixed to it: ends of what is drawn from a body to there, others near the motion only, all for who checks a model. */
  private addGround(shown: Shown, cloud: Cloud): void {
    const { scene } = shown;
    const near = cloud.box();
    const anywhere = scene.kind === 'check' || cloud.empty;
    if (!cloud.empty) near.expandByScalar(NEAR_GROUND * near.getSize(new Vector3()).length());
    const ends = new Set<number>();
    for (const { a, b } of [...scene.rods, ...scene.forces.filter((force) => force.picture === 'spring')]) if (a >= 0 && b >= 0 && scene.points[a].body + scene.points[b].body > -2) ends.add(a).add(b);
    const p = new Vector3();
    const add = (x: number, y: number, z: number): void => {
      if (anywhere || near.containsPoint(p.set(x, y, z).applyMatrix4(shown.toView))) cloud.add(x, y, z);
    };
    scene.points.forEach((point, k) => {
      if (point.body !== -1) return;
      if (ends.has(k)) cloud.add(...point.p);
      else add(...point.p);
    });
    if (!shown.strokes) return;
    for (const { a, points } of scene.strokes) {
      const at = scene.points[a];
      if (at.body !== -1) continue;
      for (let i = 0; i < points.length; i += 3) add(at.p[0] + points[i], at.p[1] + points[i + 1], at.p[2] + points[i + 2]);
    }
  }
}

/** Instants that stand for the whole motion. */
function instantsOf(scene: SceneData): number[] {
  const n = scene.time.length;
  if (n === 0) return [0];
  const count = Math.max(2, Math.min(n, MOST_FRAMES, Math.floor(MOST_PLACES / scene.bodies.length)));
  return n === 1 ? [scene.time[0]] : Array.from({ length: count }, (_, k) => scene.time[Math.round((k * (n - 1)) / (count - 1))]);
}

/** The heaviest body where its path is long beside the machine, which is followed; else -1. */
export function travelling(scene: SceneData, size: number): number {
  if (scene.time.length < 2) return -1;
  const heaviest = scene.bodies.reduce((best, body) => ((body.mass ?? 0) > (scene.bodies[best].mass ?? 0) ? body.index : best), 0);
  const path = new Box3();
  const p = new Vector3();
  const stride = 7 * scene.bodies.length;
  for (let f = 0; f < scene.time.length; ++f) path.expandByPoint(p.fromArray(scene.pose, f * stride + 7 * heaviest));
  return path.getSize(p).length() > LONG_PATH * size ? heaviest : -1;
}
