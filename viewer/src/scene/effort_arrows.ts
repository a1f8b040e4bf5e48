// Arrows of forces and arcs of torques, as large as what they stand for: one scale for the whole page and all instants.

import { BufferAttribute, BufferGeometry, ConeGeometry, Group, Mesh, MeshPhongMaterial, TorusGeometry, Vector3, type IUniform } from 'three';
import type { Efforts } from '../data/efforts';
import { niceAbove } from '../data/format';
import type { Triple } from '../data/page';
import type { SceneData } from '../data/scene_data';
import { FORCE_COLOUR, TORQUE_COLOUR } from './palette';
import { Arrow, turnTo } from './symbols';

export interface EffortScale {
  /** Newtons that are drawn as one metre; 0: there are no forces. */
  force: number;
  /** Newton metres that are drawn as a quarter of a turn; 0: there are no torques. */
  torque: number;
}

/** A part of the largest effort below which it is rounding. */
const ROUNDING = 1e-9;
/** Lengths over the size of the model: of what is seldom exceeded, and of the largest. */
const USUAL_LENGTH = 0.2;
const LARGEST_LENGTH = 0.7;
const USUAL_ANGLE = (5 / 6) * Math.PI;
const LARGEST_ANGLE = (11 / 6) * Math.PI;

interface Sizes {
  usual: number;
  largest: number;
}

/** Of the vectors in three columns over all frames: 95 % of the instants are below `usual`. */
function sizesOf(efforts: Efforts, [x, y, z]: number[]): Sizes {
  const sizes = new Float64Array(efforts.frames);
  let count = 0;
  for (let f = 0; f < efforts.frames; ++f) {
    const size = Math.hypot(efforts.atFrame(x, f), efforts.atFrame(y, f), efforts.atFrame(z, f));
    if (Number.isFinite(size)) sizes[count++] = size;
  }
  const sorted = sizes.subarray(0, count).sort();
  return count > 0 ? { usual: sorted[Math.floor(0.95 * (count - 1))], largest: sorted[count - 1] } : { usual: 0, largest: 0 };
}

function together(list: Sizes[]): Sizes {
  const sum = { usual: 0, largest: 0 };
  for (const { usual, largest } of list) {
    sum.usual = Math.max(sum.usual, usual);
    sum.largest = Math.max(sum.largest, largest);
  }
  return sum;
}

/** What one unit of a drawing stands for: what is usual is drawn `usual` large, nothing larger than `largest`. */
function unitOf(sizes: Sizes, usual: number, largest: number, noise: number): number {
  if (!(sizes.largest > noise)) return 0;
  return niceAbove(Math.max(sizes.usual / usual, sizes.largest / largest));
}

export function effortScale(scene: SceneData, size: number): EffortScale {
  const { efforts } = scene;
  if (!efforts) return { force: 0, torque: 0 };
  const wrenches = scene.forces.filter((force) => force.wrench);
  const forces = together(wrenches.map((force) => sizesOf(efforts, force.wrench!.columns)));
  // The torque of a tyre is drawn by where its force begins.
  const torques = together(wrenches.filter((force) => force.picture !== 'wheel').map((force) => sizesOf(efforts, force.wrench!.columns.slice(3))));
  const weight = 9.81 * scene.bodies.reduce((sum, body) => sum + (body.mass ?? 0), 0);
  const noise = ROUNDING * Math.max(weight, forces.largest, torques.largest / size);
  return {
    force: unitOf(forces, USUAL_LENGTH * size, LARGEST_LENGTH * size, noise),
    torque: unitOf(torques, USUAL_ANGLE / (Math.PI / 2), LARGEST_ANGLE / (Math.PI / 2), noise * size),
  };
}

/** A part of a circle with a head, about a direction; its angle is a uniform. */
class Arc {
  readonly group = new Group();
  /** A ring in its place, never drawn, that takes clicks. */
  readonly ring: Mesh;
  private readonly angle: IUniform<number> = { value: 0 };
  private readonly head: Mesh;

