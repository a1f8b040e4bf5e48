// The scene of the page, checked: what does not fit is left out and said in a sentence, the rest is shown.

import { PageBuffer, PageError } from './buffer';
import { Efforts, readEfforts } from './efforts';
import { readVibrations, type VibrationData } from './vibrations';
import type { BodyJson, FieldJson, ForceJson, JointJson, MeshJson, PageKind, PointJson, Quadruple, SceneJson, StressJson, Triple } from './page';
import type { Quantity } from '../motion/stress';

/** Stress of the vertices of a mesh. */
export interface StressData {
  /** MPa of one unit of `modes`. */
  factor: number;
  /** Half floats [V, m + n, 6]: xx, yy, zz, xy, yz, zx of the modes of the body, then of its loads. */
  modes: Uint16Array;
  /** How many loads there are, and where their coefficients stand in the rows of amplitudes. */
  loadCount: number;
  firstLoad: number;
  /** 1 where the stress is not to be trusted. */
  doubtful: Uint8Array | null;
  /** Largest von Mises stress over the run [MPa], and when [s]. */
  envelope: Float32Array | null;
  when: Float32Array | null;
  /** The envelope is of all recorded instants, which the frames are. */
  allInstants: boolean;
  /** Several places meet at some vertices. */
  several: boolean;
}

export interface FieldData {
  name: string;
  unit: string;
  /** Of a stress, in place of the others: what of it; `envelope`: its largest value over the run. */
  stress?: { data: StressData; quantity: Quantity | 'envelope' } | null;
  modes: Uint16Array | null;
  base: Uint16Array | null;
  history: Uint16Array | null;
}

export interface MeshData {
  vertices: Float32Array;
  triangles: Uint16Array | Uint32Array;
  normals: Float32Array | null;
  /** Half floats [V, m, 3]. */
  modes: Uint16Array | null;
  nodes: Uint16Array | Uint32Array | null;
  generated: boolean;
  /** "#rrggbb" that the model file gives. */
  colour: string | null;
  /** Colours of the triangles from `first` on, null: that of the body; empty if all have one. */
  paints: { first: number; colour: string | null }[];
  fields: FieldData[];
  stress: StressData | null;
}

export interface SolidData {
  /** A cylinder has z as its axis. */
  kind: 'box' | 'cylinder' | 'ellipsoid';
  size: Triple;
  position: Triple;
  quaternion: Quadruple;
}

export interface BodyData {
  index: number;
  name: string;
  mass: number | null;
  facts: [string, string][];
  firstMode: number;
  modeCount: number;
  frequencies: (number | null)[];
  modeNames: string[];
  mesh: MeshData | null;
  solid: SolidData | null;
  bound: number;
  size: number;
  recorded: boolean;
  /** Millions of numbers that its stress has, if they are left out. */
  stressLeftOut: number | null;
  spiders: { point: number; vertices: Uint32Array }[];
}

export interface PointData {
  name: string;
  body: number;
  p: Triple;
  modes: Triple[] | null;
}

export interface RoadData {
  name: string;
  /** x, z of each point. */
  profile: Float32Array;
  width: [number, number];
}

/** A line that goes with the body of a point: what a coupling or a constraint holds. */
export interface StrokeData {
  name: string;
  a: number;
  /** x, y, z of each place, from the point. */
  points: Float32Array;
}

export interface SceneData {
  kind: PageKind;
  time: Float64Array;
  pose: Float32Array;
  amplitudes: Float32Array | null;
  amplitudeCount: number;
  bodies: BodyData[];
  points: PointData[];
  joints: JointJson[];
  forces: ForceJson[];
  rods: { name: string; a: number; b: number }[];
  strokes: StrokeData[];
  roads: RoadData[];
  /** What forces exert and where joints stand, at the frames. */
  efforts: Efforts | null;
  origin: Triple;
  up: Triple;
  vibrations: VibrationData[];
}

type Report = (sentence: string) => void;

function isNumbers(value: unknown, count: number): value is number[] {
  return Array.isArray(value) && value.length === count && value.every((x) => typeof x === 'number' && Number.isFinite(x));
}

function triple(value: unknown, instead: Triple): Triple {
  return isNumbers(value, 3) ? (value as Triple) : instead;
}

