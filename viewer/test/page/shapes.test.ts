// How bodies without a surface are drawn, colours of surfaces, and symbols of elements, by the pixels of the view.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import type { Browser, Page } from 'playwright-core';
import type { ForceJson, PointJson, Quadruple, ShapeJson, Triple } from '../../src/data/page';
import { launch, open, template, write } from '../browser';
import { boxOf, moving, UPRIGHT, type MovingBody } from '../pages/moving';
import { beamMesh } from '../pages/shapes';
import type { BufferWriter } from '../pages/writer';

let browser: Browser;
const html = template();

before(async () => (browser = await launch()));
after(async () => browser?.close());

type Colour = [number, number, number];

/** Colours of the view at places of the world, as it is drawn now. */
async function coloursAt(page: Page, places: Triple[]): Promise<Colour[]> {
  return page.evaluate(async (all) => {
    const shown = window.floatframe!;
    const canvas = document.querySelector<HTMLCanvasElement>('canvas.canvas')!;
    const image = new Image();
    image.src = shown.screenshot()!;
    await image.decode();
    const copy = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height });
    const context = copy.getContext('2d')!;
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    return all.map((place) => {
      const [x, y] = shown.pixelOf(place)!;
      const pixel = Math.round((y * image.height) / canvas.clientHeight) * image.width + Math.round((x * image.width) / canvas.clientWidth);
      return [data[4 * pixel], data[4 * pixel + 1], data[4 * pixel + 2]] as Colour;
    });
  }, places);
}

function apart(a: Colour, b: Colour): number {
  return Math.max(...a.map((x, i) => Math.abs(x - b[i])));
}

/** Where hiding a body, or a layer, changes the picture. */
async function changesAt(page: Page, places: Triple[], hide: () => Promise<void>, show: () => Promise<void>): Promise<boolean[]> {
  const before = await coloursAt(page, places);
  await hide();
  const after = await coloursAt(page, places);
  await show();
  return before.map((colour, k) => apart(colour, after[k]) > 4);
}

async function bodyAt(page: Page, name: string, places: Triple[]): Promise<boolean[]> {
  await page.getByRole('tab', { name: 'Bodies' }).click();
  return changesAt(
    page,
    places,
    () => page.getByRole('button', { name: `Hide ${name}`, exact: true }).click(),
    () => page.getByRole('button', { name: `Show ${name}`, exact: true }).click(),
  );
}

function still(name: string, mass: number, shape: MovingBody['shape'], position: Triple, quaternion: Quadruple = UPRIGHT): MovingBody {
  return { name, mass, shape, pose: () => [position, quaternion] };
}

/** A bar along x from its frame, in two colours. */
function bar(writer: BufferWriter, paints: [number, string | null][] | null, colour: string): ShapeJson {
  const mesh = beamMesh(1, 0.2, 0.2, 1, 1);
  return { kind: 'mesh', vertices: writer.view('f32', mesh.vertices, [mesh.vertices.length / 3, 3]), triangles: writer.view('u16', mesh.triangles, [mesh.triangles.length / 3, 3]), color: colour, paints };
}

test('boxes of inertia are glass: what is behind them is seen', async () => {
  const behind = still('behind', 5, (writer) => bar(writer, null, '#e01010'), [-0.5, 0.8, 0]);
  const glass = still('glass', 5, boxOf([2, 0.4, 2]), [0, 0, 0]);
  const { page, errors } = await open(browser, write('glass', moving(html, [behind, glass], 1)));
  await page.getByRole('button', { name: 'Side' }).click();
  // From the side, along y: the bar stands behind the box.
  const [through, beside] = await coloursAt(page, [[0, 0.8, 0], [0.3, 0.8, 0.6]]);
  assert.ok(through[0] > 1.5 * through[1] && through[0] > 1.5 * through[2], `red through the glass: ${through}`);
  assert.ok(Math.abs(beside[0] - beside[1]) < 40, `${beside}`);
  assert.deepEqual(await bodyAt(page, 'glass', [[0.3, 0.8, 0.6]]), [true], 'the box is drawn');
  assert.deepEqual(errors, []);
  await page.context().close();
});

