// What the camera holds: the whole motion, a body that goes far, the one that is chosen.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import type { Browser, Page } from 'playwright-core';
import type { ForceJson, Quadruple, Triple } from '../../src/data/page';
import { launch, open, template, write } from '../browser';
import { boxOf, cornersAt, moving, UPRIGHT, type MovingBody } from '../pages/moving';

let browser: Browser;
const html = template();

before(async () => (browser = await launch()));
after(async () => browser?.close());

interface Seen {
  pixels: ([number, number] | null)[];
  width: number;
  height: number;
}

async function seen(page: Page, time: number, places: Triple[]): Promise<Seen> {
  return page.evaluate(
    ([t, all]) => {
      window.floatframe!.setTime(t);
      const canvas = document.querySelector<HTMLCanvasElement>('canvas.canvas')!;
      return { pixels: all.map((p) => window.floatframe!.pixelOf(p)), width: canvas.clientWidth, height: canvas.clientHeight };
    },
    [time, places] as const,
  );
}

/** All places are in the picture; returns the larger part of its width or height that they span. */
function assertHeld({ pixels, width, height }: Seen, what: string): number {
  for (const pixel of pixels) assert.ok(pixel && pixel[0] > 0 && pixel[0] < width && pixel[1] > 0 && pixel[1] < height, `${what}: ${pixel} of ${width} x ${height}`);
  const span = (i: 0 | 1): number => Math.max(...pixels.map((p) => p![i])) - Math.min(...pixels.map((p) => p![i]));
  return Math.max(span(0) / width, span(1) / height);
}

function centreOf({ pixels }: Seen): [number, number] {
  return [0, 1].map((i) => pixels.reduce((sum, p) => sum + p![i], 0) / pixels.length) as [number, number];
}

const load = (name: string, a: number): ForceJson => ({ name, type: 'force', picture: 'force', a, b: -1, axis: [0, 0, 1], follows: false, radius: null, width: null });

// A crane arm that slews by half a turn, whose hook goes up; a small motor at its foot.
const DURATION = 4;
const ARM: Triple = [3, 0.3, 0.3];
const HOOK: Triple = [0.4, 0.4, 0.4];
const MOTOR: Triple = [0.2, 0.2, 0.2];
const slewed = (t: number): Quadruple => {
  const half = (Math.PI * t) / DURATION / 2;
  return [0, 0, Math.sin(half), Math.cos(half)];
};
const crane: (MovingBody & { size: Triple })[] = [
  { name: 'arm', mass: 900, size: ARM, shape: boxOf(ARM), pose: (t) => [[1.5 * Math.cos((Math.PI * t) / DURATION), 1.5 * Math.sin((Math.PI * t) / DURATION), 2], slewed(t)] },
  { name: 'hook', mass: 100, size: HOOK, shape: boxOf(HOOK), pose: (t) => [[3 * Math.cos((Math.PI * t) / DURATION), 3 * Math.sin((Math.PI * t) / DURATION), 0.4 * t], slewed(t)] },
  { name: 'motor', mass: 20, size: MOTOR, shape: boxOf(MOTOR), pose: () => [[0, 0, 1.6], UPRIGHT] },
];
const FOOT: Triple = [0.5, 1.5, 3.2];

function cranePage(): string {
  // A point of the ground beside the motion, and one that is far off.
  return write('camera_crane', moving(html, crane, DURATION, {
    points: [{ name: '', body: -1, p: FOOT, modes: null }, { name: '', body: -1, p: [400, 0, 0], modes: null }, { name: '', body: 1, p: [0, 0, -2.5], modes: null }],
    forces: [load('near', 0), load('far', 1), load('rope', 2)],
  }));
}

const allOf = (t: number): Triple[] => crane.flatMap((body) => cornersAt(body.size, body.pose(t)));
const END_OF_ROPE = (t: number): Triple => {
  const [p] = crane[1].pose(t);
  return [p[0], p[1], p[2] - 2.5];
};

test('the first picture holds the whole motion, with points of forces and of the ground', async () => {
  for (const [width, height] of [[1440, 900], [390, 800]]) {
    const { page, errors } = await open(browser, cranePage(), { width, height });
    let largest = 0;
    for (const t of [0, 0.9, DURATION / 2, 3.3, DURATION]) {
      largest = Math.max(largest, assertHeld(await seen(page, t, [...allOf(t), FOOT, END_OF_ROPE(t)]), `${width} at ${t} s`));
    }
    const path = [0, 1, 2, 3, 4].flatMap((t) => [...allOf(t), END_OF_ROPE(t)]);
    const whole = assertHeld(await seen(page, 0, path), 'all instants');
    assert.ok(whole > 0.6, `the motion spans ${whole} of the picture`);
    assert.equal(await page.locator('select[aria-label="Camera follows"]').inputValue(), '-1');
    assert.deepEqual(errors, []);
    await page.context().close();
  }
});

