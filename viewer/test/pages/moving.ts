// Rigid bodies that move as formulas say: pages for the camera and for the shapes of bodies.

import type { BodyJson, ForceJson, PageJson, PointJson, Quadruple, ShapeJson, Triple } from '../../src/data/page';
import { BufferWriter, fillTemplate } from './writer';

export interface MovingBody {
  name: string;
  mass: number;
  shape: ShapeJson | null | ((writer: BufferWriter) => ShapeJson);
  /** Place and orientation at a time. */
  pose: (t: number) => [Triple, Quadruple];
}

export const UPRIGHT: Quadruple = [0, 0, 0, 1];

export function boxOf(size: Triple, position: Triple = [0, 0, 0]): ShapeJson {
  return { kind: 'box', size, position, quaternion: UPRIGHT };
}

/** Corners of a box in the world. */
export function cornersAt(size: Triple, [position, q]: [Triple, Quadruple]): Triple[] {
  return Array.from({ length: 8 }, (_, k) => {
    const v = size.map((x, i) => (((k >> i) & 1) - 0.5) * x);
    const [x, y, z, w] = q;
    const t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])];
    return [v[0] + w * t[0] + y * t[2] - z * t[1] + position[0], v[1] + w * t[1] + z * t[0] - x * t[2] + position[1], v[2] + w * t[2] + x * t[1] - y * t[0] + position[2]] as Triple;
  });
}

export function moving(html: string, bodies: MovingBody[], duration: number, more: { points?: PointJson[]; forces?: ForceJson[]; frames?: number } = {}): string {
  const writer = new BufferWriter();
  const frames = more.frames ?? 201;
  const time = Array.from({ length: frames }, (_, k) => (duration * k) / (frames - 1));
  const pose = time.flatMap((t) => bodies.flatMap((body) => body.pose(t).flat()));
  const page: PageJson = {
    schema: 1,
    kind: 'run',
    title: 'moving',
    program: 'floatframe',
    status: { state: 'completed', sentences: [], warnings: [] },
    facts: [],
    tables: [],
    curves: null,
    trust: null,
    speed: null,
    scene: {
      frames: { time: writer.view('f64', time), pose: writer.view('f32', pose, [frames, bodies.length, 7]), amplitudes: null },
      origin: [0, 0, 0],
      up: [0, 0, 1],
      bodies: bodies.map(({ name, mass, shape }): BodyJson => ({ name, mass, facts: [], modes: null, shape: typeof shape === 'function' ? shape(writer) : shape })),
      points: more.points ?? [],
      joints: [],
      forces: more.forces ?? [],
      rods: [],
      roads: [],
      gravity: [0, 0, -9.81],
    },
  };
  return fillTemplate(html, page, writer);
}
