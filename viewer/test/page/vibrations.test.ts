// Pages of vibrations in a headless browser.

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import type { Browser, Page } from 'playwright-core';
import { folder, launch, open, template, write } from '../browser';
import { modeShape } from '../pages/shapes';
import { ARM, armMesh, armVertex, motionAt, ORIGIN } from '../pages/vehicle';
import { HEAVE, modes } from '../pages/vibrations';
import { fillTemplate } from '../pages/writer';

let browser: Browser;
const html = template();
const program = process.env.FLOATFRAME_PROGRAM ?? '../build/floatframe';

before(async () => (browser = await launch()));
after(async () => browser?.close());

function path(name: string, made: ReturnType<typeof modes>): string {
  return write(name, fillTemplate(html, made.page, made.writer));
}

async function place(page: Page, time: number, body: number, local: number[]): Promise<number[]> {
  return page.evaluate(([t, b, p]) => (window.floatframe!.setTime(t as number), window.floatframe!.worldPosition(b as number, p as [number, number, number])!), [time, body, local] as const);
}

async function vertex(page: Page, time: number, body: number, index: number): Promise<number[]> {
  return page.evaluate(([t, b, v]) => (window.floatframe!.setTime(t), window.floatframe!.vertexPosition(b, v)!), [time, body, index] as const);
}

/** v turned by a rotation vector (Rodrigues). */
function turnedBy(r: number[], v: number[]): number[] {
  const angle = Math.hypot(...r);
  if (angle === 0) return v;
  const n = r.map((x) => x / angle);
  const dot = n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
  const cross = [n[1] * v[2] - n[2] * v[1], n[2] * v[0] - n[0] * v[2], n[0] * v[1] - n[1] * v[0]];
  return v.map((x, i) => x * Math.cos(angle) + cross[i] * Math.sin(angle) + n[i] * dot * (1 - Math.cos(angle)));
}

function turned(q: number[], v: number[]): number[] {
  const [x, y, z, w] = q;
  const t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])];
  return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2], v[2] + w * t[2] + x * t[1] - y * t[0]];
}

test('vertices move as the shape says: displaced, turned, bent', async () => {
  const { page, errors, requests } = await open(browser, path('modes', modes()), { still: true });
  assert.deepEqual(await page.evaluate(() => window.floatframe!.problems), []);
  // The first that is no rigid motion.
  assert.equal(await page.evaluate(() => window.floatframe!.mode), 1);
  const rest = motionAt(0);
  const mesh = armMesh();
  const index = mesh.vertices.length / 3 - 3;
  const local = armVertex(mesh, index);
  const shape = Array.from({ length: 6 }, (_, j) => modeShape(j, ARM, local[0], local[1], local[2]));
  for (const scale of [1, 0.4]) {
    await page.evaluate((s) => window.floatframe!.setScale(s), scale);
    const origin = rest.bodies[0].position.map((x, i) => x + ORIGIN[i]);
    const full = ((await place(page, 0, 0, [0, 0, 0]))[2] - origin[2]) / 2;
    assert.ok(full > 0.01 * scale, String(full));
    for (const time of [0, 0.3, 0.5, 1.25]) {
      const q = full * Math.cos(Math.PI * time);
      for (const arm of [1, 2]) {
        const row = HEAVE.places[arm];
        const bent = local.map((x, i) => x + shape.reduce((sum, u, j) => sum + u[i] * (rest.amplitudes[6 * (arm - 1) + j] + q * HEAVE.amplitudes[6 * (arm - 1) + j]), 0));
        const { position, quaternion } = rest.bodies[arm];
        const about = turnedBy(row.slice(3).map((x) => q * x), turned(quaternion, bent));
        const found = await vertex(page, time, arm, index);
        for (let i = 0; i < 3; ++i) {
          const expected = position[i] + ORIGIN[i] + q * row[i] + about[i];
          // Half floats of the shapes, floats of places 100 m away.
          assert.ok(Math.abs(found[i] - expected) < 3e-5, `${found[i]} for ${expected} at ${time} of body ${arm}`);
        }
      }
      // A spring's end follows.
      const seat = await page.evaluate(() => window.floatframe!.pointPosition(4)!);
      const chassis = await page.evaluate(() => window.floatframe!.worldPosition(0, [0.9, 0.44, 0.12])!);
      for (let i = 0; i < 3; ++i) assert.ok(Math.abs(seat[i] - chassis[i]) < 1e-9);
    }
  }
  assert.deepEqual(errors, []);
  assert.deepEqual(requests, []);
  await page.context().close();
});

