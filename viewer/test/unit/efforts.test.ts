// Numbers at each frame, and the scale that arrows have.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { PageBuffer } from '../../src/data/buffer';
import { Efforts, readEfforts } from '../../src/data/efforts';
import { formatEffort, niceAbove } from '../../src/data/format';
import type { ForceJson } from '../../src/data/page';
import type { SceneData } from '../../src/data/scene_data';
import { effortScale } from '../../src/scene/effort_arrows';

test('columns vary, constants follow them, and what is not there has no value', () => {
  const efforts = new Efforts([0, 1, 3], [1, 10, 2, NaN, 6, 30], 2, [7, null]);
  assert.equal(efforts.at(0, 0), 1);
  assert.equal(efforts.at(0, 2), 4);
  assert.equal(efforts.at(0, 3), 6);
  assert.ok(Number.isNaN(efforts.at(0, 3.1)) && Number.isNaN(efforts.at(0, -0.1)));
  assert.equal(efforts.at(1, 0), 10);
  assert.ok(Number.isNaN(efforts.at(1, 0.5)), 'next to what is no number');
  assert.equal(efforts.at(2, 2.2), 7);
  assert.ok(Number.isNaN(efforts.at(3, 0)) && Number.isNaN(efforts.at(4, 0)));
  assert.deepEqual([...efforts.history(0)], [1, 2, 6]);
});

test('of one state there are constants only', () => {
  const efforts = readEfforts({ data: null, constants: [3, -2] }, new PageBuffer(new Uint8Array(0)), [0.5], 1);
  assert.equal(efforts.at(0, 0.5), 3);
  assert.equal(efforts.between(1, 0, 0), -2);
});

function sceneOf(forces: number[][], masses: number[]): SceneData {
  const frames = forces.length;
  const wrench = { at: 0, columns: [0, 1, 2, 3, 4, 5] };
  return { efforts: new Efforts(Array.from({ length: frames }, (_, f) => f), forces.flat(), 6, []), forces: [{ picture: 'force', wrench } as ForceJson], bodies: masses.map((mass) => ({ mass })) } as unknown as SceneData;
}

test('the scale is round, shows what is usual, and holds the largest', () => {
  const quiet = Array.from({ length: 99 }, (_, k) => [0, 0, 100 + 0 * k, 0, 0, 0]);
  const scale = effortScale(sceneOf(quiet, [1]), 2);
  assert.equal(scale.torque, 0);
  assert.equal(scale.force, 500, '100 N are 0.2 m: a tenth of the model, and not more than a fifth');
  // One blow of fifty times the usual force is not longer than 0.7 of the model.
  const blow = effortScale(sceneOf([...quiet, [0, 5000, 0, 0, 0, 0]], [1]), 2);
  assert.ok(5000 / blow.force <= 1.4 && 5000 / blow.force > 0.5);
  const turned = effortScale(sceneOf([[0, 0, 0, 0, 3, 0]], [1]), 2);
  assert.ok((90 * 3) / turned.torque <= 150);
});

test('rounding is not blown up to arrows', () => {
  assert.deepEqual(effortScale(sceneOf([[0, 1e-12, 0, 0, 1e-13, 0]], [10]), 1), { force: 0, torque: 0 });
  assert.equal(effortScale(sceneOf([[0, 500, 0, 0, 1e-12, 0]], [10]), 1).torque, 0);
});

test('round numbers above, and prefixes of units', () => {
  assert.deepEqual([0.011, 1, 1.01, 2.5, 5.5, 99].map(niceAbove), [0.02, 1, 2, 5, 10, 100]);
  assert.equal(formatEffort(2500, 'N'), '2.5 kN');
  assert.equal(formatEffort(-0.02, 'N m'), '\u221220 mN m');
  assert.equal(formatEffort(0, 'N'), '0 N');
});