test('what hangs on a spring is shown with the place it hangs on', async () => {
  const size: Triple = [0.1, 0.1, 0.1];
  const bob: MovingBody = { name: 'bob', mass: 1, shape: boxOf(size), pose: (t) => [[0, 0, 0.02 * Math.sin(6 * t)], UPRIGHT] };
  const points = [{ name: '', body: 0, p: [0, 0, 0] as Triple, modes: null }, { name: '', body: -1, p: [0, 0, 2.5] as Triple, modes: null }];
  const spring: ForceJson = { ...load('spring', 0), picture: 'spring', b: 1 };
  const { page } = await open(browser, write('camera_spring', moving(html, [bob], 2, { points, forces: [spring] })));
  for (const t of [0, 1, 2]) assertHeld(await seen(page, t, [...cornersAt(size, bob.pose(t)), [0, 0, 2.5]]), `${t} s`);
  await page.context().close();
});

test('the camera goes to what is chosen and with it, and back', async () => {
  const { page } = await open(browser, cranePage());
  const follows = page.locator('select[aria-label="Camera follows"]');
  await page.locator('canvas.canvas').focus();
  await page.getByRole('tab', { name: 'Bodies' }).click();
  await page.getByRole('button', { name: 'hook', exact: true }).click();
  await page.keyboard.press('f');
  const hook = (t: number): Triple[] => cornersAt(HOOK, crane[1].pose(t));
  for (const t of [0, 2, DURATION]) {
    const found = await seen(page, t, hook(t));
    const part = assertHeld(found, `hook at ${t} s`);
    assert.ok(part > 0.08, `it spans ${part}`);
    const [x, y] = centreOf(await seen(page, t, [crane[1].pose(t)[0]]));
    // Its points, the end of the rope among them, lie about the middle: below, so that it is above.
    assert.ok(Math.abs(x - found.width / 2) < 0.1 * found.width && y > 0 && y < 0.6 * found.height, `${x}, ${y}`);
  }
  assert.equal(await follows.inputValue(), '1');
  await page.keyboard.press('Shift+F');
  for (const t of [0, 2, DURATION]) assertHeld(await seen(page, t, allOf(t)), `back at ${t} s`);
  assert.equal(await follows.inputValue(), '-1');
  // By two clicks in the view, on the motor, and beside everything.
  const pixel = (await seen(page, 0, [crane[2].pose(0)[0]])).pixels[0]!;
  const box = (await page.locator('canvas.canvas').boundingBox())!;
  await page.mouse.dblclick(box.x + pixel[0], box.y + pixel[1]);
  assert.notEqual(await follows.inputValue(), '-1');
  await page.getByRole('button', { name: 'Fit' }).click();
  assertHeld(await seen(page, 3.3, allOf(3.3)), 'everything');
  // Nothing chosen: F holds everything.
  await page.keyboard.press('Escape');
  await page.keyboard.press('f');
  assertHeld(await seen(page, 1.2, allOf(1.2)), 'nothing chosen');
  await page.context().close();
});

test('a machine that drives far is followed, and the whole way is shown where the camera stands still', async () => {
  const size: Triple = [2, 1, 0.8];
  const cart: MovingBody = { name: 'cart', mass: 1000, shape: boxOf(size), pose: (t) => [[8 * t, 0.6 * Math.sin(t), 0.6], UPRIGHT] };
  const wheel: MovingBody = { name: 'wheel', mass: 20, shape: boxOf([0.3, 0.1, 0.3]), pose: (t) => [[8 * t + 0.8, 0.6 * Math.sin(t) + 0.6, 0.3 + 0.05 * Math.sin(9 * t)], UPRIGHT] };
  const path = write('camera_cart', moving(html, [wheel, cart], 10, { points: [{ name: '', body: -1, p: [0, 0, 0.6], modes: null }], forces: [load('start', 0)] }));
  const { page } = await open(browser, path);
  const follows = page.locator('select[aria-label="Camera follows"]');
  assert.equal(await follows.inputValue(), '1');
  let place: [number, number] | null = null;
  for (const t of [0, 5, 10]) {
    const found = await seen(page, t, [...cornersAt(size, cart.pose(t)), ...cornersAt([0.3, 0.1, 0.3], wheel.pose(t))]);
    const part = assertHeld(found, `${t} s`);
    assert.ok(part > 0.4, `it spans ${part} of the picture`);
    const centre = centreOf(await seen(page, t, [cart.pose(t)[0]]));
    if (place) assert.ok(Math.hypot(centre[0] - place[0], centre[1] - place[1]) < 1, `${centre} and ${place}`);
    place = centre;
  }
  await follows.selectOption('-1');
  await page.keyboard.press('Shift+F');
  await page.getByRole('button', { name: 'Fit' }).click();
  for (const t of [0, 5, 10]) assertHeld(await seen(page, t, cornersAt(size, cart.pose(t))), `still, at ${t} s`);
  await page.context().close();
});