test('two equal moments are a disc, a dummy is its points', async () => {
  const disc = still('disc', 12, { kind: 'cylinder', size: [2, 2, 0.3], position: [0, 0, 0], quaternion: [0, Math.SQRT1_2, 0, Math.SQRT1_2] }, [0, 0, 0]);
  const dummy = still('dummy', 0.1, null, [0, 3, 0]);
  const points: PointJson[] = [{ name: '', body: 1, p: [0, 0, 0], modes: null }, { name: '', body: 1, p: [0, 0, 1], modes: null }];
  const { page, errors } = await open(browser, write('disc', moving(html, [disc, dummy], 1, { points })));
  assert.deepEqual(await page.evaluate(() => window.floatframe!.problems), []);
  await page.getByRole('button', { name: 'Front' }).click();
  // Along its axis, which is x: round, where a box would have corners.
  const at = (angle: number, part: number): Triple => [0.15, part * Math.cos(angle), part * Math.sin(angle)];
  const angles = [0.3, 0.785, 1.2, 2.356, 3.6, 5.5];
  assert.deepEqual(await bodyAt(page, 'disc', angles.map((a) => at(a, 0.9))), angles.map(() => true));
  assert.deepEqual(await bodyAt(page, 'disc', angles.map((a) => at(a, 1.1))), angles.map(() => false));
  // Of the dummy a stick between its points alone.
  assert.deepEqual(await bodyAt(page, 'dummy', [[0, 3, 0.5], [0, 3.3, 0.5], [0, 2.7, 0.5]]), [true, false, false]);
  assert.deepEqual(errors, []);
  await page.context().close();
});

test('a surface has the colours of its parts', async () => {
  // Cells of the faces of a bar, in the order of its triangles: top, bottom, two sides, two ends.
  const painted = still('painted', 5, (writer) => bar(writer, [[0, '#10c010'], [2, null], [4, '#1010e0']], '#e01010'), [0, 0, 0]);
  const { page } = await open(browser, write('paints', moving(html, [painted], 1)));
  const strongest = (c: Colour): number => c.indexOf(Math.max(...c));
  const [top, side] = await coloursAt(page, [[0.5, 0, 0.1], [0.5, -0.1, 0]]);
  assert.equal(strongest(top), 1, `green above: ${top}`);
  assert.equal(strongest(side), 2, `blue at the side: ${side}`);
  await page.context().close();
});

test('bearings, bushings and couplings have symbols of their own', async () => {
  const kinds = ['ring', 'bearing', 'bushing', 'coupling'] as const;
  const points = [...kinds, 'shaft'].map((_, k): PointJson => ({ name: '', body: -1, p: [0.5 * k, 0, 0], modes: null }));
  const forces = kinds.map((picture, k): ForceJson => ({ name: picture, type: picture, picture, a: k, b: -1, axis: [0, 1, 0], follows: true, radius: null, width: null }));
  forces.push({ ...forces[1], name: 'journal', a: 4, radius: 0.15 });
  // Behind the symbols, so that nothing else is drawn at their places.
  const body = still('body', 5, boxOf([2, 0.1, 1]), [1, 1, 0]);
  const { page, errors } = await open(browser, write('symbols', moving(html, [body], 1, { points, forces })));
  await page.getByRole('button', { name: 'Side' }).click();
  const layer = page.getByLabel('Springs, rods, couplings');
  const rays = [0.3, 1.4, 2.5, 3.6, 4.7, 5.8];
  const ring = (k: number, radius: number): Triple[] => rays.map((a) => [0.5 * k + radius * Math.cos(a), 0, radius * Math.sin(a)]);
  const drawn = async (places: Triple[]): Promise<boolean[]> =>
    changesAt(page, places, () => layer.uncheck(), () => layer.check());
  const radii = [0.004, 0.01, 0.016, 0.022, 0.028, 0.034, 0.04];
  for (const k of kinds.keys()) assert.ok((await drawn(radii.flatMap((r) => ring(k, r)))).some(Boolean), `${kinds[k]} is drawn`);
  // Each in its own way: what is seen along the axis differs.
  const looks = await Promise.all(kinds.map(async (_, k) => coloursAt(page, radii.flatMap((r) => ring(k, r)))));
  for (let i = 0; i < looks.length; ++i) {
    for (let k = 0; k < i; ++k) assert.ok(looks[i].some((colour, n) => apart(colour, looks[k][n]) > 40), `${kinds[i]} and ${kinds[k]}`);
  }
  // A bearing of a shaft that is known lies about it.
  assert.deepEqual(await drawn(ring(4, 0.12)), rays.map(() => false));
  assert.ok((await drawn(ring(4, 0.163))).every(Boolean));
  assert.deepEqual(errors, []);
  await page.context().close();
});
