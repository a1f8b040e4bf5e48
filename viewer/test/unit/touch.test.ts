import assert from 'node:assert/strict';
import { test } from 'node:test';
import { stretched } from '../../src/ui/touch';

test('two fingers hold their times', () => {
  // Times 2 and 4 at 100 and 200 of 400 pixels: the axis went from 0 to 8; apart twice as far it shows half of it.
  assert.deepEqual(stretched([2, 4], [100, 200], 400), [0, 8]);
  assert.deepEqual(stretched([2, 4], [50, 250], 400), [1.5, 5.5]);
  assert.deepEqual(stretched([4, 2], [250, 50], 400), [1.5, 5.5]);
  assert.equal(stretched([2, 4], [150, 152], 400), null);
  assert.equal(stretched([2, 4], [250, 50], 400), null);
});
