// Surfaces coloured by stress.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import type { Browser, Page } from 'playwright-core';
import { loadAt, motionAt, STRESS_UNIT, vehicle } from '../pages/vehicle';
import { fillTemplate } from '../pages/writer';
import { principals, vonMises } from '../../src/motion/stress';
import { launch, open, snap, template, write } from '../browser';

let browser: Browser;
const html = template();

before(async () => (browser = await launch()));
after(async () => browser?.close());

function path(name: string, made: ReturnType<typeof vehicle>): string {
  return write(name, fillTemplate(html, made.page, made.writer));
}

async function at(page: Page, time: number): Promise<void> {
  await page.evaluate((t) => window.floatframe!.setTime(t), time);
}

/** One arm alone, without anything that has colours of its own. */
async function showArm(page: Page): Promise<void> {
  await page.getByRole('tab', { name: 'Bodies' }).click();
  await page.getByRole('button', { name: 'Show only front_left_arm' }).click();
  await page.getByRole('button', { name: 'Fit' }).click();
  for (const layer of ['Edges', 'Ground', 'Road', 'Springs, rods, couplings', 'Tyres']) {
    await page.getByRole('tab', { name: 'Display' }).click();
    await page.getByLabel(layer, { exact: true }).uncheck();
  }
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

test('stress: the shader draws what the formulas say, the scale is fixed and can be typed, a picked node shows its largest', async () => {
  // The same stress everywhere on an arm, in its first mode and of its inertia.
  const uniform = [300, -120, 50, 200, -90, 60];
  const load = [-40, 260, 110, -70, 30, 180];
  const { page, errors } = await open(browser, path('stress', vehicle({ uniform, load })));
  await at(page, 1.6);
  const stress = uniform.map((s, c) => 1e-6 * STRESS_UNIT * (s * motionAt(1.6).amplitudes[0] + load[c] * loadAt(1.6)));
  await showArm(page);
  const colours = (): Promise<number[]> => coloursOf(page);
  const [first, third] = principals(stress);
  for (const [label, value] of [['Von Mises stress', vonMises(stress)], ['Principal stress 1', first], ['Principal stress 3', third]] as const) {
    await page.getByLabel('Colour by').selectOption({ label });
    assert.match((await page.locator('.legend').textContent())!, new RegExp(`${label} \\[MPa\\]`));
    const near = 0.1 * Math.abs(value);
    const type = async (low: number, high: number): Promise<void> => {
      // The other end first where the two would cross.
      await page.getByLabel('Upper end of the scale').fill(String(1e9));
      await page.getByLabel('Upper end of the scale').blur();
      for (const [end, limit] of [['Lower', low], ['Upper', high]] as const) {
        await page.getByLabel(`${end} end of the scale`).fill(String(limit));
        await page.getByLabel(`${end} end of the scale`).blur();
      }
    };
    await type(value - near, value + near);
    await snap(page, 'stress');
    const middle = await colours();
    assert.ok(middle[1] > 0.02 && middle[0] + middle[2] < 0.1 * middle[1], `${label} in the middle: ${middle}`);
    await type(value + 0.2 * near, value + 3 * near);
    const below = await colours();
    assert.ok(below[0] > 0.02 && below[1] + below[2] < 0.1 * below[0], `${label} below: ${below}`);
    await type(value - 3 * near, value - 0.2 * near);
    const above = await colours();
    assert.ok(above[2] > 0.02 && above[0] + above[1] < 0.1 * above[2], `${label} above: ${above}`);
    const legend = await page.locator('.legend').textContent();
    await at(page, 2.4);
    assert.equal(await page.locator('.legend').textContent(), legend);
    await at(page, 1.6);
  }
  await page.getByLabel('Colour by').selectOption({ label: 'Von Mises stress, largest of the run' });
  assert.match((await page.locator('.legend').textContent())!, /largest of the run \[MPa\]/);
  assert.deepEqual(errors, []);
  await page.context().close();
});

test('stress: what is not to be trusted is grey, and the legend says what is shown', async () => {
  const uniform = [300, -120, 50, 200, -90, 60];
  const note = '.legend-note';
  for (const doubtful of [false, true]) {
    const made = vehicle({ uniform });
    const all = made.writer.view('u32', Array.from({ length: 4000 }, (_, v) => v));
    for (const body of made.page.scene!.bodies) {
      if (!body.stress) continue;
      body.stress.doubtful = doubtful ? all : null;
      body.stress.several = doubtful;
      body.stress.all_instants = doubtful;
    }
    if (doubtful) made.page.scene!.bodies[0].stress_left_out = 14_200_000;
    const { page, errors } = await open(browser, path(`doubtful_${doubtful}`, made));
    await at(page, 1.6);
    await showArm(page);
    for (const label of ['Von Mises stress', 'Principal stress 1', 'Von Mises stress, largest of the run']) {
      await page.getByLabel('Colour by').selectOption({ label });
      // All of it above the scale: yellow, if it is coloured.
      await page.getByLabel('Lower end of the scale').fill('-1e9');
      await page.getByLabel('Lower end of the scale').blur();
      await page.getByLabel('Upper end of the scale').fill('-1e8');
      await page.getByLabel('Upper end of the scale').blur();
      const found = await coloursOf(page);
      if (doubtful) assert.ok(found[0] + found[1] + found[2] < 0.002, `${label}: ${found}`);
      else assert.ok(found[2] > 0.02, `${label}: ${found}`);
      const says = (await page.locator(note).textContent())!;
      assert.equal(/Grey: .*not to be trusted/.test(says), doubtful, says);
      const envelope = label.includes('largest');
      assert.equal(/the largest\./.test(says), doubtful && envelope, says);
      assert.equal(/the one that the modes load most/.test(says), doubtful && !envelope, says);
      assert.equal(/more were recorded/.test(says), envelope && !doubtful, says);
    }
    await snap(page, `stress_doubtful_${doubtful}`);
    const leftOut = page.getByText('Stress is left out for its size: chassis (14.2 million numbers)');
    assert.equal(await leftOut.count(), doubtful ? 1 : 0);
    assert.deepEqual(errors, []);
    await page.context().close();
  }
});
