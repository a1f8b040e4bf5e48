// Shapes of joints, springs, dampers, tyres, rods and arrows. All lie along z or have z as their axis.

import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  CatmullRomCurve3,
  ConeGeometry,
  CylinderGeometry,
  Group,
  LatheGeometry,
  Mesh,
  MeshPhongMaterial,
  OctahedronGeometry,
  Quaternion,
  SphereGeometry,
  TorusGeometry,
  TubeGeometry,
  Vector2,
  Vector3,
  type IUniform,
  type Material,
} from 'three';
import { mergeGeometries } from 'three/addons/utils/BufferGeometryUtils.js';
import type { Triple } from '../data/page';
import { RIM_COLOUR, TYRE_COLOUR } from './palette';

const Z = new Vector3(0, 0, 1);
const along = new Vector3();

/** The shortest turn of the z axis to a direction. */
export function turnTo(direction: ArrayLike<number>, out = new Quaternion()): Quaternion {
  along.set(direction[0], direction[1], direction[2]);
  if (along.lengthSq() === 0) return out.identity();
  return out.setFromUnitVectors(Z, along.normalize());
}

export function plain(colour: string): MeshPhongMaterial {
  return new MeshPhongMaterial({ color: colour, specular: '#22262b', shininess: 40 });
}

function upright(geometry: BufferGeometry): BufferGeometry {
  return geometry.rotateX(Math.PI / 2);
}

const unitCylinder = upright(new CylinderGeometry(1, 1, 1, 20));

/** A cylinder between two places. */
export function bar(from: Triple, to: Triple, radius: number, material: Material): Mesh {
  const mesh = new Mesh(unitCylinder, material);
  placeBar(mesh, from, to, radius);
  return mesh;
}

export function placeBar(mesh: Mesh, from: ArrayLike<number>, to: ArrayLike<number>, radius: number): void {
  const d = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
  mesh.position.set((from[0] + to[0]) / 2, (from[1] + to[1]) / 2, (from[2] + to[2]) / 2);
  mesh.scale.set(radius, radius, Math.max(Math.hypot(d[0], d[1], d[2]), 1e-9));
  turnTo(d, mesh.quaternion);
}

/** A coil whose wire keeps its thickness while it stretches: its length is a uniform. */
export class Coil {
  readonly mesh: Mesh;
  private readonly length: IUniform<number> = { value: 1 };

  constructor(turns: number, radius: number, wire: number, colour: string) {
    const along = turns * 28;
    const around = 7;
    const position = new Float32Array(3 * (along + 1) * (around + 1));
    const index: number[] = [];
    for (let i = 0, n = 0; i <= along; ++i) {
      for (let k = 0; k <= around; ++k, ++n) position.set([i / along, (2 * Math.PI * k) / around, 0], 3 * n);
    }
    for (let i = 0; i < along; ++i) {
      for (let k = 0; k < around; ++k) {
        const a = i * (around + 1) + k;
        const b = a + around + 1;
        index.push(a, b, a + 1, b, b + 1, a + 1);
      }
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(position, 3));
    geometry.setAttribute('normal', new BufferAttribute(new Float32Array(position.length), 3));
    geometry.setIndex(index);
    const material = plain(colour);
    material.onBeforeCompile = (shader) => {
      shader.uniforms.coilLength = this.length;
      shader.uniforms.coilShape = { value: [turns, radius, wire] };
      const coil = `
        uniform float coilLength;
        uniform vec3 coilShape;
        void coilPlace(out vec3 place, out vec3 outward) {
          // Flat ends: the first and the last turn do not climb.
          float t = position.x;
          float angle = 6.2831853 * coilShape.x * t;
          float flatEnd = 0.5 / coilShape.x;
          float climb = clamp((t - flatEnd) / (1.0 - 2.0 * flatEnd), 0.0, 1.0);
          vec2 radial = vec2(cos(angle), sin(angle));
          outward = vec3(radial * cos(position.y), sin(position.y));
          place = vec3(coilShape.y * radial, coilShape.z + (coilLength - 2.0 * coilShape.z) * climb) + coilShape.z * outward;
        }
      `;
      shader.vertexShader =
        coil +
        shader.vertexShader
          .replace('#include <beginnormal_vertex>', 'vec3 coilAt; vec3 objectNormal; coilPlace(coilAt, objectNormal);')
          .replace('#include <begin_vertex>', 'vec3 transformed = coilAt;');
    };
    material.customProgramCacheKey = () => 'coil';
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
  }

  place(from: ArrayLike<number>, to: ArrayLike<number>): void {
    const d = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
    this.length.value = Math.hypot(d[0], d[1], d[2]);
    this.mesh.position.set(from[0], from[1], from[2]);
    turnTo(d, this.mesh.quaternion);
  }
}

