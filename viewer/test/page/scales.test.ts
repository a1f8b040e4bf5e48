// Scales of colours, hot spots, the speed that is played, paper.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import type { Browser, Page } from 'playwright-core';
import { sweep } from '../pages/others';
import { motionAt, STRESS_UNIT, vehicle } from '../pages/vehicle';
import { fillTemplate } from '../pages/writer';
import { vonMises } from '../../src/motion/stress';
import { mapColour, OVER_COLOUR } from '../../src/scene/palette';
import { launch, open, snap, template, write } from '../browser';

let browser: Browser;
const UNIFORM = [300, -120, 50, 200, -90, 60];

before(async () => (browser = await launch()));
after(async () => browser?.close());

function path(name: string, made: ReturnType<typeof vehicle>): string {
  return write(name, fillTemplate(template(), made.page, made.writer));
}

const at = (page: Page, time: number): Promise<void> => page.evaluate((t) => window.floatframe!.setTime(t), time);

/** Von Mises stress of the arms, the same everywhere [MPa]. */
function stressAt(time: number): number {
  return vonMises(UNIFORM.map((s) => 1e-6 * STRESS_UNIT * s * motionAt(time).amplitudes[0]));
}

/** One arm alone, coloured by its stress. */
async function showArm(page: Page): Promise<void> {
  await page.getByRole('tab', { name: 'Bodies' }).click();
  await page.getByRole('button', { name: 'Show only front_left_arm' }).click();
  await page.getByRole('button', { name: 'Fit' }).click();
  await page.getByRole('tab', { name: 'Display' }).click();
  for (const layer of ['Edges', 'Ground', 'Road', 'Springs, rods, couplings', 'Tyres']) await page.getByLabel(layer, { exact: true }).uncheck();
  await page.getByLabel('Colour by').selectOption({ label: 'Von Mises stress' });
}

/** Hue (degrees) that most coloured pixels of the picture's middle have, in steps of 10, and how many there are. */
async function hueOf(page: Page): Promise<{ hue: number; part: number }> {
  const url = (await page.evaluate(() => window.floatframe!.screenshot()))!;
  return page.evaluate(async (source) => {
    const image = new Image();
    image.src = source;
    await image.decode();
    const canvas = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height });
    const context = canvas.getContext('2d')!;
    context.drawImage(image, 0, 0);
    const [x, y, w, h] = [0.25, 0.25, 0.5, 0.5].map((part, k) => Math.round(part * (k % 2 ? image.height : image.width)));
    const { data } = context.getImageData(x, y, w, h);
    const count = new Array<number>(36).fill(0);
    for (let i = 0; i < data.length; i += 4) {
      const [r, g, b] = data.subarray(i, i + 3);
      const most = Math.max(r, g, b);
      const span = most - Math.min(r, g, b);
      if (most < 40 || span < 0.35 * most) continue;
      const hue = most === r ? ((g - b) / span + 6) % 6 : most === g ? (b - r) / span + 2 : (r - g) / span + 4;
      ++count[Math.floor(6 * hue) % 36];
    }
    const best = count.indexOf(Math.max(...count));
    return { hue: 10 * best + 5, part: count[best] / (w * h) };
  }, url);
}

function hueOfColour([r, g, b]: number[]): number {
  const most = Math.max(r, g, b);
  const span = most - Math.min(r, g, b);
  return 60 * (most === r ? ((g - b) / span + 6) % 6 : most === g ? (b - r) / span + 2 : (r - g) / span + 4);
}

async function drawnAs(page: Page, colour: number[], what: string): Promise<void> {
  const { hue, part } = await hueOf(page);
  const apart = Math.abs(((hue - hueOfColour(colour) + 540) % 360) - 180);
  assert.ok(part > 0.01 && apart <= 12, `${what}: hue ${hue} of ${(100 * part).toFixed(1)} %, expected ${hueOfColour(colour)}`);
}

const numbersOf = async (page: Page): Promise<string[]> => page.locator('.legend-ticks span').allTextContents();