function quadruple(value: unknown): Quadruple {
  if (!isNumbers(value, 4)) return [0, 0, 0, 1];
  const length = Math.hypot(...value);
  return length > 0 ? (value.map((x) => x / length) as Quadruple) : [0, 0, 0, 1];
}

function sentenceOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

function readField(json: FieldJson, buffer: PageBuffer, vertices: number, modes: number, frames: number, body: string): FieldData {
  const what = `Body "${body}", field "${json.name}"`;
  if (!json.modes && !json.history) throw new PageError(`${what}: neither modes nor a history is given.`);
  return {
    name: String(json.name),
    unit: String(json.unit ?? ''),
    modes: json.modes ? (buffer.read(json.modes, what, ['f16'], [vertices, modes]) as Uint16Array) : null,
    base: json.base ? (buffer.read(json.base, what, ['f16'], [vertices]) as Uint16Array) : null,
    history: json.modes || !json.history ? null : (buffer.read(json.history, what, ['f16'], [frames, vertices]) as Uint16Array),
  };
}

/** Two tables of tensors side by side: those of each vertex follow each other. */
function besides(a: Uint16Array, b: Uint16Array, vertices: number): Uint16Array {
  const result = new Uint16Array(a.length + b.length);
  const [m, n] = [a.length / vertices, b.length / vertices];
  for (let v = 0; v < vertices; ++v) {
    result.set(a.subarray(v * m, (v + 1) * m), v * (m + n));
    result.set(b.subarray(v * n, (v + 1) * n), v * (m + n) + m);
  }
  return result;
}

function readStress(json: StressJson, buffer: PageBuffer, vertices: number, modes: number, amplitudeCount: number, body: string): StressData {
  const what = `${body}, stress`;
  if (typeof json.factor !== 'number' || !Number.isFinite(json.factor)) throw new PageError(`${what}: its factor is no number.`);
  let doubtful: Uint8Array | null = null;
  if (json.doubtful) {
    doubtful = new Uint8Array(vertices);
    for (const v of buffer.read(json.doubtful, what, ['u16', 'u32'], [null])) if (v < vertices) doubtful[v] = 1;
  }
  const envelope = json.envelope ? (buffer.read(json.envelope, what, ['f32'], [vertices]) as Float32Array).map((pascal) => 1e-6 * pascal) : null;
  const ofModes = buffer.read(json.modes, what, ['f16'], [vertices, modes, 6]) as Uint16Array;
  const ofLoads = json.loads ? (buffer.read(json.loads, `${what}, loads`, ['f16'], [vertices, null, 6]) as Uint16Array) : null;
  const loadCount = ofLoads ? ofLoads.length / (6 * vertices) : 0;
  const firstLoad = json.first_load ?? 0;
  if (!(Number.isInteger(firstLoad) && firstLoad >= 0 && firstLoad + loadCount <= amplitudeCount)) throw new PageError(`${what}: its loads are not among the amplitudes.`);
  return {
    factor: 1e-6 * json.factor,
    modes: ofLoads ? besides(ofModes, ofLoads, vertices) : ofModes,
    loadCount,
    firstLoad,
    doubtful,
    envelope,
    when: envelope && json.when ? (buffer.read(json.when, what, ['f32'], [vertices]) as Float32Array) : null,
    allInstants: json.all_instants === true,
    several: json.several === true,
  };
}

/** What a surface can be coloured by. */
function stressFields(data: StressData): FieldData[] {
  const field = (name: string, quantity: Quantity | 'envelope'): FieldData => ({ name, unit: 'MPa', stress: { data, quantity }, modes: null, base: null, history: null });
  const fields = [field('Von Mises stress', 'von_mises'), field('Principal stress 1', 'principal_1'), field('Principal stress 3', 'principal_3')];
  if (data.envelope) fields.push(field('Von Mises stress, largest of the run', 'envelope'));
  return fields;
}

function colourOf(value: unknown): string | null {
  return typeof value === 'string' && /^#[0-9a-f]{6}$/i.test(value) ? value : null;
}

