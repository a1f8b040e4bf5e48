import assert from 'node:assert/strict';
import { test } from 'node:test';
import { PageBuffer } from '../../src/data/buffer';
import { readScene, type SceneData } from '../../src/data/scene_data';
import { fieldRange, largestDisplacement, largestOfModes } from '../../src/motion/elastic_range';
import { elastic, Motion } from '../../src/motion/motion';
import { Player } from '../../src/motion/player';
import { rotate, slerp } from '../../src/motion/rotation';
import { principals, stressAt, vonMises } from '../../src/motion/stress';
import { buildSurface } from '../../src/scene/surface';
import { beamMesh, modeShape } from '../pages/shapes';
import { ARM, armMesh, motionAt, STEP, STRESS_UNIT, stressOf, vehicle } from '../pages/vehicle';

function scene(frames?: number): SceneData {
  const { page, writer } = vehicle({ frames });
  const said: string[] = [];
  const result = readScene(page.scene!, 'run', new PageBuffer(writer.buffer()), (s) => said.push(s));
  assert.deepEqual(said, []);
  return result;
}

const near = (a: ArrayLike<number>, b: ArrayLike<number>, tolerance: number): void => {
  for (let i = 0; i < b.length; ++i) assert.ok(Math.abs(a[i] - b[i]) <= tolerance, `${a[i]} and ${b[i]} at ${i}`);
};

test('orientations go the short way, at constant rate', () => {
  const out = new Float64Array(4);
  const half = Math.SQRT1_2;
  slerp([0, 0, 0, 1], 0, [0, 0, half, half], 0, 1 / 3, out, 0);
  near(out, [0, 0, Math.sin(Math.PI / 12), Math.cos(Math.PI / 12)], 1e-15);
  // The same orientation with the other sign.
  slerp([0, 0, 0, 1], 0, [0, 0, -half, -half], 0, 1 / 3, out, 0);
  near(out, [0, 0, Math.sin(Math.PI / 12), Math.cos(Math.PI / 12)], 1e-15);
  slerp([0, 0, 0, 1], 0, [0, 0, 1e-9, 1], 0, 0.5, out, 0);
  near(out, [0, 0, 5e-10, 1], 1e-15);
  near(rotate([0, 0, half, half], 0, 1, 2, 3), [-2, 1, 3], 1e-15);
});

test('motion at frames is that of the record, between them close to the formulas', () => {
  const motion = new Motion(scene());
  for (const [t, tolerance] of [[0, 1e-6], [50 * STEP, 1e-6], [1.234, 1e-3], [4, 1e-6]]) {
    motion.go(t);
    const exact = motionAt(t);
    exact.bodies.forEach((body, b) => near(motion.position.subarray(3 * b, 3 * b + 3), body.position, tolerance));
    near(motion.amplitudes, exact.amplitudes, tolerance);
    const tip = motion.scene.points[2];
    const u: [number, number, number] = [ARM, 0, 0];
    for (let j = 0; j < 6; ++j) modeShape(j, ARM, ARM, 0, 0).forEach((x, i) => (u[i] += 100 * exact.amplitudes[j] * x));
    const { position, quaternion } = exact.bodies[1];
    near(motion.pointPosition(tip, 100), rotate(quaternion, 0, ...u).map((x, i) => x + position[i]), 100 * tolerance);
  }
});

test('the sampled maximum is that of all vertices and frames', () => {
  const data = scene();
  for (const body of data.bodies.filter((b) => b.modeCount > 0)) {
    let most = 0;
    for (let f = 0; f < data.time.length; ++f) {
      for (let v = 0; v < body.mesh!.vertices.length / 3; ++v) most = Math.max(most, Math.hypot(...elastic(body, v, data.amplitudes!, f * data.amplitudeCount + body.firstMode)));
    }
    const sampled = largestDisplacement(data, body);
    assert.ok(most > 0.001 && sampled <= most && sampled > 0.99 * most, `${sampled} of ${most}`);
  }
  const modes = largestOfModes(data.bodies[1]);
  assert.ok(modes[0] >= 1 && modes[0] < 1.02, String(modes[0]));
});

