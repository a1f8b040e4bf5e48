// Arrows and arcs as large as what they stand for, and what takes clicks.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import type { Browser, Page } from 'playwright-core';
import { ANGLES, efforts, SPRING_LENGTHS } from '../pages/efforts';
import { fillTemplate } from '../pages/writer';
import { launch, open, snap, template, write } from '../browser';

let browser: Browser;
let page: Page;
let errors: string[];

before(async () => {
  browser = await launch();
  const made = efforts();
  ({ page, errors } = await open(browser, write('efforts', fillTemplate(template(), made.page, made.writer)), { still: true }));
  await page.getByLabel('Forces', { exact: true }).check();
  await page.getByLabel('Joints', { exact: true }).check();
  await page.getByRole('button', { name: 'Side', exact: true }).click();
});
after(async () => browser?.close());

interface Spot {
  count: number;
  left: number;
  right: number;
  top: number;
  bottom: number;
}

/** Where the picture at a time has the colour of arrows (red) or of arcs (violet). */
async function spot(time: number, colour: 'red' | 'violet'): Promise<Spot> {
  return page.evaluate(
    async ([t, red]) => {
      window.floatframe!.setTime(t as number);
      const image = new Image();
      image.src = window.floatframe!.screenshot()!;
      await image.decode();
      const canvas = document.createElement('canvas');
      [canvas.width, canvas.height] = [image.width, image.height];
      const context = canvas.getContext('2d')!;
      context.drawImage(image, 0, 0);
      const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
      const found = { count: 0, left: Infinity, right: -Infinity, top: Infinity, bottom: -Infinity };
      for (let y = 0; y < canvas.height; ++y) {
        for (let x = 0; x < canvas.width; ++x) {
          const [r, g, b] = data.subarray(4 * (y * canvas.width + x));
          if (!(red ? r > 1.8 * b && r > 1.8 * g && r > 110 : b > 1.4 * g && r > 1.15 * g && b > 100)) continue;
          ++found.count;
          found.left = Math.min(found.left, x);
          found.right = Math.max(found.right, x);
          found.top = Math.min(found.top, y);
          found.bottom = Math.max(found.bottom, y);
        }
      }
      return found;
    },
    [time, colour === 'red'] as const,
  );
}

test('an arrow is as long as its force, points as it does, and is not there without a value', async () => {
  await snap(page, 'efforts');
  assert.equal((await spot(0, 'red')).count, 0, 'no force');
  assert.equal((await spot(3, 'red')).count, 0, 'no value');
  const one = await spot(1, 'red');
  const two = await spot(2, 'red');
  const length = (s: Spot): number => s.bottom - s.top;
  assert.ok(one.count > 50);
  assert.ok(Math.abs(length(two) / length(one) - 2) < 0.06, `${length(one)} and ${length(two)} pixels`);
  // Between frames, too.
  const between = await spot(1.5, 'red');
  assert.ok(Math.abs(length(between) / length(one) - 1.5) < 0.06);
  // Upwards from its point, downwards, and to the right: as long.
  const down = await spot(5, 'red');
  assert.ok(Math.abs(down.top - two.bottom) < 14, 'both begin at the point');
  assert.ok(Math.abs(length(down) / length(two) - 1) < 0.06);
  const right = await spot(4, 'red');
  assert.ok(Math.abs((right.right - right.left) / length(two) - 1) < 0.06);
  assert.ok(length(right) < 0.3 * length(two));
});

test('an arc is as wide as its torque, and turns as it does', async () => {
  assert.equal((await spot(0, 'violet')).count, 0);
  assert.equal((await spot(3, 'violet')).count, 0);
  const one = await spot(1, 'violet');
  const two = await spot(2, 'violet');
  assert.ok(one.count > 30 && two.count > 1.5 * one.count, `${one.count} and ${two.count} pixels`);
  assert.ok(Math.abs((await spot(4, 'violet')).count / two.count - 1) < 0.1, 'the other way round');
  const angles = await page.evaluate(() =>
    [1, 2].map((t) => {
      window.floatframe!.setTime(t);
      return window.floatframe!.effortDrawn('twist')!.angle;
    }),
  );
  const { torque } = (await page.evaluate(() => window.floatframe!.effortScale))!;
  assert.ok(Math.abs(angles[0] - (Math.PI / 2) / torque) < 1e-9);
  assert.ok(Math.abs(angles[1] - 2 * angles[0]) < 1e-9);
});

