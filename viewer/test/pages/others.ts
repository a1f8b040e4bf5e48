// Pages of the other kinds, a large one, and damaged ones.

import type { BodyJson, PageJson, PointJson } from '../../src/data/page';
import { beamMesh, displacements, modeShape, tubeMesh } from './shapes';
import { vehicle } from './vehicle';
import { BufferWriter, fillTemplate, fillText } from './writer';

export function check(): { page: PageJson; writer: BufferWriter } {
  const { page, writer } = vehicle({ frames: 1 });
  return {
    page: {
      ...page,
      kind: 'check',
      title: 'vehicle',
      status: { state: 'completed', sentences: ['The model is valid: 10 bodies, 8 joints, no redundant constraint.'], warnings: [] },
      curves: null,
      trust: null,
      speed: null,
    },
    writer,
  };
}

export function reduce(): { page: PageJson; writer: BufferWriter } {
  const writer = new BufferWriter();
  const [length, modes] = [0.8, 9];
  const mesh = beamMesh(length, 0.12, 0.05, 60, 8);
  const count = mesh.vertices.length / 3;
  const near = (x: number): number[] => Array.from({ length: count }, (_, v) => v).filter((v) => Math.abs(mesh.vertices[3 * v] - x) < 1e-9 && v % 2 === 0);
  const points: PointJson[] = [
    { name: 'CLAMP', body: 0, p: [-0.06, 0, 0], modes: Array.from({ length: modes }, () => [0, 0, 0]) },
    { name: 'BALL', body: 0, p: [length + 0.05, 0, 0], modes: Array.from({ length: modes }, (_, j) => modeShape(j, length, length, 0, 0)) },
  ];
  const frequencies = [31.2, 74.8, 210.6, 195.4, 469.0, 633.1, 547.2, 1310.5, 1055.7];
  const body: BodyJson = {
    name: 'arm',
    mass: 37.4,
    facts: [['mass', '37.4 kg'], ['nodes', String(count)]],
    modes: { first: 0, count: modes, frequencies, names: frequencies.map((_, j) => ['bending z', 'bending y', 'torsion'][j % 3]) },
    shape: {
      kind: 'mesh',
      vertices: writer.view('f32', mesh.vertices, [count, 3]),
      triangles: writer.view('u16', mesh.triangles, [mesh.triangles.length / 3, 3]),
      displacements: writer.view('f16', displacements(mesh, length, modes), [count, modes, 3]),
    },
    bound: length,
    size: length,
    // The same everywhere, of each mode another size.
    stress: {
      factor: 1e6,
      modes: writer.view('f16', Array.from({ length: count }, () => frequencies.map((_, j) => [100, -40, 20, 60, -30, 20].map((value) => (j + 1) * value))).flat(2), [count, modes, 6]),
    },
    spiders: [
      { point: 0, vertices: writer.view('u32', near(0)) },
      { point: 1, vertices: writer.view('u32', near(length)) },
    ],
  };
  const page: PageJson = {
    schema: 1,
    kind: 'reduce',
    title: 'arm.inp',
    program: 'floatframe 0.1.0',
    status: { state: 'completed', sentences: ['Craig-Bampton reduction to 9 modes with 2 interfaces; the part can be trusted up to 500 Hz.'], warnings: [] },
    facts: [{ heading: 'Part', rows: [['elements', '480'], ['nodes', String(count)], ['mass', '37.4 kg'], ['interfaces', '2']] }],
    tables: [
      { heading: 'Health', columns: ['check', 'found', 'limit', 'verdict'], rows: [['Free frequencies, largest error', '0.4 %', '2 %', 'ok'], ['Static flexibility, largest error', '1e-9', '1e-6', 'ok'], ['Rigid modes', '6', '6', 'ok'], ['Mass', '37.4 kg', '37.4 kg', 'ok']] },
    ],
    curves: null,
    trust: null,
    speed: null,
    scene: { frames: null, origin: null, up: [0, 0, 1], bodies: [body], points, joints: [], forces: [], rods: [], roads: [], gravity: null },
  };
  return { page, writer };
}

