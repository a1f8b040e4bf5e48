// A page with forces and torques whose numbers are known at each frame, and with glass before what is solid.

import type { ForceJson, JointJson, PageJson } from '../../src/data/page';
import { BufferWriter } from './writer';

/** Of `push` in x, y, z [N] at 0, 1, 2, ... s; NaN: it has no value. */
export const PUSHES: [number, number, number][] = [[0, 0, 0], [0, 0, 10], [0, 0, 20], [NaN, NaN, NaN], [20, 0, 0], [0, 0, -20]];
/** Of `twist` about y [N m]. */
export const TWISTS = [0, 1, 2, NaN, -2, 0];
export const SPRING_LENGTHS = [0.5, 0.6, 0.7, 0.8, 0.9, 1];
export const ANGLES = [0, Math.PI / 6, Math.PI / 3, Math.PI / 2, 2, 8];

export function efforts(): { page: PageJson; writer: BufferWriter } {
  const writer = new BufferWriter();
  const frames = PUSHES.length;
  const half = 0.15;
  const corners = Array.from({ length: 8 }, (_, k) => [k & 1 ? half : -half, k & 2 ? half : -half, k & 4 ? half : -half]);
  const faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]].flatMap(([a, b, c, d]) => [a, b, c, a, c, d]);
  const still = [0, 0, 0, 0, 0, 0, 1];
  const aside = [1, 0, 0, 0, 0, 0, 1];
  const pose = Array.from({ length: frames }, () => [...still, ...still, ...aside]).flat();
  const columns = PUSHES.flatMap((push, f) => [...push, TWISTS[f], SPRING_LENGTHS[f], ANGLES[f]]);
  const zero = 6;
  const forces: ForceJson[] = [
    { name: 'push', type: 'force', picture: 'force', a: 1, b: -1, axis: [0, 0, 1], follows: false, wrench: { at: 1, columns: [0, 1, 2, zero, zero, zero] }, values: [] },
    { name: 'twist', type: 'torque', picture: 'torque', a: 2, b: -1, axis: [0, 1, 0], follows: false, wrench: { at: 2, columns: [zero, zero, zero, zero, 3, zero] }, values: [] },
    { name: 'coil', type: 'spring_damper', picture: 'spring', a: 3, b: 4, wrench: null, values: [{ name: 'length', unit: 'm', column: 4 }] },
    { name: 'silent', type: 'force', picture: 'force', a: 1, b: -1, axis: [0, 0, 1], follows: false, wrench: null, values: [] },
  ];
  const joints: JointJson[] = [{ name: 'hinge', type: 'revolute', turns: 1, slides: 0, a: 0, b: 5, axis: [0, 1, 0], cut: false, values: [{ name: 'position', unit: 'rad', column: 5 }] }];
  const page: PageJson = {
    schema: 1,
    kind: 'run',
    title: 'efforts',
    program: 'floatframe 0.1.0',
    status: { state: 'completed', sentences: [], warnings: [] },
    scene: {
      frames: { time: writer.view('f64', PUSHES.map((_, f) => f)), pose: writer.view('f32', pose, [frames, 3, 7]), amplitudes: null },
      origin: [0, 0, 0],
      up: [0, 0, 1],
      bodies: [
        { name: 'core', mass: 1, modes: null, shape: { kind: 'mesh', vertices: writer.view('f32', corners.flat(), [8, 3]), triangles: writer.view('u16', faces, [12, 3]) }, bound: 0.3, size: 0.3 },
        { name: 'glass', mass: 1, modes: null, shape: { kind: 'box', size: [1.2, 1.2, 1.2], position: [0, 0, 0], quaternion: [0, 0, 0, 1] }, bound: 1.04, size: 1 },
        { name: 'post', mass: 1, modes: null, shape: null, bound: 0.1, size: 0.1 },
      ],
      points: [
        { name: '', body: -1, p: [1.6, 0, 0] },
        { name: '', body: 2, p: [0, 0, 0.1] },
        { name: '', body: 2, p: [-2, 0, 0.1] },
        { name: '', body: 0, p: [0.4, 0, -0.5] },
        { name: '', body: -1, p: [0.4, 0, 0.5] },
        { name: '', body: 2, p: [0.6, 0, 0] },
      ],
      joints,
      forces,
      efforts: { data: writer.view('f32', columns, [frames, 6]), constants: [0] },
      gravity: [0, 0, 0],
    },
  };
  return { page, writer };
}