test('scales: this instant, a limit with a colour above it, visible bodies, bands as they are drawn', async () => {
  const { page, errors } = await open(browser, path('scales', vehicle({ uniform: UNIFORM })), { still: true });
  await showArm(page);
  const scope = page.getByLabel('Scale of the colours');
  const map = page.getByLabel('Colour map');
  await map.selectOption('turbo');
  const [early, late] = [stressAt(1.6), stressAt(2.4)];
  // Of this instant the whole arm, which has one stress, has the colour of the upper end.
  await scope.selectOption('now');
  for (const [time, stress] of [[1.6, early], [2.4, late]] as const) {
    await at(page, time);
    const numbers = await numbersOf(page);
    assert.ok(Math.abs(Number(numbers[numbers.length - 1].replace('≥ ', '')) / stress - 1) < 0.02, `${numbers} at ${time} s, expected ${stress}`);
    await drawnAs(page, mapColour('turbo', 1), `this instant, ${time} s`);
  }
  assert.match((await page.locator('.legend-scope').textContent())!, /this instant/);
  await at(page, 1.6);
  const limit = page.getByLabel("A material's limit");
  await scope.selectOption('limit');
  const set = async (value: number): Promise<void> => {
    await limit.fill(String(value));
    await limit.blur();
  };
  // Below, colours are those of the map; above, one that is not in it.
  await set(1.5 * early);
  await drawnAs(page, mapColour('turbo', 1 / 1.5), 'below the limit');
  await snap(page, 'scale_limit');
  await set(1.02 * early);
  await drawnAs(page, mapColour('turbo', 1 / 1.02), 'just below the limit');
  await set(0.98 * early);
  await drawnAs(page, [1, 3, 5].map((k) => parseInt(OVER_COLOUR.slice(k, k + 2), 16)), 'above the limit');
  // Bands: one colour for all within; their edges stand at the legend.
  await set(early / 0.55);
  await page.getByLabel('Bands of colour').selectOption('10');
  await drawnAs(page, mapColour('turbo/10', 0.55), 'sixth of ten bands');
  const edges = (await numbersOf(page)).map(Number);
  assert.equal(edges.length, 6);
  edges.forEach((edge, k) => assert.ok(Math.abs(edge - (k * early) / 0.55 / 5) < 0.01 * early, `${edges}`));
  // Typed limits say that there is more.
  await page.getByLabel('Upper end of the scale').fill(String(0.5 * early));
  await page.getByLabel('Upper end of the scale').blur();
  assert.equal(await scope.inputValue(), 'typed');
  assert.match((await numbersOf(page)).pop()!, /^≥ /);
  // Displacement has the same choices, in its own unit.
  await page.getByLabel('Colour by').selectOption({ label: 'Elastic displacement' });
  await scope.selectOption('run');
  const whole = Number((await numbersOf(page)).pop());
  await scope.selectOption('percentile');
  assert.ok(Number((await numbersOf(page)).pop()!.replace('≥ ', '')) < whole);
  assert.deepEqual(errors, []);
  await page.context().close();
});

test('hot spots: a line goes to the place and the instant', async () => {
  const made = vehicle({ uniform: UNIFORM });
  const spot = 37;
  for (const body of made.page.scene!.bodies) {
    if (!body.stress) continue;
    const count = (body.stress.modes.shape[0] as number) ?? 0;
    const hot = body.name === 'front_left_arm';
    body.stress.envelope = made.writer.view('f32', Array.from({ length: count }, (_, v) => (v === spot && hot ? 9e8 : 1e6)));
    body.stress.when = made.writer.view('f32', Array.from({ length: count }, (_, v) => (v === spot && hot ? 2.25 : 1)));
  }
  const { page, errors } = await open(browser, path('hot_spots', made), { still: true });
  await page.getByRole('tab', { name: 'Hot spots' }).click();
  const first = page.locator('button.spot').first();
  assert.match((await first.textContent())!, /front_left_arm.*900/);
  await first.click();
  const found = await page.evaluate((v) => {
    const { selected, time, bodies } = window.floatframe!;
    return { selected, time, name: selected && bodies[selected.body].name, place: selected && window.floatframe!.vertexPosition(selected.body, v) };
  }, spot);
  assert.equal(found.name, 'front_left_arm');
  assert.equal(found.selected!.vertex, spot);
  assert.equal(found.time, 2.25);
  assert.match((await page.locator('.legend').textContent())!, /Von Mises stress/);
  // The mark of the chosen place is drawn in the middle of the picture.
  const url = (await page.evaluate(() => window.floatframe!.screenshot()))!;
  await snap(page, 'hot_spot');
  const middle = await page.evaluate(async (source) => {
    const image = new Image();
    image.src = source;
    await image.decode();
    const canvas = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height });
    const context = canvas.getContext('2d')!;
    context.drawImage(image, 0, 0);
    return [...context.getImageData(image.width >> 1, image.height >> 1, 1, 1).data];
  }, url);
  assert.ok(middle[0] > 180 && middle[1] < 140 && middle[2] < 90, `in the middle: ${middle}`);
  assert.deepEqual(errors, []);
  await page.context().close();
});

test('playing: the speed that is shown is that of the clock, not the one that was asked for', async () => {
  const { page } = await open(browser, path('playing', vehicle()), { still: true });
  await page.getByLabel('Speed', { exact: true }).selectOption('0.1');
  // Each picture takes half a second, of which a quarter is played.
  await page.evaluate(() => {
    const block = (): void => {
      for (const end = performance.now() + 500; performance.now() < end; );
      requestAnimationFrame(block);
    };
    requestAnimationFrame(block);
  });
  await page.getByRole('button', { name: /^Play/ }).click();
  const seen = await page.evaluate(async () => {
    const rate = (): number => Number(/([\d.]+)×/.exec(document.querySelector('.rate')!.textContent!)?.[1]);
    while (!Number.isFinite(rate())) await new Promise((resolve) => setTimeout(resolve, 100));
    const [from, begin] = [window.floatframe!.time, performance.now()];
    const speeds: number[] = [];
    for (let k = 0; k < 8; ++k) {
      await new Promise((resolve) => setTimeout(resolve, 300));
      speeds.push(rate());
    }
    return { played: (1000 * (window.floatframe!.time - from)) / (performance.now() - begin), speeds };
  });
  const mean = seen.speeds.reduce((a, b) => a + b, 0) / seen.speeds.length;
  assert.ok(seen.speeds.every((speed) => speed > 0 && speed < 0.075), `${seen.speeds} shown`);
  assert.ok(mean > 0.5 * seen.played && mean < 2 * seen.played, `${seen.speeds} shown, ${seen.played} played`);
  await page.context().close();
});

