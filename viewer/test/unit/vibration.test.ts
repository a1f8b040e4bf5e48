import assert from 'node:assert/strict';
import { test } from 'node:test';
import { PageBuffer } from '../../src/data/buffer';
import type { PageJson } from '../../src/data/page';
import { readScene, type SceneData } from '../../src/data/scene_data';
import { Motion } from '../../src/motion/motion';
import { drawingOf, ellipse, LARGEST_TURN, PART_OF_MODEL, restOf, swing } from '../../src/motion/vibration';
import { HEAVE, modes } from '../pages/vibrations';
import type { BufferWriter } from '../pages/writer';

function read({ page, writer }: { page: PageJson; writer: BufferWriter }): { scene: SceneData; said: string[] } {
  const said: string[] = [];
  return { scene: readScene(page.scene!, page.kind, new PageBuffer(writer.buffer()), (s) => said.push(s)), said };
}

const near = (a: ArrayLike<number>, b: ArrayLike<number>, tolerance: number): void => {
  for (let i = 0; i < b.length; ++i) assert.ok(Math.abs(a[i] - b[i]) <= tolerance, `${a[i]} and ${b[i]} at ${i}`);
};

test('the largest place of a cos - b sin, and its angle', () => {
  const cases: [number[], number[]][] = [
    [[1, 0, 0], [0, 1, 0]],
    [[1, 2, -1], [0, 0, 0]],
    [[0, 0, 0], [3, 4, 0]],
    [[1, 0.5, 0.2], [-0.3, 1.4, 2]],
    [[-2, 1, 0], [-2, 1, 0]],
  ];
  for (const [a, b] of cases) {
    const { size, phase } = ellipse(a, b);
    const length = (angle: number): number => Math.hypot(...a.map((x, i) => x * Math.cos(angle) - b[i] * Math.sin(angle)));
    let most = 0;
    for (let k = 0; k < 3600; ++k) most = Math.max(most, length((k * Math.PI) / 3600));
    assert.ok(Math.abs(size - most) < 2e-6 * most, `${size} and ${most}`);
    assert.ok(Math.abs(length(phase) - size) < 1e-12 * size);
  }
});

test('a shape in one phase swings through its largest, whatever its angle in the complex plane', () => {
  const { scene, said } = read(modes());
  assert.deepEqual(said, []);
  const motion = new Motion(scene);
  const rest = restOf(motion);
  const drawing = drawingOf(scene, rest, scene.vibrations[1], 10);
  const f = (z: number): number => (z - rest.position[2]) / 2;
  swing(motion, rest, scene.vibrations[1], drawing, 1, 0);
  const largest = f(motion.position[2]);
  assert.ok(largest > 0);
  for (const [scale, angle] of [[1, 0], [1, 1.1], [2.5, Math.PI]]) {
    swing(motion, rest, scene.vibrations[1], drawing, scale, angle);
    const q = largest * scale * Math.cos(angle);
    HEAVE.places.forEach((row, b) => {
      for (let i = 0; i < 3; ++i) assert.ok(Math.abs(motion.position[3 * b + i] - rest.position[3 * b + i] - q * row[i]) < 1e-6);
      // The turn from rest: its axis and its angle.
      const [x, y, z, w] = rest.quaternion.subarray(4 * b, 4 * b + 4);
      const [X, Y, Z, W] = motion.quaternion.subarray(4 * b, 4 * b + 4);
      const vector = [-W * x + X * w - Y * z + Z * y, -W * y + X * z + Y * w - Z * x, -W * z - X * y + Y * x + Z * w];
      const turn = Math.hypot(row[3], row[4], row[5]) * q;
      near(vector, [3, 4, 5].map((i) => (turn === 0 ? 0 : (Math.sin(turn / 2) * row[i] * q) / turn)), 1e-6);
      assert.ok(Math.abs(Math.hypot(X, Y, Z, W) - 1) < 1e-9);
    });
    near(motion.amplitudes, HEAVE.amplitudes.map((a, j) => rest.amplitudes[j] + q * a), 1e-6);
  }
});

test('amplitudes of drawing: a part of the model for what moves most, at most a small turn', () => {
  const { scene } = read(modes());
  const motion = new Motion(scene);
  const rest = restOf(motion);
  for (const vibration of scene.vibrations) {
    for (const size of [1, 7]) {
      const drawing = drawingOf(scene, rest, vibration, size);
      const turn = Math.max(...scene.bodies.map((body) => drawing.factor * Math.hypot(...vibration.real.subarray(6 * body.index + 3, 6 * body.index + 6))));
      assert.ok(turn <= LARGEST_TURN * (1 + 1e-9));
      if (turn < LARGEST_TURN * (1 - 1e-9)) assert.ok(Math.abs(drawing.largest - PART_OF_MODEL * size) < 1e-9);
      // To first order the mesh vertices move no farther.
      swing(motion, rest, vibration, drawing, 1e-3, 0);
      let most = 0;
      for (let b = 0; b < scene.bodies.length; ++b) most = Math.max(most, Math.hypot(...[0, 1, 2].map((i) => motion.position[3 * b + i] - rest.position[3 * b + i])));
      assert.ok(most <= 1e-3 * drawing.largest * (1 + 1e-6));
    }
  }
});

test('a whirl goes the way of its shape', () => {
  const { scene } = read(modes());
  const motion = new Motion(scene);
  const rest = restOf(motion);
  const drawing = drawingOf(scene, rest, scene.vibrations[2], 5);
  const places: number[][] = [];
  for (const angle of [0, 0.5, 1, 1.5]) {
    swing(motion, rest, scene.vibrations[2], drawing, 1, angle);
    places.push([motion.position[0] - rest.position[0], motion.position[1] - rest.position[1]]);
  }
  for (let k = 1; k < places.length; ++k) {
    const [[a, b], [x, y]] = [places[k - 1], places[k]];
    assert.ok(Math.abs(Math.hypot(x, y) - PART_OF_MODEL * 5) < 1e-6);
    assert.ok(Math.abs(Math.atan2(a * y - b * x, a * x + b * y) - 0.5) < 1e-6);
  }
});

test('vibrations that do not fit are said, the model stays', () => {
  const wrong = modes();
  wrong.page.scene!.vibrations!.places.shape = [5, 2, 9, 6];
  const first = read(wrong);
  assert.equal(first.scene.vibrations.length, 0);
  assert.match(first.said.join(' '), /Shapes of the vibrations: the shape is/);
  assert.equal(first.scene.bodies.length, 10);

  const broken = modes();
  const at = broken.page.scene!.vibrations!.places.offset;
  const bytes = Buffer.from(broken.writer.buffer());
  bytes.writeFloatLE(NaN, at + 4 * 125);
  const said: string[] = [];
  const scene = readScene(broken.page.scene!, 'modes', new PageBuffer(bytes), (s) => said.push(s));
  assert.deepEqual(scene.vibrations.map((v) => v.number), [null, 2, 3, 4]);
  assert.match(said.join(' '), /shape of one vibration is left out/);
});