/** A tyre with its rim, spoked so that its turning is seen; its axis is z. */
export function buildTyre(radius: number, width: number): Group {
  const group = new Group();
  const half = width / 2;
  const inner = 0.6 * radius;
  const round = Math.min(0.35 * width, 0.5 * (radius - inner));
  const profile: Vector2[] = [new Vector2(inner, -0.8 * half)];
  const corner = (x: number, y: number, from: number): void => {
    for (let i = 0; i <= 6; ++i) {
      const angle = from + ((Math.PI / 2) * i) / 6;
      profile.push(new Vector2(x + round * Math.cos(angle), y + round * Math.sin(angle)));
    }
  };
  corner(radius - round, -half + round, -Math.PI / 2);
  corner(radius - round, half - round, 0);
  profile.push(new Vector2(inner, 0.8 * half));
  const rubber: BufferGeometry[] = [upright(new LatheGeometry(profile, 56))];
  // Blocks of the tread.
  for (let i = 0; i < 32; ++i) {
    const angle = (2 * Math.PI * i) / 32;
    rubber.push(new BoxGeometry(0.04 * radius, 0.07 * radius, 0.84 * width).translate(0.985 * radius, 0, 0).rotateZ(angle));
  }
  const rim: BufferGeometry[] = [upright(new CylinderGeometry(0.2 * radius, 0.2 * radius, 0.5 * width, 24))];
  const ring = new TorusGeometry(inner, 0.05 * radius, 10, 48);
  rim.push(ring.scale(1, 1, Math.max(1, (0.7 * half) / (0.05 * radius))));
  for (let i = 0; i < 5; ++i) {
    const angle = (2 * Math.PI * i) / 5;
    rim.push(new BoxGeometry(0.92 * inner, 0.16 * radius, 0.22 * width).translate(0.5 * inner, 0, 0).rotateZ(angle));
  }
  group.add(new Mesh(mergeGeometries(rubber), plain(TYRE_COLOUR)), new Mesh(mergeGeometries(rim), plain(RIM_COLOUR)));
  return group;
}

/** The sign of a joint by what it leaves free: so many turns and slides. Its radius is about `size`. */
export function buildJoint(turns: number, slides: number, size: number, material: Material): Group {
  const group = new Group();
  const add = (geometry: BufferGeometry): Mesh => {
    const mesh = new Mesh(geometry, material);
    group.add(mesh);
    return mesh;
  };
  const pin = (length: number, radius: number): Mesh => add(upright(new CylinderGeometry(radius, radius, length, 20)));
  if (turns === 1 && slides === 0) {
    pin(3.4 * size, 0.3 * size);
    pin(1.5 * size, 0.75 * size);
  } else if (turns === 1 && slides === 1) {
    pin(4.4 * size, 0.3 * size);
    pin(1.8 * size, 0.65 * size);
  } else if (turns === 0 && slides === 1) {
    pin(4.4 * size, 0.26 * size);
    add(new BoxGeometry(1.2 * size, 1.2 * size, 1.8 * size));
  } else if (turns === 2 && slides === 0) {
    pin(2.6 * size, 0.3 * size);
    add(new CylinderGeometry(0.3 * size, 0.3 * size, 2.6 * size, 20));
    add(new SphereGeometry(0.5 * size, 20, 14));
  } else if (turns === 3 && slides === 0) {
    add(new SphereGeometry(0.8 * size, 24, 16));
  } else if (turns === 0 && slides === 0) {
    add(new BoxGeometry(1.2 * size, 1.2 * size, 1.2 * size));
  } else if (slides === 2) {
    add(new BoxGeometry(2.6 * size, 2.6 * size, 0.2 * size));
  } else {
    add(new OctahedronGeometry(0.9 * size));
  }
  return group;
}

/** An arrow along z, to be scaled. */
export class Arrow {
  readonly group = new Group();
  private readonly shaft: Mesh;
  private readonly head: Mesh;

  constructor(private readonly radius: number, colour: string) {
    const material = new MeshPhongMaterial({ color: colour, emissive: colour, emissiveIntensity: 0.25, transparent: true, opacity: 0.9, depthTest: false });
    this.shaft = new Mesh(unitCylinder, material);
    this.head = new Mesh(upright(new ConeGeometry(2.4 * radius, 6 * radius, 20)), material);
    this.group.add(this.shaft, this.head);
    this.shaft.renderOrder = this.head.renderOrder = 5;
  }

  /** From a place, in a direction of any length. A short arrow is thinner, its proportions stay. */
  place(from: ArrayLike<number>, direction: ArrayLike<number>, length: number): void {
    this.group.position.set(from[0], from[1], from[2]);
    turnTo(direction, this.group.quaternion);
    const part = Math.min(1, length / (14 * this.radius));
    const head = 6 * this.radius * part;
    this.shaft.scale.set(part * this.radius, part * this.radius, Math.max(length - head, 1e-9));
    this.shaft.position.z = (length - head) / 2;
    this.head.scale.setScalar(part);
    this.head.position.z = length - head / 2;
  }
}

/** A tube along a line of straights: x, y, z of each place. */
export function buildTube(points: ArrayLike<number>, radius: number): BufferGeometry {
  const places: Vector3[] = [];
  for (let i = 0; i + 2 < points.length; i += 3) {
    const p = new Vector3(points[i], points[i + 1], points[i + 2]);
    if (places.length === 0 || p.distanceToSquared(places[places.length - 1]) > 1e-16) places.push(p);
  }
  if (places.length < 2) return new BufferGeometry();
  // No tension: the curve keeps to the straights.
  return new TubeGeometry(new CatmullRomCurve3(places, false, 'catmullrom', 0), Math.max(2 * places.length, 16), radius, 6);
}

/** Three bars for the axes of a frame. */
export function buildTriad(size: number): Group {
  const group = new Group();
  const ends: [Triple, string][] = [
    [[size, 0, 0], '#d5453b'],
    [[0, size, 0], '#3d9a50'],
    [[0, 0, size], '#3f7fc4'],
  ];
  for (const [end, colour] of ends) {
    const material = plain(colour);
    group.add(bar([0, 0, 0], end, 0.035 * size, material));
    const tip = new Mesh(upright(new ConeGeometry(0.09 * size, 0.25 * size, 14)), material);
    tip.position.set(...end);
    turnTo(end, tip.quaternion);
    group.add(tip);
  }
  return group;
}