test('modes are chosen by pointer and keys; the title says frequency and damping', async () => {
  const { page, errors } = await open(browser, path('modes', modes()), { still: true });
  const caption = page.locator('.view-caption');
  assert.equal(await caption.textContent(), 'Mode 1: 1.523 Hz, damping 37 %');
  assert.match(await page.title(), /vehicle/);
  assert.equal(await page.locator('.kind').textContent(), 'Vibrations');
  assert.equal(await page.locator('.mode').count(), 5);
  // Motion that was asked not to be shown waits to be started.
  assert.equal(await page.evaluate(() => window.floatframe!.time), 0);
  await page.waitForTimeout(400);
  assert.equal(await page.evaluate(() => window.floatframe!.time), 0);
  await page.keyboard.press('ArrowDown');
  assert.equal(await caption.textContent(), 'Mode 2: 10.25 Hz, damping −2 %, unstable');
  // It whirls from x to y.
  const rest = motionAt(0).bodies[0].position;
  const first = (await place(page, 0, 0, [0, 0, 0])).map((x, i) => x - rest[i] - ORIGIN[i]);
  const second = (await place(page, 0.5, 0, [0, 0, 0])).map((x, i) => x - rest[i] - ORIGIN[i]);
  const size = Math.hypot(...first);
  assert.ok(Math.abs(first[0] * second[0] + first[1] * second[1]) < 1e-4 * size * size);
  assert.ok(first[0] * second[1] - first[1] * second[0] > 0.999 * size * size);
  await page.keyboard.press('ArrowDown');
  assert.equal(await caption.textContent(), 'Mode 3: decays without swinging, by e in 0.25 s');
  await page.getByRole('button', { name: /31 Hz.*front_left_wheel 100 %/ }).click();
  assert.equal(await caption.textContent(), 'Mode 4: 31 Hz, damping 0 %');
  await page.keyboard.press('ArrowUp');
  await page.keyboard.press('ArrowUp');
  await page.keyboard.press('ArrowUp');
  await page.keyboard.press('ArrowUp');
  await page.keyboard.press('ArrowUp');
  assert.equal(await caption.textContent(), 'Rigid motion: nothing holds it');
  assert.equal(await page.locator('.mode[aria-pressed=true]').count(), 1);
  await page.keyboard.press('Space');
  await page.waitForFunction(() => window.floatframe!.time > 0.05);
  // What is drawn and what it is coloured by.
  await page.getByRole('tab', { name: 'Display' }).click();
  assert.equal(await page.getByLabel('Amplitude scale').count(), 1);
  assert.ok(await page.getByLabel('At rest').isChecked());
  assert.match((await page.locator('.legend').textContent())!, /Displacement of the mode, relative/);
  const canvas = page.locator('canvas.canvas');
  await page.evaluate(() => (window.floatframe!.chooseMode(1), window.floatframe!.setTime(0)));
  const outlined = (await canvas.screenshot()).toString('base64');
  await page.getByLabel('At rest').uncheck();
  await page.waitForTimeout(200);
  const alone = (await canvas.screenshot()).toString('base64');
  assert.notEqual(outlined, alone);
  await page.getByLabel('Colour by').selectOption('bodies');
  await page.waitForTimeout(200);
  assert.notEqual((await canvas.screenshot()).toString('base64'), alone);
  assert.deepEqual(errors, []);
  await page.context().close();
});

test('vibrations swing by themselves, print, fit narrow windows, and names are text', async () => {
  const { page, errors } = await open(browser, path('modes_hostile', modes({ hostile: true })), { width: 360, height: 740, dark: true });
  await page.waitForFunction(() => window.floatframe!.time > 0.05);
  await page.evaluate(() => window.floatframe!.chooseMode(0));
  assert.equal(await page.evaluate(() => (window as { hacked?: number }).hacked), undefined);
  assert.equal(await page.locator('img').count(), 0);
  assert.match((await page.locator('.mode-details').textContent())!, /chassis<img src=x.* 90 %/);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth));
  const inside = await page.evaluate(() => {
    const frame = document.querySelector('.frame')!.getBoundingClientRect();
    const caption = document.querySelector('.view-caption')!.getBoundingClientRect();
    return caption.left >= frame.left && caption.right <= frame.right && caption.top >= document.querySelector('.view-tools')!.getBoundingClientRect().bottom - 1;
  });
  assert.ok(inside);
  await page.emulateMedia({ media: 'print' });
  assert.ok(await page.locator('.view-caption').isVisible());
  assert.ok(!(await page.locator('.side').isVisible()));
  assert.ok(await page.locator('#facts td', { hasText: '99.5' }).isVisible());
  assert.deepEqual(errors, []);
  await page.context().close();
});

test('a page by the program: the bar swings about its hinge', { skip: existsSync(program) ? false : 'no program: make build' }, async (t) => {
  const report = join(folder, 'pendulum_modes.html');
  const run = spawnSync(program, ['modes', '../examples/flexible_pendulum/flexible_pendulum.yaml', '--at', 'equilibrium', '--report', report], { encoding: 'utf8' });
  if (/built without the viewer/.test(run.stderr)) return t.skip('the program was built without the viewer');
  assert.equal(run.status, 0, run.stderr);
  const { page, errors } = await open(browser, report, { still: true });
  assert.deepEqual(await page.evaluate(() => window.floatframe!.problems), []);
  assert.match((await page.locator('.view-caption').textContent())!, /^Mode 1: 0.6105 Hz, damping 0 %$/);
  const first = await vertex(page, 0, 0, 0);
  assert.ok(first.every(Number.isFinite));
  await page.evaluate(() => window.floatframe!.chooseMode(1));
  const ends: number[][] = [];
  for (const time of [0, 1]) ends.push(await place(page, time, 0, [0, 0, 0]));
  // The hinge is the origin of the bar: it stays, its far end swings to both sides.
  assert.ok(Math.hypot(...ends[0].map((x, i) => x - ends[1][i])) < 1e-6);
  assert.deepEqual(errors, []);
  await page.context().close();
});