/** Empty unless they ascend from the first triangle. */
function paintsOf(value: unknown, triangles: number): MeshData['paints'] {
  if (!Array.isArray(value)) return [];
  const paints = value.map((entry) => ({ first: Array.isArray(entry) ? Number(entry[0]) : NaN, colour: Array.isArray(entry) ? colourOf(entry[1]) : null }));
  const good = paints.every(({ first }, k) => Number.isInteger(first) && first < triangles && (k === 0 ? first === 0 : first > paints[k - 1].first));
  return good ? paints : [];
}

function readMesh(json: MeshJson, body: BodyJson, modeCount: number, frames: number, amplitudeCount: number, buffer: PageBuffer, report: Report): MeshData {
  const what = `Body "${body.name}"`;
  const vertices = buffer.read(json.vertices, `${what}, vertices`, ['f32'], [null, 3]) as Float32Array;
  const triangles = buffer.read(json.triangles, `${what}, triangles`, ['u16', 'u32'], [null, 3]) as Uint16Array | Uint32Array;
  const count = vertices.length / 3;
  for (let i = 0; i < triangles.length; ++i) {
    if (triangles[i] >= count) throw new PageError(`${what}: triangle ${Math.floor(i / 3)} names vertex ${triangles[i]} of ${count}; the surface is left out.`);
  }
  for (let i = 0; i < vertices.length; ++i) {
    if (!Number.isFinite(vertices[i])) throw new PageError(`${what}: vertex ${Math.floor(i / 3)} is no place in space; the surface is left out.`);
  }
  const optional = <T>(read: () => T, lost: string): T | null => {
    try {
      return read();
    } catch (error) {
      report(`${sentenceOf(error)} ${lost}`);
      return null;
    }
  };
  const mesh: MeshData = {
    vertices,
    triangles,
    normals: json.normals ? optional(() => buffer.read(json.normals!, `${what}, normals`, ['f32'], [count, 3]) as Float32Array, 'They are computed instead.') : null,
    modes: null,
    nodes: json.nodes ? optional(() => buffer.read(json.nodes!, `${what}, nodes`, ['u16', 'u32'], [count]) as Uint16Array | Uint32Array, 'Labels of nodes are left out.') : null,
    generated: json.generated === true,
    colour: colourOf(json.color),
    paints: paintsOf(json.paints, triangles.length / 3),
    fields: [],
    stress: null,
  };
  if (json.displacements && modeCount > 0) {
    mesh.modes = optional(() => buffer.read(json.displacements!, `${what}, displacements`, ['f16'], [count, modeCount, 3]) as Uint16Array, 'The body is shown undeformed.');
  }
  for (const field of body.fields ?? []) {
    const read = optional(() => readField(field, buffer, count, modeCount, frames, body.name), 'The field is left out.');
    if (read) mesh.fields.push(read);
  }
  if (body.stress && modeCount > 0) {
    mesh.stress = optional(() => readStress(body.stress!, buffer, count, modeCount, amplitudeCount, what), 'Its stress is left out.');
    if (mesh.stress) mesh.fields.push(...stressFields(mesh.stress));
  }
  return mesh;
}

