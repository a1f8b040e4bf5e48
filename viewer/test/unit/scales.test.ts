import assert from 'node:assert/strict';
import { test } from 'node:test';
import { distinctTexts, tickText } from '../../src/data/format';
import { PageBuffer } from '../../src/data/buffer';
import { mainEffect, rankedRuns, readStudy } from '../../src/data/study';
import { hotSpotsOf } from '../../src/motion/hot_spots';
import { quantile } from '../../src/motion/scale_ranges';
import { keepFree, placeBeside } from '../../src/scene/labels';
import { mapColour, mapName, mapStops, spreadOf } from '../../src/scene/palette';
import { roundTicks } from '../../src/ui/chart';
import { tickParts } from '../../src/ui/legend';
import { rateText } from '../../src/ui/player_bar';
import type { BodyData } from '../../src/data/scene_data';
import { sweep } from '../pages/others';

const number = (text: string): number => Number(text.replace(/\u2212/g, '-'));

test('numbers along an axis are those of their ticks, whatever the range', () => {
  for (const [low, high] of [[0, 1], [1199.9998, 1200.0004], [1e6, 2.2e6], [-3e-7, 5e-7], [4.3100125, 4.3100225], [-12345.7, -12345.2], [1e6, 1000002]]) {
    for (const most of [3, 5, 9]) {
      const ticks = roundTicks(low, high, most);
      const texts = tickText(ticks);
      assert.equal(new Set(texts).size, ticks.length, `${texts}`);
      const step = ticks.length > 1 ? ticks[1] - ticks[0] : 1;
      texts.forEach((text, k) => assert.ok(Math.abs(number(text) - ticks[k]) <= 2e-3 * step, `${text} at ${ticks[k]}`));
    }
  }
});

test('ends of a scale differ in their numbers', () => {
  assert.deepEqual(distinctTexts([100.1, 100.15, 100.2], 3), ['100.1', '100.15', '100.2']);
  assert.deepEqual(distinctTexts([0, 8.587, 17.174], 3), ['0', '8.59', '17.2']);
  assert.deepEqual(distinctTexts([2, 2], 3), ['2', '2']);
});

test('maps: bands hold one colour each, what is above a limit lies beyond the spread', () => {
  const name = mapName({ base: 'turbo', bands: 10, over: false });
  const stops = mapStops(name);
  assert.equal(stops.length, 20);
  for (let k = 0; k < 10; ++k) assert.deepEqual(mapColour(name, (k + 0.02) / 10), mapColour(name, (k + 0.98) / 10));
  assert.equal(new Set(stops.map(([, colour]) => colour)).size, 10);
  // The shader takes texel floor(255 part + 1/2): the last one from the limit on.
  const [low, high] = spreadOf([-20, 235], mapName({ base: 'viridis', bands: 0, over: true }));
  const texel = (value: number): number => Math.floor((255 * (value - low)) / (high - low) + 0.5);
  assert.equal(texel(235.001), 255);
  assert.equal(texel(234.999), 254);
  assert.deepEqual(tickParts('turbo'), [0, 0.5, 1]);
  assert.equal(tickParts('turbo/12').length, 5);
});

test('a part of the values lies below their quantile', () => {
  const values = Array.from({ length: 101 }, (_, k) => (37 * k) % 101);
  assert.equal(quantile(values, 0.98), 98);
  assert.equal(quantile([4], 0.5), 4);
  assert.equal(quantile([1, 2], 0.5), 1.5);
});

test('hot spots are hotter than all next to them; vertices of a node count as one, doubtful ones not', () => {
  // A strip of vertices 0 to 5, triangles along it; 2 and 5 are of one node.
  const envelope = Float32Array.from([3, 5, 1, 9, 2, 7]);
  const mesh = { nodes: Uint16Array.from([10, 11, 12, 13, 14, 12]), triangles: Uint16Array.from([0, 1, 2, 1, 2, 3, 2, 3, 4]), stress: { envelope, when: Float32Array.from([0, 1, 2, 3, 4, 5]), doubtful: null as Uint8Array | null } };
  const body = { index: 3, mesh } as unknown as BodyData;
  assert.deepEqual(hotSpotsOf(body), [{ body: 3, vertex: 3, node: 13, stress: 9, time: 3 }]);
  // Without the hottest, its neighbours may be.
  mesh.stress.doubtful = Uint8Array.from([0, 0, 0, 1, 0, 0]);
  assert.deepEqual(hotSpotsOf(body).map(({ vertex, time }) => [vertex, time]), [[5, 5]]);
});

test('names take the nearest free place within the picture, or none', () => {
  keepFree([{ left: 0, top: 0, right: 400, bottom: 40 }], 400, 300);
  const taken: Parameters<typeof placeBeside>[3] = [];
  let shown = 0;
  for (let k = 0; k < 40; ++k) {
    const place = placeBeside(80, 200 + (k % 3), 150, taken);
    if (!place) continue;
    ++shown;
    for (const other of taken) assert.ok(place.box.left >= other.right || place.box.right <= other.left || place.box.top >= other.bottom || place.box.bottom <= other.top);
    taken.push(place.box);
  }
  assert.ok(shown >= 8, `${shown} names`);
  // Near the right edge a name stands left of its point; below the tools it does not cover them.
  const edge = placeBeside(80, 390, 200, [])!;
  assert.ok(edge.side === 'left' && edge.box.right <= 390);
  assert.ok(placeBeside(80, 200, 45, [])!.box.top >= 40);
  keepFree([], Infinity, Infinity);
});

test('the rate says what is played', () => {
  assert.equal(rateText(60, 0.99, 1), '60 fps, 1×');
  assert.equal(rateText(3, 0.62, 1), '3 fps, 0.62×');
  assert.equal(rateText(60, 1, 1, 25), '60 fps, 0.02× real');
  assert.equal(rateText(60, 1, 1, null), '60 fps');
});

test('a study: ranks and means of completed runs', () => {
  const { page, writer } = sweep();
  const study = readStudy(page.study!, new PageBuffer(new Uint8Array(writer.buffer())));
  assert.equal(study.ranking!.measure, 1);
  assert.deepEqual(rankedRuns(study, 1, false).slice(0, 2), [8, 9]);
  assert.equal(rankedRuns(study, 1, true)[0], 1);
  assert.ok(!rankedRuns(study, 0, false).includes(11));
  const runs = rankedRuns(study, 1, false);
  const effect = mainEffect(study.variables[0], study.measures[1].values, runs);
  assert.deepEqual(effect.map(({ level, runs: n }) => [level, n]), [['1000', 3], ['10000', 3], ['100000', 3], ['1000000', 2]]);
  assert.deepEqual(effect.map(({ mean }) => Math.round(1e6 * mean)), [28 / 3, 22 / 3, 16 / 3, 4.5].map((v) => Math.round(1e6 * v)));
  assert.deepEqual(mainEffect(study.variables[1], study.measures[1].values, runs).map(({ level }) => level), ['bump', 'stairs', 'smooth']);
});