test('a peak of one frame of many is in the range', () => {
  const data = scene(1201);
  const body = data.bodies[1];
  const before = largestDisplacement(data, body);
  const at = 601 * data.amplitudeCount + body.firstMode;
  data.amplitudes![at] = 0.2;
  let peak = 0;
  for (let v = 0; v < body.mesh!.vertices.length / 3; ++v) peak = Math.max(peak, Math.hypot(...elastic(body, v, data.amplitudes!, at)));
  const found = largestDisplacement(data, body);
  assert.ok(found >= 0.99 * peak && found > 1.5 * before, `${found}, ${peak} of the peak, ${before} before`);
});

test('surfaces: sharp edges are doubled, round ones are not', () => {
  const box = beamMesh(1, 1, 1, 2, 2);
  // One closed box: equal places of the six faces are one vertex.
  const place = new Map<string, number>();
  const vertices: number[] = [];
  const index = box.triangles.map((v) => {
    const p = box.vertices.slice(3 * v, 3 * v + 3);
    const key = p.map((x) => x.toFixed(6).replace('-0.000000', '0.000000')).join();
    if (!place.has(key)) place.set(key, vertices.push(...p) / 3 - 1);
    return place.get(key)!;
  });
  const mesh = { vertices: Float32Array.from(vertices), triangles: Uint32Array.from(index), normals: null, modes: null, nodes: null, generated: false, colour: null, paints: [], fields: [], stress: null };
  const surface = buildSurface(mesh);
  assert.equal(vertices.length / 3, 26);
  assert.equal(surface.geometry.getAttribute('position').count, 6 * 9);
  assert.equal(surface.edges.getIndex()!.count / 2, 12 * 2);
  const tube = armMesh();
  const smooth = buildSurface({ ...mesh, vertices: Float32Array.from(tube.vertices), triangles: Uint32Array.from(tube.triangles) });
  assert.equal(smooth.geometry.getAttribute('position').count, tube.vertices.length / 3);
});

test('a damaged motion is shown as far as it goes', () => {
  const { page, writer } = vehicle();
  const buffer = new PageBuffer(writer.buffer());
  const pose = buffer.read(page.scene!.frames!.pose, 'pose', ['f32'], [null, 10, 7]) as Float32Array;
  pose[30 * 70 + 3] = NaN;
  const said: string[] = [];
  const data = readScene(page.scene!, 'run', buffer, (s) => said.push(s));
  assert.equal(data.time.length, 30);
  assert.match(said[0], /shown up to 0.58 s: frame 30 of 201/);
});

test('the player: steps, ends, loop and speeds', () => {
  const player = new Player([0, 0.1, 0.2, 0.5]);
  player.step(1);
  assert.equal(player.time, 0.1);
  player.set(0.15);
  player.step(1);
  assert.equal(player.time, 0.2);
  player.set(0.15);
  player.step(-1);
  assert.equal(player.time, 0.1);
  player.step(10);
  assert.equal(player.time, 0.5);
  player.step(1);
  assert.equal(player.time, 0.5);
  player.play();
  assert.equal(player.time, 0);
  player.setSpeed(2);
  player.advance(0.1);
  assert.ok(Math.abs(player.time - 0.2) < 1e-15);
  player.advance(0.2);
  assert.ok(Math.abs(player.time - 0.1) < 1e-12, 'begins again');
  player.setLoop(false);
  player.advance(1);
  assert.equal(player.time, 0.5);
  assert.equal(player.playing, false);
  player.changeSpeed(1);
  assert.equal(player.speed, 5);
  for (let i = 0; i < 20; ++i) player.changeSpeed(-1);
  assert.equal(player.speed, 0.01);
  player.set(NaN);
  assert.equal(player.time, 0.5);
});