  constructor(private readonly radius: number, private readonly tube: number, colour: string) {
    const along = 72;
    const around = 8;
    const position = new Float32Array(3 * (along + 1) * (around + 1));
    const index: number[] = [];
    for (let i = 0, n = 0; i <= along; ++i) {
      for (let k = 0; k <= around; ++k, ++n) position.set([i / along, (2 * Math.PI * k) / around, 0], 3 * n);
    }
    for (let i = 0; i < along; ++i) {
      for (let k = 0; k < around; ++k) {
        const a = i * (around + 1) + k;
        const b = a + around + 1;
        index.push(a, a + 1, b, b, a + 1, b + 1);
      }
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(position, 3));
    geometry.setAttribute('normal', new BufferAttribute(new Float32Array(position.length), 3));
    geometry.setIndex(index);
    const look = { color: colour, emissive: colour, emissiveIntensity: 0.25, transparent: true, opacity: 0.9, depthTest: false };
    const material = new MeshPhongMaterial(look);
    material.onBeforeCompile = (shader) => {
      shader.uniforms.arcAngle = this.angle;
      shader.uniforms.arcShape = { value: [radius, tube] };
      const arc = `
        uniform float arcAngle;
        uniform vec2 arcShape;
        void arcPlace(out vec3 place, out vec3 outward) {
          float a = arcAngle * position.x;
          vec3 radial = vec3(cos(a), sin(a), 0.0);
          outward = cos(position.y) * radial + vec3(0.0, 0.0, sin(position.y));
          place = arcShape.x * radial + arcShape.y * outward;
        }
      `;
      shader.vertexShader =
        arc +
        shader.vertexShader
          .replace('#include <beginnormal_vertex>', 'vec3 arcAt; vec3 objectNormal; arcPlace(arcAt, objectNormal);')
          .replace('#include <begin_vertex>', 'vec3 transformed = arcAt;');
    };
    material.customProgramCacheKey = () => 'arc';
    const mesh = new Mesh(geometry, material);
    mesh.frustumCulled = false;
    this.head = new Mesh(new ConeGeometry(2.6 * tube, 7 * tube, 16), new MeshPhongMaterial(look));
    this.ring = new Mesh(new TorusGeometry(radius, 3 * tube, 6, 32), material);
    this.ring.visible = false;
    this.ring.userData.takesClicks = true;
    this.group.add(mesh, this.head, this.ring);
    mesh.renderOrder = this.head.renderOrder = 5;
  }

  place(at: ArrayLike<number>, axis: ArrayLike<number>, angle: number): void {
    this.group.position.set(at[0], at[1], at[2]);
    turnTo(axis, this.group.quaternion);
    this.angle.value = angle;
    // The head points along the circle, its tip at the end of the angle; it is smaller on a short arc.
    const half = (3.5 * this.tube) / this.radius;
    const part = Math.min(1, angle / (4 * half));
    const middle = angle - part * half;
    this.head.position.set(this.radius * Math.cos(middle), this.radius * Math.sin(middle), 0);
    this.head.rotation.set(0, 0, middle);
    this.head.scale.setScalar(part);
  }
}

const straight = new Vector3();

/** The wrench on one body: an arrow for its force, an arc for its torque. */
export class EffortArrow {
  readonly group = new Group();
  private readonly arrow: Arrow | null;
  private readonly arc: Arc | null;
  private readonly scale: EffortScale;
  private readonly size: number;
  private length = 0;
  private angle = 0;

  constructor(scale: EffortScale, size: number, withTorque: boolean) {
    this.scale = scale;
    this.size = size;
    this.arrow = scale.force > 0 ? new Arrow(0.0045 * size, FORCE_COLOUR) : null;
    this.arc = withTorque && scale.torque > 0 ? new Arc(0.05 * size, 0.0035 * size, TORQUE_COLOUR) : null;
    if (this.arrow) this.group.add(this.arrow.group);
    if (this.arc) this.group.add(this.arc.group);
  }

  /** Ends of the arrow in the world and the angle of the arc, as they are drawn; null: neither is. */
  drawn(): { from: Triple; to: Triple; angle: number } | null {
    if (this.length === 0 && this.angle === 0) return null;
    const { position, quaternion } = (this.length > 0 ? this.arrow! : this.arc!).group;
    const to = straight.set(0, 0, this.length).applyQuaternion(quaternion).add(position);
    return { from: position.toArray(), to: to.toArray(), angle: this.angle };
  }

  /** Force and torque [N, N m] in world axes; what is no number is not drawn. */
  place(at: ArrayLike<number>, wrench: ArrayLike<number>): void {
    const force = Math.hypot(wrench[0], wrench[1], wrench[2]);
    const torque = Math.hypot(wrench[3], wrench[4], wrench[5]);
    this.length = this.arrow && Number.isFinite(force) ? force / this.scale.force : 0;
    if (!(this.length > 1e-3 * this.size)) this.length = 0;
    this.angle = this.arc && Number.isFinite(torque) ? ((Math.PI / 2) * torque) / this.scale.torque : 0;
    if (!(this.angle > 0.01)) this.angle = 0;
    if (this.arrow) this.arrow.group.visible = this.length > 0;
    if (this.arc) this.arc.group.visible = this.angle > 0;
    if (this.length > 0) this.arrow!.place(at, wrench, this.length);
    if (this.angle > 0) this.arc!.place(at, [wrench[3], wrench[4], wrench[5]], this.angle);
  }
}
