// Surfaces of reduced parts coloured by stress.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import type { Browser, Page } from 'playwright-core';
import { reduce } from '../pages/others';
import { fillTemplate } from '../pages/writer';
import { launch, open, snap, template, write } from '../browser';

let browser: Browser;
const html = template();

before(async () => (browser = await launch()));
after(async () => browser?.close());

function path(name: string, made: ReturnType<typeof reduce>): string {
  return write(name, fillTemplate(html, made.page, made.writer));
}

async function at(page: Page, time: number): Promise<void> {
  await page.evaluate((t) => window.floatframe!.setTime(t), time);
}

/** Parts of the picture in the colours of the lower end, the middle and the upper end of the scale. */
async function coloursOf(page: Page): Promise<number[]> {
  const url = (await page.evaluate(() => window.floatframe!.screenshot()))!;
  return page.evaluate(async (source) => {
    const image = new Image();
    image.src = source;
    await image.decode();
    const canvas = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height });
    const context = canvas.getContext('2d')!;
    context.drawImage(image, 0, 0);
    // Without the legend at the edge.
    const [x, y, w, h] = [0.25, 0.25, 0.5, 0.5].map((part, k) => Math.round(part * (k % 2 ? image.height : image.width)));
    const { data } = context.getImageData(x, y, w, h);
    const count = [0, 0, 0];
    for (let i = 0; i < data.length; i += 4) {
      const [r, g, b] = data.subarray(i, i + 3);
      if (r > 1.5 * g && b > 1.3 * r * 0.8 && b > 25) ++count[0];
      else if (g > 2 * r && g > 0.8 * b && b > 0.7 * g && g > 30) ++count[1];
      else if (r > 2 * b && g > 2 * b && r > 60) ++count[2];
    }
    return count.map((n) => n / (w * h));
  }, url);
}

test('stress: of a reduced part in parts of the largest of the mode that swings', async () => {
  const { page, errors } = await open(browser, path('reduce_stress', reduce()));
  await page.getByRole('button', { name: /31.2 Hz/ }).click();
  await page.getByRole('tab', { name: 'Display' }).click();
  await page.getByLabel('Edges', { exact: true }).uncheck();
  await page.getByLabel('Colour by').selectOption({ label: 'Von Mises stress' });
  assert.match((await page.locator('.legend').textContent())!, /Von Mises stress of the mode, relative/);
  // The same everywhere: at a quarter of the swing the largest, at a twelfth half of it.
  await at(page, 0.5);
  const most = await coloursOf(page);
  assert.ok(most[2] > 0.02 && most[0] + most[1] < 0.1 * most[2], `largest: ${most}`);
  await at(page, 1 / 6);
  const half = await coloursOf(page);
  assert.ok(half[1] > 0.02 && half[0] + half[2] < 0.1 * half[1], `half: ${half}`);
  await snap(page, 'stress_reduce');
  // Another mode has another stress, and a largest of its own.
  await page.evaluate(() => window.floatframe!.chooseMode(2));
  await at(page, 0.5);
  const other = await coloursOf(page);
  assert.ok(other[2] > 0.02 && other[0] + other[1] < 0.1 * other[2], `another mode: ${other}`);
  assert.deepEqual(errors, []);
  await page.context().close();
});