test('paper: light, two columns, with the colours of curves and scales', async () => {
  const { page, errors } = await open(browser, path('paper', vehicle()), { still: true, dark: true });
  await page.emulateMedia({ media: 'print', colorScheme: 'dark' });
  await page.waitForFunction(() => document.documentElement.classList.contains('paper'));
  await page.waitForTimeout(300);
  const seen = await page.evaluate(() => {
    const boxes = [...document.querySelectorAll('#curves .body-group')].map((group) => [...group.querySelectorAll('.plot')].map((plot) => plot.getBoundingClientRect()).map(({ left, top, right }) => ({ left, top, right })));
    const style = (selector: string): CSSStyleDeclaration => getComputedStyle(document.querySelector(selector)!);
    return {
      boxes: boxes.find((group) => group.length >= 2)!,
      width: document.querySelector('main')!.getBoundingClientRect().width,
      adjust: [style('.legend-bar'), style('.swatch')].map((s) => s.getPropertyValue('print-color-adjust') || s.getPropertyValue('-webkit-print-color-adjust')),
      ground: style('.card').backgroundColor,
      swatch: style('.curve-0').backgroundColor,
    };
  });
  assert.equal(seen.boxes[0].top, seen.boxes[1].top);
  assert.ok(seen.boxes[1].left > seen.boxes[0].right && seen.boxes[1].right <= 1440);
  assert.ok(seen.boxes[0].right - seen.boxes[0].left > 0.4 * seen.width, JSON.stringify(seen.boxes));
  assert.deepEqual(seen.adjust, ['exact', 'exact']);
  assert.equal(seen.ground, 'rgb(255, 255, 255)');
  assert.equal(seen.swatch, 'rgb(0, 114, 178)');
  await page.emulateMedia({ media: 'screen', colorScheme: 'dark' });
  await page.waitForFunction(() => !document.documentElement.classList.contains('paper'));
  assert.notEqual(await page.evaluate(() => getComputedStyle(document.querySelector('.card')!).backgroundColor), 'rgb(255, 255, 255)');
  assert.deepEqual(errors, []);
  await page.context().close();
});

test('a study: best and worst, effects, scatter, curves, table; another figure turns them round', async () => {
  const { page, errors } = await open(browser, path('study', sweep()), { still: true });
  const cards = page.locator('.study-card');
  assert.match((await cards.nth(0).textContent())!, /run 9.*3 m.*k = 100000, road = smooth/);
  assert.match((await cards.nth(1).textContent())!, /run 2.*11 m/);
  assert.equal(await cards.nth(0).getByRole('link').getAttribute('href'), 'best/report.html');
  // Means by hand: the failed run does not count.
  const effects = await page.locator('.dot title').allTextContents();
  assert.ok(effects.some((text) => /k about 1000: mean 9\.3333 of 3 runs/.test(text)), `${effects}`);
  assert.ok(effects.some((text) => /road smooth: mean 5 of 3 runs/.test(text)), `${effects}`);
  const runs = async (): Promise<string[]> => page.locator('.study-table tbody tr td:first-child').allTextContents();
  assert.deepEqual((await runs()).slice(0, 2).concat((await runs()).slice(-2)), ['9', '10', '2', '12']);
  await page.getByLabel('Figure').selectOption({ label: 'seat.z max' });
  assert.match((await cards.nth(0).textContent())!, /run 2.*9 m/);
  assert.equal(await cards.nth(0).getByRole('link').getAttribute('href'), 'worst/report.html');
  await page.getByLabel('Which run is the best').selectOption('1');
  assert.match((await cards.nth(0).textContent())!, /run 9.*17 m/);
  // A run that is clicked is drawn strongly.
  const strong = page.locator('.study-overlay path[stroke-width="2"]');
  assert.equal(await strong.count(), 2);
  await page.getByRole('button', { name: '5', exact: true }).click();
  assert.equal(await strong.count(), 3);
  assert.match((await cards.nth(2).textContent())!, /Chosen: run 5/);
  await page.getByRole('button', { name: 'run', exact: true }).click();
  assert.deepEqual((await runs()).slice(0, 3), ['1', '2', '3']);
  assert.deepEqual(errors, []);
  await page.context().close();
});