function readBody(json: BodyJson, index: number, frames: number, amplitudeCount: number, buffer: PageBuffer, report: Report): BodyData {
  const name = typeof json.name === 'string' && json.name !== '' ? json.name : `body ${index}`;
  const body: BodyData = {
    index,
    name,
    mass: typeof json.mass === 'number' ? json.mass : null,
    facts: Array.isArray(json.facts) ? json.facts.filter((row) => Array.isArray(row)).map((row) => [String(row[0]), String(row[1])]) : [],
    firstMode: 0,
    modeCount: 0,
    frequencies: [],
    modeNames: [],
    mesh: null,
    solid: null,
    bound: typeof json.bound === 'number' && json.bound > 0 ? json.bound : 0,
    size: typeof json.size === 'number' && json.size > 0 ? json.size : 0,
    recorded: json.recorded !== false,
    stressLeftOut: typeof json.stress_left_out === 'number' ? 1e-6 * json.stress_left_out : null,
    spiders: [],
  };
  const modes = json.modes;
  if (modes && modes.count > 0) {
    if (modes.first >= 0 && modes.first + modes.count <= amplitudeCount) {
      body.firstMode = modes.first;
      body.modeCount = modes.count;
      body.frequencies = modes.frequencies ?? [];
      body.modeNames = modes.names ?? [];
    } else {
      report(`Body "${name}" has modes ${modes.first} to ${modes.first + modes.count - 1}, but ${amplitudeCount} amplitudes are given; it is shown undeformed.`);
    }
  }
  try {
    const shape = json.shape;
    if (shape?.kind === 'mesh') {
      const modeCount = modes?.count ?? 0;
      body.mesh = readMesh(shape, { ...json, name }, modeCount, frames, amplitudeCount, buffer, report);
      if (body.modeCount === 0) body.mesh.modes = null;
      const vertexCount = body.mesh.vertices.length / 3;
      for (const spider of json.spiders ?? []) {
        const vertices = buffer.read(spider.vertices, `Body "${name}", spider`, ['u16', 'u32'], [null]);
        body.spiders.push({ point: spider.point, vertices: Uint32Array.from(vertices).filter((v) => v < vertexCount) });
      }
    } else if (shape?.kind === 'box' || shape?.kind === 'cylinder' || shape?.kind === 'ellipsoid') {
      body.solid = { kind: shape.kind, size: triple(shape.size, [0.1, 0.1, 0.1]), position: triple(shape.position, [0, 0, 0]), quaternion: quadruple(shape.quaternion) };
    } else if (shape) {
      report(`Body "${name}": its shape is of a kind that this page does not know; it is left out.`);
    }
  } catch (error) {
    report(sentenceOf(error));
  }
  return body;
}

/** Frames before the first that is no motion. */
function goodFrames(pose: Float32Array, amplitudes: Float32Array | null, time: Float64Array, bodies: number, report: Report): number {
  const columns = amplitudes && time.length > 0 ? amplitudes.length / time.length : 0;
  for (let f = 0; f < time.length; ++f) {
    let good = Number.isFinite(time[f]) && (f === 0 || time[f] > time[f - 1]);
    for (let i = f * bodies * 7; good && i < (f + 1) * bodies * 7; ++i) good = Number.isFinite(pose[i]);
    for (let i = f * columns; good && i < (f + 1) * columns; ++i) good = Number.isFinite(amplitudes![i]);
    if (good) continue;
    report(
      f === 0
        ? 'The motion has no valid first frame; bodies are shown where their frames begin.'
        : `The motion is shown up to ${time[f - 1]} s: frame ${f} of ${time.length} holds values that are no numbers, or its time does not increase.`,
    );
    return f;
  }
  return time.length;
}

function pointsOf(json: SceneJson, bodies: BodyData[], report: Report): PointData[] {
  let wrong = 0;
  const points = (json.points ?? []).map((point: PointJson): PointData => {
    const known = point && Number.isInteger(point.body) && point.body >= -1 && point.body < bodies.length && isNumbers(point.p, 3);
    if (!known) ++wrong;
    const modes = known && point.body >= 0 && point.modes?.length === bodies[point.body].modeCount ? point.modes : null;
    return { name: String(point?.name ?? ''), body: known ? point.body : -2, p: known ? point.p : [0, 0, 0], modes };
  });
  if (wrong > 0) report(`${wrong === 1 ? 'One point lies' : `${wrong} points lie`} on bodies that do not exist; what is attached there is left out.`);
  return points;
}

