// A small vehicle on a bump: a rigid chassis, four flexible arms with wheels, springs, tyres, a road.

import type { BodyJson, ChannelJson, ForceJson, JointJson, PageJson, PointJson, Triple } from '../../src/data/page';
import { beamMesh, displacements, modeShape, tetrahedron, tubeMesh } from './shapes';
import { BufferWriter } from './writer';

export const RADIUS = 0.35;
const SPEED = 3;
export const ARM = 0.62;
const MODES = 6;
const TRACK = 0.42;

type Q = [number, number, number, number];

export function turnAbout(axis: Triple, angle: number): Q {
  const s = Math.sin(angle / 2);
  return [axis[0] * s, axis[1] * s, axis[2] * s, Math.cos(angle / 2)];
}

function times(a: Q, b: Q): Q {
  return [
    a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
    a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
    a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
    a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
  ];
}

function turn(q: Q, v: Triple): Triple {
  const r = times(times(q, [...v, 0] as Q), [-q[0], -q[1], -q[2], q[3]]);
  return [r[0], r[1], r[2]];
}

function plus(a: Triple, b: Triple): Triple {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

export function road(x: number): number {
  const s = (x - 4) / 1.6;
  return s > 0 && s < 1 ? 0.09 * (1 - Math.cos(2 * Math.PI * s)) : x >= 8 && x < 8.6 ? 0.12 : x >= 8.6 && x < 9.2 ? 0.24 : x >= 9.2 ? 0.36 : 0;
}

/** What the wheels feel: the road, rounded off. */
function felt(x: number): number {
  let sum = 0;
  for (let k = -8; k <= 8; ++k) sum += road(x + 0.03 * k);
  return sum / 17;
}

export interface Instant {
  bodies: { position: Triple; quaternion: Q }[];
  amplitudes: number[];
}

const CORNERS: [number, number][] = [
  [1, 1],
  [1, -1],
  [-1, 1],
  [-1, -1],
];

/** The whole motion by formulas, which tests compute again. Bodies: chassis, four arms, four wheels, a box on top. */
export function motionAt(t: number): Instant {
  const x = SPEED * t;
  const front = felt(x + 0.9);
  const rear = felt(x - 0.9);
  const bounce = 0.012 * Math.sin(9 * t) + 0.5 * (front + rear);
  const pitch = -Math.atan2(front - rear, 1.8) * 0.8 + 0.012 * Math.sin(7 * t);
  const chassis: Triple = [x, 0, 0.78 + bounce];
  const attitude = times(turnAbout([0, 1, 0], pitch), turnAbout([1, 0, 0], 0.02 * Math.sin(5 * t)));
  const bodies: Instant['bodies'] = [{ position: chassis, quaternion: attitude }];
  const wheels: Instant['bodies'] = [];
  const amplitudes: number[] = [];
  CORNERS.forEach(([fore, side], k) => {
    const foot = plus(chassis, turn(attitude, [0.9 * fore, side * TRACK * 0.35, -0.3]));
    const centre: Triple = [x + 0.9 * fore, 0, felt(x + 0.9 * fore) + RADIUS - 0.012];
    const droop = Math.atan2(centre[2] - foot[2], ARM);
    // Arms lie along y, outwards.
    const arm = times(attitude, times(turnAbout([0, 0, 1], (side * Math.PI) / 2), turnAbout([0, 1, 0], -droop)));
    bodies.push({ position: foot, quaternion: arm });
    for (let j = 0; j < MODES; ++j) amplitudes.push(((0.004 / (1 + j)) * Math.sin((11 + 4 * j) * t + k) + (j === 0 ? 0.05 * (front - rear) * fore : 0)) / (1 + (j > 2 ? 2 : 0)));
    wheels.push({ position: plus(foot, turn(arm, [ARM, 0, 0])), quaternion: times(attitude, turnAbout([0, 1, 0], x / RADIUS)) });
  });
  bodies.push(...wheels, { position: plus(chassis, turn(attitude, [-0.55, 0, 0.22])), quaternion: attitude });
  return { bodies, amplitudes };
}

export const FRAMES = 201;
export const STEP = 0.02;
export const ORIGIN: Triple = [100, -20, 5];
export const FIRST_ARM = 1;
export const CHANNEL = 'chassis_z';

export function armVertex(mesh: ReturnType<typeof armMesh>, vertex: number): Triple {
  return mesh.vertices.slice(3 * vertex, 3 * vertex + 3) as Triple;
}

export function armMesh(): ReturnType<typeof tubeMesh> {
  return tubeMesh(ARM, 0.035, 20, 24);
}

/** Pa of one unit of the stress that is written. */
export const STRESS_UNIT = 2e6;

/** Units of stress of mode j at a place of an arm, amplitude one. */
export function stressOf(x: number, y: number, z: number, j: number): number[] {
  const bending = (1 - x / ARM) * 900 * (j + 1) * z * 30;
  return [bending, 0.2 * bending, 0, 400 * y * (j + 2), 0, 100 * z];
}

/** What of the arms' own inertia stands behind the amplitudes: one coefficient for all of them. */
export function loadAt(t: number): number {
  return 0.02 * Math.cos(3 * t) - 0.03;
}

export function vehicle(options: { hostile?: boolean; frames?: number; uniform?: number[]; load?: number[] } = {}): { page: PageJson; writer: BufferWriter } {
  const writer = new BufferWriter();
  const frames = options.frames ?? FRAMES;
  const time = Array.from({ length: frames }, (_, k) => k * STEP);
  const instants = time.map(motionAt);
  const pose = instants.flatMap((i) => i.bodies.flatMap((b) => [...b.position, ...b.quaternion]));
  const amplitudes = instants.flatMap((i, k) => (options.load ? [...i.amplitudes, loadAt(time[k])] : i.amplitudes));
  const names = ['front_left', 'front_right', 'rear_left', 'rear_right'];
  const evil = options.hostile ? '<img src=x onerror="window.hacked=1"></script><b>' : '';
  const bodies: BodyJson[] = [];
  const points: PointJson[] = [];
  const joints: JointJson[] = [];
  const forces: ForceJson[] = [];
  const point = (p: PointJson): number => points.push(p) - 1;
  const hull = beamMesh(2.5, 0.95, 0.24, 6, 3);
  for (let i = 0; i < hull.vertices.length; i += 3) hull.vertices[i] -= 1.25;
  bodies.push({
    name: `chassis${evil}`,
    mass: 1260,
    facts: [['mass', '1260 kg'], ['inertia', '187, 1120, 1210 kg m²']],
    modes: null,
    shape: { kind: 'mesh', vertices: writer.view('f32', hull.vertices, [hull.vertices.length / 3, 3]), triangles: writer.view('u16', hull.triangles, [hull.triangles.length / 3, 3]), normals: null, displacements: null, nodes: null },
    bound: 1.4,
    size: 2.5,
  });
  const mesh = armMesh();
  const count = mesh.vertices.length / 3;
  const shapes = displacements(mesh, ARM, MODES);
  const tip = Array.from({ length: MODES }, (_, j) => modeShape(j, ARM, ARM, 0, 0));
  const strain = Array.from({ length: count }, (_, v) => Array.from({ length: MODES }, (_, j) => (1 - mesh.vertices[3 * v] / ARM) * 2100 * (j + 1) * mesh.vertices[3 * v + 2] * 30)).flat();
  // A bar that bends and twists: xx and xy of each mode.
  const tensor = Array.from({ length: count }, (_, v) =>
    Array.from({ length: MODES }, (_, j) => options.uniform ? options.uniform.map((s) => (j === 0 ? s : 0)) : stressOf(mesh.vertices[3 * v], mesh.vertices[3 * v + 1], mesh.vertices[3 * v + 2], j)).flat(),
  ).flat();
  names.forEach((name, k) => {
    bodies.push({
      name: `${name}_arm`,
      mass: 8.4,
      facts: [['mass', '8.4 kg'], ['nodes', '4210'], ['reduction', 'Craig-Bampton']],
      modes: { first: k * MODES, count: MODES, frequencies: [null, null, null, 212.4, 338.1, 902.5], names: ['static 1', 'static 2', 'static 3', 'fixed 1', 'fixed 2', 'fixed 3'] },
      shape: {
        kind: 'mesh',
        vertices: writer.view('f32', mesh.vertices, [count, 3]),
        triangles: writer.view('u32', mesh.triangles, [mesh.triangles.length / 3, 3]),
        displacements: writer.view('f16', shapes, [count, MODES, 3]),
        nodes: writer.view('u32', Array.from({ length: count }, (_, v) => 1001 + v)),
      },
      fields: [{ name: 'Axial stress', unit: 'MPa', modes: writer.view('f16', strain, [count, MODES]) }],
      stress: {
        factor: STRESS_UNIT,
        modes: writer.view('f16', tensor, [count, MODES, 6]),
        ...(options.load ? { loads: writer.view('f16', Array.from({ length: count }, () => options.load!).flat(), [count, 1, 6]), first_load: 4 * MODES } : {}),
        doubtful: writer.view('u32', [0, 1]),
        envelope: writer.view('f32', Array.from({ length: count }, (_, v) => 1e6 * (v + 1)), [count]),
        when: writer.view('f32', Array.from({ length: count }, (_, v) => 0.01 * v), [count]),
      },
      bound: ARM,
      size: ARM,
    });
  });
  names.forEach((name) => bodies.push({ name: `${name}_wheel`, mass: 24, facts: [['mass', '24 kg']], modes: null, shape: { kind: 'ellipsoid', size: [0.26, 0.1, 0.26], position: [0, 0, 0], quaternion: [0, 0, 0, 1] }, bound: 0.15, size: 0.3 }));
  const box = tetrahedron(0.45, [-0.2, -0.2, 0]);
  bodies.push({ name: 'box', mass: 90, modes: null, shape: { kind: 'mesh', vertices: writer.view('f32', box.vertices, [4, 3]), triangles: writer.view('u16', box.triangles, [4, 3]), color: '#c2410c' }, bound: 0.6, size: 0.5 });
  // Upwards, the other five numbers are the constant zero.
  const along = (column: number, at: number): { at: number; columns: number[] } => ({ at, columns: [8, 8, column, 8, 8, 8] });
  CORNERS.forEach(([fore, side], k) => {
    const foot = point({ name: `${names[k]}_foot`, body: 0, p: [0.9 * fore, side * TRACK * 0.35, -0.3] });
    const root = point({ name: '', body: 1 + k, p: [0, 0, 0] });
    const end = point({ name: `${names[k]}_tip`, body: 1 + k, p: [ARM, 0, 0], modes: tip });
    const hub = point({ name: `${names[k]}_hub`, body: 5 + k, p: [0, 0, 0] });
    const top = point({ name: '', body: 0, p: [0.9 * fore, side * 0.44, 0.12] });
    const seat = point({ name: '', body: 1 + k, p: [0.66 * ARM, 0, 0.03], modes: Array.from({ length: MODES }, (_, j) => modeShape(j, ARM, 0.66 * ARM, 0, 0.03)) });
    joints.push({ name: `${names[k]}_pivot`, type: 'revolute', turns: 1, slides: 0, a: foot, b: root, axis: [1, 0, 0], cut: false });
    joints.push({ name: `${names[k]}_bearing`, type: 'revolute', turns: 1, slides: 0, a: hub, b: end, axis: [0, 1, 0], cut: k === 3 });
    forces.push({ name: `${names[k]}_spring`, type: 'spring_damper', picture: 'spring', a: seat, b: top, wrench: along(4 + k, top), values: [{ name: 'force', unit: 'N', column: 4 + k }] });
    forces.push({ name: `${names[k]}_tyre${k === 0 ? evil : ''}`, type: 'tyre', picture: 'wheel', a: hub, b: -1, axis: [0, 1, 0], radius: RADIUS, width: 0.19, wrench: along(k, hub), values: [{ name: 'force', unit: 'N', column: k }] });
  });
  const profile: number[] = [];
  for (let x = -4; x <= 16; x += 0.1) profile.push(x, road(x));
  for (const x of [8, 8.6, 9.2]) {
    const at = profile.findIndex((value, i) => i % 2 === 0 && value >= x - 1e-9);
    profile.splice(at, 0, x - 1e-4, road(x - 1e-3));
  }
  const values = new Map<string, number[]>();
  const channel = (name: string, label: string, unit: string, body: string | null, kind: string, f: (t: number, k: number) => number, more: object = {}): ChannelJson => {
    const column = time.map(f);
    const offset = column[0];
    values.set(name, column);
    return { name, label, unit, body, kind, data: writer.view('f32', column.map((v) => v - offset)), offset, constant: false, noise: false, ...more };
  };
  const curveTime = writer.view('f64', time);
  const channels = [
    channel(CHANNEL, 'height', 'm', 'chassis', 'position', (_t, k) => instants[k].bodies[0].position[2] + ORIGIN[2]),
    channel('chassis_x', 'travel', 'm', 'chassis', 'position', (_t, k) => instants[k].bodies[0].position[0] + ORIGIN[0]),
    channel('chassis_y', 'lateral', 'm', 'chassis', 'position', () => ORIGIN[1], { constant: true }),
    channel('chassis_pitch', 'pitch', 'rad', 'chassis', 'angle', (_t, k) => 2 * Math.asin(instants[k].bodies[0].quaternion[1])),
    channel('chassis_roll_noise', 'yaw', 'rad', 'chassis', 'angle', (_t, k) => 1e-15 * Math.sin(k * 12.9), { noise: true }),
    ...names.map((name, i) => channel(`${name}_wheel_z`, name.replace('_', ' '), 'm', 'wheels', 'position', (_t, k) => instants[k].bodies[5 + i].position[2] + ORIGIN[2])),
    ...names.map((name, i) => channel(`${name}_tyre_force`, name.replace('_', ' '), 'N', 'wheels', 'tyre force', (t, k) => 3600 + 700 * Math.sin(9 * t + i) + 9000 * (instants[k].bodies[5 + i].position[2] - RADIUS))),
    ...names.map((name, i) => channel(`${name}_spring_force`, name.replace('_', ' '), 'N', 'springs', 'force', (t) => -2900 + 420 * Math.sin(9 * t + i))),
    channel('steering', 'steering angle', 'rad', null, 'input', (t) => 0.1 * Math.sin(2 * t)),
  ];
  const trust = [
    channel('violation', 'position violation', 'm', null, 'violation', (t) => 2e-11 * (1 + Math.sin(31 * t) ** 2), { group: 'constraints' }),
    channel('velocity_violation', 'velocity violation', 'm/s', null, 'violation', (t) => 3e-9 * (1 + Math.sin(27 * t) ** 2), { group: 'constraints' }),
    channel('kinetic', 'kinetic', 'J', null, 'energy', (t) => 5700 + 90 * Math.sin(9 * t), { group: 'energy' }),
    channel('potential', 'gravity', 'J', null, 'energy', (_t, k) => 12360 * (instants[k].bodies[0].position[2] - 0.78), { group: 'energy' }),
    channel('elastic', 'elastic', 'J', null, 'energy', (t) => 40 * Math.sin(9 * t) ** 2, { group: 'energy' }),
    channel('springs', 'springs', 'J', null, 'energy', (t) => 900 + 300 * Math.sin(9 * t + 1), { group: 'energy' }),
    channel('dissipated', 'dissipated', 'J', null, 'energy', (t) => -260 * t, { group: 'energy' }),
    channel('residual', 'balance', 'J', null, 'energy', (t) => 0.8 * Math.sin(40 * t), { group: 'energy' }),
    channel('iterations', 'iterations', '', null, 'iterations', (_t, k) => 3 + (k % 7 === 0 ? 1 : 0), { group: 'effort' }),
    channel('substeps', 'substeps', '', null, 'substeps', () => 1, { group: 'effort', constant: true }),
  ];
  // Every second instant, but for the first without a value: as the program writes what is counted between instants.
  const trustTime = time.filter((_t, k) => k % 2 === 0);
  const own = (name: string, more: object, f: (t: number) => number): ChannelJson => ({ name, label: name, unit: '%', body: null, kind: 'Elastic displacement', group: 'range', data: writer.view('f32', trustTime.map(f)), offset: 0, ...more });
  trust.splice(0, trust.length, ...trust.map((c) => ({ ...c, data: writer.view('f32', trustTime.map((_t, k) => (k === 0 && c.group === 'effort' ? NaN : values.get(c.name)![2 * k] - c.offset!))) })));
  trust.push(...names.map((name, i) => own(`${name}_arm`, { limit: 10 }, (t) => (1.5 + i) * Math.sin(9 * t) ** 2)));
  const page: PageJson = {
    schema: 1,
    kind: 'run',
    title: `vehicle${evil}`,
    program: 'floatframe 0.1.0',
    status: {
      state: 'completed',
      sentences: ['4 s in 400 steps of 10 ms, computed in 0.035 s (114 times real time).', 'Largest elastic displacement: 9.1 mm at front_left_arm, 1.5 % of its size.'],
      warnings: [`The tyre front_left leaves the road at 2.84 s for 0.06 s.${evil}`],
    },
    facts: [
      { heading: 'Model', rows: [['bodies (flexible)', '10 (4)'], ['coordinates, relative', '38'], ['coordinates, absolute', '84'], ['cut joints', '0']] },
      { heading: 'Integration', rows: [['scheme', 'generalised-alpha, 0.9'], ['step', '10 ms'], ['tolerance', '1e-9']] },
      { heading: 'Files', rows: [['vehicle.yaml', 'a1c9…'], ['arm.ffb', '77e0…']] },
    ],
    tables: [{ heading: 'Modes', columns: ['body', 'mode', 'kind', 'frequency [Hz]', 'damping'], rows: names.flatMap((n) => [212.4, 338.1, 902.5].map((f, j) => [`${n}_arm`, String(j + 1), 'fixed interface', String(f), '0.02'])) }],
    curves: { time: curveTime, channels },
    trust: {
      time: writer.view('f64', trustTime),
      notes: { energy: `Changes since the start.${evil}` },
      channels: trust,
      rows: [
        ['Largest position violation', '4.0e-11 m', 'ok'],
        ['Largest velocity violation', '6.0e-9 m/s', 'ok'],
        ['Energy balance', '0.014 % of the largest term', 'ok'],
        ['Largest modal amplitude, front_left_arm', '9.1 mm, 1.5 % of its size', 'ok'],
        ['Rotation of the elastic part, rear_left_arm', '6.2 degrees, linear range ends at 5', 'warn'],
        ['Iterations', '3.1 a step, at most 4', 'ok'],
      ],
    },
    speed: {
      rows: [['real-time factor', '114'], ['time of computing', '0.035 s'], ['steps', '400'], ['median of a step', '0.083 ms'], ['largest step', '0.21 ms']],
      step_times: { median: 0.086, percent_99: 0.17, edges: Array.from({ length: 41 }, (_, k) => 0.06 + 0.004 * k), counts: Array.from({ length: 40 }, (_, k) => Math.round(70 * Math.exp(-(((k - 6) / 4) ** 2)) + (k > 8 ? 6 * Math.exp(-(k - 8) / 9) : 0))) },
    },
    scene: {
      frames: { time: writer.view('f64', time), pose: writer.view('f32', pose, [frames, bodies.length, 7]), amplitudes: writer.view('f32', amplitudes, [frames, amplitudes.length / frames]) },
      origin: ORIGIN,
      up: [0, 0, 1],
      bodies,
      points,
      joints,
      forces,
      rods: [{ name: 'tie', a: 1, b: 7 }],
      roads: [{ name: 'road', profile: writer.view('f32', profile, [profile.length / 2, 2]), width: [-1.6, 1.6] }],
      efforts: {
        data: writer.view('f32', time.flatMap((_t, f) => ['tyre', 'spring'].flatMap((kind) => names.map((name) => values.get(`${name}_${kind}_force`)![f]))), [frames, 8]),
        constants: [0],
      },
      gravity: [0, 0, -9.81],
    },
  };
  return { page, writer };
}