export function compare(): { page: PageJson; writer: BufferWriter } {
  const writer = new BufferWriter();
  const time = Array.from({ length: 500 }, (_, k) => 0.01 * k);
  const second = Array.from({ length: 251 }, (_, k) => 0.02 * k);
  const channels = ['height', 'pitch', 'travel', 'tip'].map((name, i) => {
    const f = (t: number): number => (i === 2 ? 5 * t : Math.sin((3 + i) * t) * Math.exp(-0.3 * t));
    const g = (t: number): number => f(t) + (i === 3 ? 0 : 0.03 * i * Math.sin(20 * t) + 0.002);
    return {
      name,
      label: name,
      unit: i === 1 ? 'rad' : 'm',
      body: i === 3 ? 'arm' : 'chassis',
      kind: i === 1 ? 'angle' : 'position',
      data: writer.view('f32', time.map(f)),
      offset: 0,
      constant: false,
      noise: false,
      other: writer.view('f32', second.map(g)),
      difference: { max: i === 3 ? 0 : 0.03 * i + 0.002, rms: i === 3 ? 0 : 0.021 * i + 0.002, beyond: i === 2 },
    };
  });
  const page: PageJson = {
    schema: 1,
    kind: 'compare',
    title: 'coarse against fine',
    program: 'floatframe 0.1.0',
    status: { state: 'completed', sentences: ['4 channels are in both runs; 1 is beyond the tolerance of 0.05.'], warnings: ['travel differs by 0.062 m at 4.71 s.'] },
    curves: { time: writer.view('f64', time), other_time: writer.view('f64', second), names: ['out/coarse', 'out/fine'], channels },
    scene: null,
  };
  return { page, writer };
}

/** Twelve runs, the last of them failed: a stiffness at equal ratios and a road. */
export function sweep(): { page: PageJson; writer: BufferWriter } {
  const writer = new BufferWriter();
  const stiffness = [1e3, 1e4, 1e5, 1e6];
  const roads = ['bump', 'stairs', 'smooth'];
  const runs = stiffness.flatMap((k, i) => roads.map((road, j) => ({ k, road, height: 10 - 2 * i + [0, 1, -3][j] })));
  const last = runs.length - 1;
  const time = Array.from({ length: 200 }, (_, n) => 0.01 * n);
  const page: PageJson = {
    schema: 1,
    kind: 'sweep',
    title: 'vehicle',
    program: 'floatframe 0.1.0',
    status: { state: 'failed', sentences: ['A study of 12 runs.'], warnings: ['1 of 12 runs failed, the first is run 12: no convergence.'] },
    facts: [{ heading: 'Study', rows: [['model file', 'vehicle.yaml'], ['k', 'varied'], ['road', 'varied']] }],
    study: {
      variables: [{ name: 'k', values: runs.map(({ k }) => String(k)) }, { name: 'road', values: runs.map(({ road }) => road) }],
      states: runs.map((_, n) => (n === last ? 'failed' : 'completed')),
      messages: runs.map((_, n) => (n === last ? 'no convergence at 0.4 s' : '')),
      measures: [
        { name: 'steps', unit: '', values: writer.view('f64', runs.map(() => 200)) },
        { name: 'chassis.z max', unit: 'm', values: writer.view('f64', runs.map(({ height }, n) => (n === last ? NaN : height))) },
        { name: 'seat.z max', unit: 'm', values: writer.view('f64', runs.map(({ height }) => 20 - height)) },
      ],
      curves: {
        channels: [{ name: 'chassis.z', unit: 'm' }, { name: 'seat.z', unit: 'm' }],
        runs: runs.slice(0, last).map(({ height }, run) => ({
          run,
          channels: [0, 1],
          time: writer.view('f64', time),
          values: writer.view('f32', [...time.map((t) => height * Math.sin(1.6 * t)), ...time.map((t) => (20 - height) * Math.sin(1.6 * t))], [2, time.length]),
        })),
      },
      ranking: { measure: 'chassis.z max', largest: false },
      pages: { best: { run: 8, address: 'best/report.html' }, worst: { run: 1, address: 'worst/report.html' } },
    },
  };
  return { page, writer };
}