/** Throws PageError if nothing can be shown. */
export function readScene(json: SceneJson, kind: PageKind, buffer: PageBuffer, report: Report): SceneData {
  if (!Array.isArray(json.bodies) || json.bodies.length === 0) throw new PageError('The 3-D view has no bodies.');
  const count = json.bodies.length;
  let time = new Float64Array(0);
  let pose = new Float32Array(0);
  let amplitudes: Float32Array | null = null;
  let amplitudeCount = json.bodies.reduce((sum, body) => Math.max(sum, (body.modes?.first ?? 0) + (body.modes?.count ?? 0)), 0);
  let given = 0;
  if (json.frames) {
    time = Float64Array.from(buffer.read(json.frames.time, 'Times of the motion', ['f64', 'f32'], [null]));
    given = time.length;
    pose = buffer.read(json.frames.pose, 'Motion of the bodies', ['f32'], [given, count, 7]) as Float32Array<ArrayBuffer>;
    if (json.frames.amplitudes) {
      try {
        amplitudes = buffer.read(json.frames.amplitudes, 'Amplitudes of the modes', ['f32'], [given, null]) as Float32Array;
        amplitudeCount = given > 0 ? amplitudes.length / given : 0;
      } catch (error) {
        report(`${sentenceOf(error)} Bodies are shown undeformed.`);
      }
    }
    const good = goodFrames(pose, amplitudes, time, count, report);
    time = time.slice(0, good);
  }
  const bodies = json.bodies.map((body, index) => readBody(body ?? ({} as BodyJson), index, given, amplitudeCount, buffer, report));
  const points = pointsOf(json, bodies, report);
  const lost = bodies.filter((body) => !body.recorded).map((body) => body.name);
  if (lost.length > 0) report(`${lost.length === 1 ? 'The motion of one body was' : `The motion of ${lost.length} bodies was`} not recorded (${lost.slice(0, 5).join(', ')}${lost.length > 5 ? ', …' : ''}); the view hides what it does not know.`);
  const placed = (index: unknown): boolean => Number.isInteger(index) && points[index as number] !== undefined && points[index as number].body !== -2;
  const roads: RoadData[] = [];
  for (const road of json.roads ?? []) {
    try {
      const profile = buffer.read(road.profile, `Road "${road.name}"`, ['f32'], [null, 2]) as Float32Array;
      if (!profile.every(Number.isFinite) || !isNumbers(road.width, 2)) throw new PageError(`Road "${road.name}": its profile is no line in space; it is left out.`);
      if (profile.length >= 4) roads.push({ name: String(road.name), profile, width: road.width });
    } catch (error) {
      report(sentenceOf(error));
    }
  }
  const strokes: StrokeData[] = [];
  for (const stroke of json.strokes ?? []) {
    try {
      const line = buffer.read(stroke.points, `Line of "${stroke.name}"`, ['f32'], [null, 3]) as Float32Array;
      if (!line.every(Number.isFinite)) throw new PageError(`Line of "${stroke.name}": it is no line in space; it is left out.`);
      if (placed(stroke.a) && line.length >= 6) strokes.push({ name: String(stroke.name), a: stroke.a, points: line });
    } catch (error) {
      report(sentenceOf(error));
    }
  }
  let efforts: Efforts | null = null;
  if (json.efforts && time.length > 0) {
    try {
      efforts = readEfforts(json.efforts, buffer, time, given);
    } catch (error) {
      report(`${sentenceOf(error)} Forces are shown without arrows.`);
    }
  }
  const known = (columns: unknown): boolean => Array.isArray(columns) && columns.every((c) => efforts !== null && Number.isInteger(c) && c >= 0);
  /** Numbers that the page does not hold are left out. */
  const withNumbers = <T extends JointJson | ForceJson>(entity: T): T => ({ ...entity, values: (entity.values ?? []).filter((value) => known([value.column])) });
  const withWrench = (force: ForceJson): ForceJson => {
    const good = force.wrench && placed(force.wrench.at) && force.wrench.columns?.length === 6 && known(force.wrench.columns);
    return { ...withNumbers(force), wrench: good ? force.wrench : null };
  };
  let vibrations: VibrationData[] = [];
  if (json.vibrations) {
    try {
      vibrations = readVibrations(json.vibrations, count, amplitudeCount, buffer, report);
    } catch (error) {
      report(sentenceOf(error));
    }
  }
  return {
    kind,
    time,
    pose,
    amplitudes,
    amplitudeCount,
    bodies,
    points,
    joints: (json.joints ?? []).filter((joint) => placed(joint.a) && placed(joint.b) && joint.turns + joint.slides < 6).map(withNumbers),
    forces: (json.forces ?? []).filter((force) => (placed(force.a) || force.a === -1) && (placed(force.b) || force.b === -1)).map(withWrench),
    rods: (json.rods ?? []).filter((rod) => placed(rod.a) && placed(rod.b)),
    strokes,
    roads,
    efforts,
    origin: triple(json.origin, [0, 0, 0]),
    up: triple(json.up, [0, 0, 1]),
    vibrations,
  };
}