test('the key states the scale, which holds at all instants', async () => {
  const { force, torque } = (await page.evaluate(() => window.floatframe!.effortScale))!;
  for (const [t, size] of [[1, 10], [2, 20], [5, 20]]) {
    const drawn = await page.evaluate((time) => {
      window.floatframe!.setTime(time);
      return window.floatframe!.effortDrawn('push')!;
    }, t);
    assert.ok(Math.abs(Math.hypot(...drawn.to.map((x, i) => x - drawn.from[i])) - size / force) < 1e-9);
  }
  assert.equal(await page.evaluate(() => window.floatframe!.effortDrawn('silent')), null);
  const key = page.locator('.arrow-key');
  assert.match((await key.textContent())!, new RegExp(`1 m = ${force} N.*90° = ${torque} N m`));
  // The sample of the key and the bar of lengths agree.
  const sample = (await page.locator('.arrow-key-shaft').boundingBox())!.width * (await metresOfPixel());
  const newtons = parseFloat((await page.locator('.arrow-key-shaft + span').textContent())!);
  assert.ok(Math.abs((sample * force) / newtons - 1) < 0.03);
  await page.getByLabel('Forces', { exact: true }).uncheck();
  assert.ok(await key.isHidden());
  await page.getByLabel('Forces', { exact: true }).check();
});

/** Metres of a pixel, by the bar of lengths. */
async function metresOfPixel(): Promise<number> {
  const text = (await page.locator('.scale-text').textContent())!;
  return (parseFloat(text) * (text.endsWith('mm') ? 1e-3 : 1)) / (await page.locator('.scale-bar').boundingBox())!.width;
}

/** Clicks on a place of the plane y = 0. */
async function click(x: number, z: number): Promise<void> {
  const box = (await page.locator('canvas.canvas').boundingBox())!;
  const pixel = await metresOfPixel();
  const centre = await page.evaluate(() => window.floatframe!.cameraTarget()!);
  await page.mouse.click(box.x + box.width / 2 + (x - centre[0]) / pixel, box.y + box.height / 2 - (z - centre[2]) / pixel);
}

const selection = (): Promise<{ body: number | null; part: string | null }> =>
  page.evaluate(() => ({ body: window.floatframe!.selected?.body ?? null, part: window.floatframe!.selectedPart?.name ?? null }));

test('glass lets clicks through to what is behind it', async () => {
  await click(0, 0);
  assert.deepEqual(await selection(), { body: 0, part: null }, 'the core in the glass');
  await click(0.4, 0.3);
  assert.deepEqual(await selection(), { body: null, part: 'coil' }, 'the spring in the glass');
  await click(-0.45, -0.45);
  assert.deepEqual(await selection(), { body: 1, part: null }, 'nothing behind: the glass itself');
});

test('springs, joints and forces are picked and show their values at the time of the view', async () => {
  const panel = page.locator('.selection');
  const value = async (time: number, name: string): Promise<string> => {
    await page.evaluate((t) => window.floatframe!.setTime(t), time);
    return (await panel.locator('tr', { hasText: name }).locator('td').textContent())!;
  };
  await click(0.4, 0.3);
  for (const t of [1, 4]) assert.equal(await value(t, 'length'), `${SPRING_LENGTHS[t]} m`);
  await panel.locator('.u-over').first().waitFor();
  await click(1.6, 0);
  assert.deepEqual(await selection(), { body: null, part: 'hinge' });
  assert.equal(await panel.locator('h3').first().textContent(), 'hinge');
  assert.equal(await value(2, 'position'), `${ANGLES[2].toFixed(3)} rad (60°)`);
  // By its arrow, at its middle.
  await page.evaluate(() => window.floatframe!.setTime(2));
  const drawn = (await page.evaluate(() => window.floatframe!.effortDrawn('push')))!;
  await click(drawn.from[0], (drawn.from[2] + drawn.to[2]) / 2);
  assert.deepEqual(await selection(), { body: null, part: 'push' });
  assert.equal(await value(2, 'force on post'), '20 N: 0, 0, 20');
  assert.equal(await value(3, 'force on post'), 'not known');
  await page.keyboard.press('Escape');
  assert.deepEqual(await selection(), { body: null, part: null });
  assert.deepEqual(errors, []);
});