test('stress: principal values solve the characteristic equation, von Mises follows from them', () => {
  let seed = 1;
  const random = (): number => ((seed = (16807 * seed) % 2147483647) / 2147483647) * 2 - 1;
  const cases = [...Array.from({ length: 100 }, () => Array.from({ length: 6 }, () => 300 * random())), [0, 0, 0, 0, 0, 0], [1, 1, 1, 0, 0, 0], [2, 1, 1, 0, 0, 0], [0, 0, 0, 5, 0, 0], [7, 7, -3, 0, 0, 0]];
  for (const [xx, yy, zz, xy, yz, zx] of cases) {
    const s = [xx, yy, zz, xy, yz, zx];
    const size = Math.max(1e-30, Math.hypot(...s));
    const [first, third] = principals(s);
    const second = xx + yy + zz - first - third;
    assert.ok(first >= second - 1e-6 * size && second >= third - 1e-6 * size);
    const squares = xx * xx + yy * yy + zz * zz + 2 * (xy * xy + yz * yz + zx * zx);
    assert.ok(Math.abs(first * first + second * second + third * third - squares) <= 1e-6 * size * size);
    const determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
    assert.ok(Math.abs(first * second * third - determinant) <= 1e-6 * size ** 3);
    const expected = Math.sqrt(0.5 * ((first - second) ** 2 + (second - third) ** 2 + (third - first) ** 2));
    assert.ok(Math.abs(vonMises(s) - expected) <= 1e-6 * size);
  }
});

test('stress: of a vertex in MPa, and its range over the run without doubtful vertices', () => {
  const data = scene();
  const body = data.bodies.find((candidate) => candidate.mesh?.stress)!;
  const stress = body.mesh!.stress!;
  const mesh = armMesh();
  const frame = Math.floor(data.time.length / 2);
  const at = frame * data.amplitudeCount + body.firstMode;
  for (const v of [5, 40, mesh.vertices.length / 3 - 1]) {
    const expected = [0, 0, 0, 0, 0, 0];
    for (let j = 0; j < body.modeCount; ++j) {
      stressOf(mesh.vertices[3 * v], mesh.vertices[3 * v + 1], mesh.vertices[3 * v + 2], j).forEach((s, c) => (expected[c] += 1e-6 * STRESS_UNIT * s * data.amplitudes![at + j]));
    }
    const found = stressAt(body, stress, v, data.amplitudes!, at, at - body.firstMode);
    found.forEach((s, c) => assert.ok(Math.abs(s - expected[c]) < 2e-3 * Math.hypot(...expected) + 1e-9));
  }
  // Against all vertices and frames.
  const field = body.mesh!.fields.find((candidate) => candidate.stress?.quantity === 'von_mises')!;
  const range = fieldRange(data, body, field)!;
  let largest = 0;
  for (let f = 0; f < data.time.length; ++f) for (let v = 2; v < mesh.vertices.length / 3; ++v) largest = Math.max(largest, vonMises(stressAt(body, stress, v, data.amplitudes!, f * data.amplitudeCount + body.firstMode, f * data.amplitudeCount)));
  assert.equal(range[0], 0);
  assert.ok(Math.abs(range[1] - largest) <= 0.02 * largest, `${range[1]} of ${largest}`);
  const envelope = body.mesh!.fields.find((candidate) => candidate.stress?.quantity === 'envelope')!;
  assert.deepEqual(fieldRange(data, body, envelope), [0, mesh.vertices.length / 3]);
});

test('lines of couplings go with the point they are fixed to; broken ones are said', () => {
  const { page, writer } = vehicle();
  const scene = page.scene!;
  scene.strokes = [
    { name: 'mesh', a: 0, points: writer.view('f32', [0, 0, 0, 1, 0, 0, 1, 1, 0], [3, 3]) },
    { name: 'broken', a: 0, points: writer.view('f32', [0, 0, NaN, 1, 0, 0], [2, 3]) },
    { name: 'nowhere', a: 100000, points: writer.view('f32', [0, 0, 0, 1, 0, 0], [2, 3]) },
  ];
  const said: string[] = [];
  const { strokes } = readScene(scene, 'run', new PageBuffer(writer.buffer()), (s) => said.push(s));
  assert.deepEqual(strokes.map((s) => s.name), ['mesh']);
  assert.equal(strokes[0].points.length, 9);
  assert.equal(said.length, 1);
  assert.match(said[0], /Line of "broken"/);
});