/** 12 bodies of 10 000 triangles and 20 modes, 800 frames: a ring of arms that turn and bend. */
export function large(): { page: PageJson; writer: BufferWriter } {
  const writer = new BufferWriter();
  const [bodies, modes, frames, length] = [12, 20, 800, 1];
  const mesh = tubeMesh(length, 0.05, 50, 100);
  const count = mesh.vertices.length / 3;
  const shapes = displacements(mesh, length, modes);
  const time = Array.from({ length: frames }, (_, k) => 0.005 * k);
  const pose: number[] = [];
  const amplitudes: number[] = [];
  for (const t of time) {
    for (let b = 0; b < bodies; ++b) {
      const angle = (2 * Math.PI * b) / bodies + 0.8 * t;
      pose.push(0.5 * Math.cos(angle), 0.5 * Math.sin(angle), 0.6 + 0.2 * Math.sin(3 * t + b), 0, 0, Math.sin(angle / 2), Math.cos(angle / 2));
      for (let j = 0; j < modes; ++j) amplitudes.push((0.03 / (1 + j)) * Math.sin((9 + 2 * j) * t + b));
    }
  }
  const list: BodyJson[] = Array.from({ length: bodies }, (_, b) => ({
    name: `arm ${b + 1}`,
    mass: 5,
    facts: [['mass', '5 kg']],
    modes: { first: b * modes, count: modes, frequencies: Array.from({ length: modes }, (_, j) => 40 * (j + 1)) },
    shape: {
      kind: 'mesh',
      vertices: writer.view('f32', mesh.vertices, [count, 3]),
      triangles: writer.view('u16', mesh.triangles, [mesh.triangles.length / 3, 3]),
      displacements: writer.view('f16', shapes.map((u) => u * (1 + 0.01 * b)), [count, modes, 3]),
    },
    bound: length,
    size: length,
  }));
  const page: PageJson = {
    schema: 1,
    kind: 'run',
    title: 'large',
    program: 'floatframe 0.1.0',
    status: { state: 'completed', sentences: ['12 bodies of 10 000 triangles with 20 modes each.'], warnings: [] },
    scene: {
      frames: { time: writer.view('f64', time), pose: writer.view('f32', pose, [frames, bodies, 7]), amplitudes: writer.view('f32', amplitudes, [frames, bodies * modes]) },
      bodies: list,
      points: [],
      joints: [],
      forces: [],
    },
  };
  return { page, writer };
}

export interface Damaged {
  html: string;
  /** What a sentence on the page has to say. */
  says: RegExp;
}

/** Pages that are wrong in one way each. */
export function damaged(template: string): Record<string, Damaged> {
  const broken = (says: RegExp, change: (page: PageJson) => void, raw = false): Damaged => {
    const { page, writer } = vehicle();
    change(page);
    return { html: fillTemplate(template, page, writer, raw), says };
  };
  const mesh = (page: PageJson, body: number): Extract<NonNullable<BodyJson['shape']>, { kind: 'mesh' }> => page.scene!.bodies[body].shape as never;
  const { page, writer } = vehicle();
  const json = JSON.stringify(page);
  const bytes = writer.buffer();
  return {
    no_data: { html: template, says: /holds no data/ },
    json: { html: fillText(template, json.slice(0, 500), ''), says: /damaged or cut short/ },
    no_record: { html: fillText(template, '[1]', ''), says: /no record/ },
    schema: broken(/version 9, expected 1/, (p) => (p.schema = 9)),
    base64: { html: fillText(template, json, '!!not base64!!'), says: /base64/ },
    deflate: { html: fillText(template, JSON.stringify({ ...page, compression: 'deflate' }), bytes.toString('base64')), says: /cannot be unpacked/ },
    packing: { html: fillText(template, JSON.stringify({ ...page, compression: 'brotli' }), ''), says: /packed as "brotli"/ },
    cut: { html: fillText(template, json, bytes.subarray(0, bytes.length / 2).toString('base64')), says: /cut short or damaged/ },
    pose: broken(/Motion of the bodies: the shape is/, (p) => (p.scene!.frames!.pose.shape[1] = 3)),
    triangle: broken(/names vertex/, (p) => (mesh(p, 1).vertices.shape[0] = 20)),
    modes: broken(/amplitudes are given; it is shown undeformed/, (p) => (p.scene!.bodies[2].modes!.count = 999)),
    displacements: broken(/displacements: the shape is/, (p) => (mesh(p, 1).displacements!.shape[2] = 4)),
    points: broken(/lie on bodies that do not exist/, (p) => p.scene!.points!.forEach((q, k) => (q.body = k < 3 ? 99 : q.body))),
    no_bodies: broken(/has no bodies/, (p) => (p.scene!.bodies = [])),
    shape: broken(/of a kind that this page does not know/, (p) => (p.scene!.bodies[5].shape = { kind: 'teapot' } as never)),
    channel: broken(/Channel "chassis_z": the shape is/, (p) => (p.curves!.channels[0].data.shape[0] = 7)),
    facts: broken(/tables of the model are left out.*/, (p) => (p.facts = [{ title: 'Bodies', rows: 7 }] as never)),
    trust: broken(/whether to trust the run is left out/, (p) => (p.trust!.rows = 'nothing' as never)),
    status: broken(/status of the run is left out/, (p) => (p.status = { state: 'completed', warnings: 7 } as never)),
    histogram: broken(/histogram of step times is left out/, (p) => p.speed!.step_times!.edges.pop()),
  };
}
