// Pages opened from disk in a headless browser.

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import type { Browser, Page } from 'playwright-core';
import { check, compare, damaged, reduce } from '../pages/others';
import { armMesh, ARM, CHANNEL, motionAt, ORIGIN, RADIUS, road, vehicle } from '../pages/vehicle';
import { modeShape } from '../pages/shapes';
import { fillTemplate } from '../pages/writer';
import { folder, launch, open, snap, template, write } from '../browser';

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

function turned(q: number[], v: number[]): number[] {
  const [x, y, z, w] = q;
  const t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])];
  return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2], v[2] + w * t[2] + x * t[1] - y * t[0]];
}

test('template: one file, small, with one place for data', () => {
  assert.ok(html.length < 1_200_000, `${html.length} bytes`);
  assert.equal(html.split('<!--FLOATFRAME-DATA-->').length, 2);
  assert.ok(!/<(script|link|img)[^>]+(src|href)="(?!data:)/.test(html));
});

test('a run: opens without an error, moves, and bodies are where formulas say', async () => {
  const opened = await open(browser, path('vehicle', vehicle()));
  const { page } = opened;
  console.log(`small page ready after ${opened.readyAfter} ms`);
  assert.deepEqual(opened.errors, []);
  assert.deepEqual(opened.requests, []);
  assert.deepEqual(await page.evaluate(() => window.floatframe!.problems), []);
  const canvas = page.locator('canvas.canvas');
  const pictures: string[] = [];
  for (const t of [0.2, 1.6, 3.1]) {
    await at(page, t);
    pictures.push((await canvas.screenshot()).toString('base64'));
  }
  assert.equal(new Set(pictures).size, 3);

  const mesh = armMesh();
  const vertex = mesh.vertices.length / 3 - 3;
  const local = mesh.vertices.slice(3 * vertex, 3 * vertex + 3) as [number, number, number];
  const modes = Array.from({ length: 6 }, (_, j) => modeShape(j, ARM, local[0], local[1], local[2]));
  for (const scale of [1, 20]) {
    await page.evaluate((s) => window.floatframe!.setScale(s), scale);
    for (const t of [0, 1.64, 2.9]) {
      await at(page, t);
      const exact = motionAt(t);
      const bent = local.map((x, i) => x + scale * modes.reduce((sum, mode, j) => sum + mode[i] * exact.amplitudes[6 + j], 0));
      const expected = turned(exact.bodies[2].quaternion, bent).map((x, i) => x + exact.bodies[2].position[i] + ORIGIN[i]);
      const found = await page.evaluate(
        ({ v, l, m }) => [window.floatframe!.worldPosition(2, l, m)!, window.floatframe!.vertexPosition(2, v)!],
        { v: vertex, l: local, m: modes },
      );
      for (let i = 0; i < 3; ++i) {
        assert.ok(Math.abs(found[0][i] - expected[i]) < 2e-6, `${found[0]} and ${expected}`);
        // Modes of meshes are half floats.
        assert.ok(Math.abs(found[1][i] - expected[i]) < 2e-6 + scale * 2e-5, `${found[1]} and ${expected}`);
      }
    }
  }
  // Wheels stand on the road.
  await at(page, 0.4);
  const hub = (await page.evaluate(() => window.floatframe!.pointPosition(3)))!;
  const above = hub[2] - ORIGIN[2] - road(hub[0] - ORIGIN[0]);
  assert.ok(above > 0.85 * RADIUS && above < 1.1 * RADIUS, String(above));
  await page.context().close();
});

test('time cursor, curve and scene agree, both ways', async () => {
  const { page, errors } = await open(browser, path('vehicle', vehicle()));
  await at(page, 1.64);
  const { value, place } = await page.evaluate((name) => ({ value: window.floatframe!.channelValue(name), place: window.floatframe!.worldPosition(0, [0, 0, 0])! }), CHANNEL);
  assert.ok(Math.abs(value - place[2]) < 1e-6);
  const plot = page.locator('#curves .plot', { has: page.locator(`[title="${CHANNEL}"]`) });
  await plot.scrollIntoViewIfNeeded();
  await plot.locator('.u-over').waitFor();
  await page.waitForFunction((name) => document.querySelector(`#curves [title="${name}"] .chip-value`)?.textContent !== '', CHANNEL);
  const shown = Number((await plot.locator('.chip-value').first().textContent())!.replace('\u2212', '-'));
  assert.ok(Math.abs(shown - value) < 1e-4 * Math.abs(value), `${shown} and ${value}`);
  const over = (await plot.locator('.u-over').boundingBox())!;
  const cursor = (await plot.locator('.time-cursor').boundingBox())!;
  assert.ok(Math.abs((cursor.x + cursor.width / 2 - over.x) / over.width - 1.64 / 4) < 0.01);
  // A click on the curve sets the time of the view.
  await page.mouse.click(over.x + 0.75 * over.width, over.y + over.height / 2);
  assert.ok(Math.abs((await page.evaluate(() => window.floatframe!.time)) - 3) < 0.03);
  // Dragging zooms all plots alike.
  await page.mouse.move(over.x + 0.25 * over.width, over.y + 40);
  await page.mouse.down();
  await page.mouse.move(over.x + 0.5 * over.width, over.y + 40, { steps: 4 });
  await page.mouse.up();
  const whole = page.getByRole('button', { name: 'Whole run' });
  assert.ok(await whole.isEnabled());
  await whole.click();
  assert.ok(await whole.isDisabled());
  const chip = plot.locator('.chip').first();
  await chip.click();
  assert.equal(await chip.getAttribute('aria-pressed'), 'false');
  // Constant and noise channels are text.
  assert.match((await page.locator('#curves .still').first().textContent())!, /lateralconstant \u221220 myawrounding noise, at most 1e\u221215 rad/);
  assert.deepEqual(errors, []);
  await page.context().close();
});

const program = process.env.FLOATFRAME_PROGRAM ?? '../build/floatframe';

test('geometry of files, read by the program: STL, OBJ and GLB in the place of boxes', { skip: existsSync(program) ? false : 'no program: make build' }, async (t) => {
  const corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
  const stl = Buffer.alloc(84 + 50 * faces.length);
  stl.writeUInt32LE(faces.length, 80);
  faces.forEach((face, k) => face.forEach((v, i) => corners[v].forEach((x, c) => stl.writeFloatLE(x, 84 + 50 * k + 12 + 12 * i + 4 * c))));
  writeFileSync(join(folder, 'tetrahedron.stl'), stl);
  writeFileSync(join(folder, 'tetrahedron.obj'), `${corners.map((p) => `v ${p.join(' ')}\n`).join('')}${faces.map((f) => `f ${f.map((v) => v + 1).join(' ')}\n`).join('')}`);
  const numbers = Buffer.concat([Buffer.from(Float32Array.from(corners.flat()).buffer), Buffer.from(Uint16Array.from(faces.flat()).buffer)]);
  const json = JSON.stringify({
    asset: { version: '2.0' },
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 4, type: 'VEC3' }, { bufferView: 1, componentType: 5123, count: 12, type: 'SCALAR' }],
    bufferViews: [{ buffer: 0, byteLength: 48 }, { buffer: 0, byteOffset: 48, byteLength: 24 }],
    buffers: [{ byteLength: 72 }],
  });
  const text = Buffer.from(json.padEnd(4 * Math.ceil(json.length / 4)));
  const words = (...values: number[]): Buffer => Buffer.from(Uint32Array.from(values).buffer);
  writeFileSync(join(folder, 'tetrahedron.glb'), Buffer.concat([words(0x46546c67, 2, 28 + text.length + numbers.length), words(text.length, 0x4e4f534a), text, words(numbers.length, 0x004e4942), numbers]));
  const bodies = ['stl', 'obj', 'glb'].map((kind, k) => `  ${kind}: {rigid: {mass: 1, inertia: [1, 1, 1]}, position: [${2 * k}, 0, 0], geometry: {file: tetrahedron.${kind}, scale: 0.5, position: [0, 0, 1], color: "#c2410c"}}\n`);
  writeFileSync(join(folder, 'geometry.yaml'), `floatframe: 1\nbodies:\n${bodies.join('')}`);
  const page = join(folder, 'geometry.html');
  const run = spawnSync(program, ['check', join(folder, 'geometry.yaml'), '--report', page], { encoding: 'utf8' });
  if (/built without the viewer/.test(run.stderr)) return t.skip('the program was built without the viewer');
  assert.equal(run.status, 0, run.stderr);
  const opened = await open(browser, page);
  assert.deepEqual(opened.errors, []);
  assert.deepEqual(await opened.page.evaluate(() => window.floatframe!.problems), []);
  const centres = await opened.page.evaluate(() => [0, 1, 2].map((b) => [0, 1, 2, 3].map((v) => window.floatframe!.vertexPosition(b, v)!)));
  centres.forEach((vertices, k) => {
    assert.equal(Math.max(...vertices.map((p) => p[0])), 2 * k + 0.5);
    assert.equal(Math.max(...vertices.map((p) => p[2])), 1.5);
    assert.equal(Math.min(...vertices.map((p) => p[2])), 1);
  });
  // Their colour, somewhere in the picture.
  const url = (await opened.page.evaluate(() => window.floatframe!.screenshot()))!;
  const orange = await opened.page.evaluate(async (source) => {
    const image = new Image();
    image.src = source;
    await image.decode();
    const canvas = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height });
    const context = canvas.getContext('2d')!;
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    let count = 0;
    for (let i = 0; i < data.length; i += 4) if (data[i] > 1.8 * data[i + 1] && data[i] > 3 * data[i + 2] && data[i] > 80) ++count;
    return count / (image.width * image.height);
  }, url);
  assert.ok(orange > 0.01, `${orange} of the picture`);
  await opened.page.context().close();
});

test('deformation, colours, hiding, picking, keys and the screenshot act', async () => {
  const { page, errors } = await open(browser, path('vehicle', vehicle()));
  const canvas = page.locator('canvas.canvas');
  const picture = async (): Promise<string> => {
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    return (await canvas.screenshot()).toString('base64');
  };
  await at(page, 1.6);
  let before = await picture();
  const differs = async (what: string): Promise<void> => {
    const now = await picture();
    assert.notEqual(now, before, what);
    before = now;
  };
  const slider = page.getByLabel('Deformation scale');
  await slider.fill('1');
  assert.equal(await page.evaluate(() => window.floatframe!.scale), 10);
  await differs('deformation');
  await slider.fill('3');
  assert.equal(await page.evaluate(() => window.floatframe!.scale), 1000);
  await slider.fill('0.5');
  await differs('deformation');
  await page.getByLabel('Colour map').selectOption('cividis');
  await differs('colour map');
  await page.getByLabel('Colour by').selectOption({ label: 'Axial stress' });
  await differs('field');
  assert.match((await page.locator('.legend').textContent())!, /Axial stress \[MPa\]/);
  await page.getByLabel('Colour by').selectOption({ label: 'Bodies' });
  await differs('body colours');
  assert.ok(await page.locator('.legend').isHidden());
  await page.getByLabel('Names', { exact: true }).check();
  await differs('names');
  await page.getByRole('tab', { name: 'Bodies' }).click();
  await page.getByRole('button', { name: 'Hide chassis' }).click();
  assert.equal(await page.evaluate(() => window.floatframe!.bodies[0].visible), false);
  await differs('hiding');
  await page.getByRole('button', { name: 'Show only front_left_arm' }).click();
  assert.deepEqual(await page.evaluate(() => window.floatframe!.bodies.filter((b) => b.visible).map((b) => b.name)), ['front_left_arm']);
  await page.getByRole('button', { name: 'Fit' }).click();
  await differs('isolated and fitted');
  // The only body is in the middle.
  const box = (await canvas.boundingBox())!;
  await page.evaluate(() => window.floatframe!.setScale(1));
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  const chosen = await page.evaluate(() => window.floatframe!.selected);
  assert.equal(chosen?.body, 1);
  assert.ok(chosen!.vertex !== null);
  const panel = page.locator('.selection');
  assert.equal(await panel.locator('h3').first().textContent(), `front_left_arm, node ${1001 + chosen!.vertex!}`);
  assert.match((await panel.textContent())!, /8\.4 kg.*Elastic displacement.*Position/s);
  await panel.locator('.u-over').first().waitFor();
  await page.keyboard.press('Escape');
  assert.equal(await page.evaluate(() => window.floatframe!.selected), null);

  const time = (): Promise<number> => page.evaluate(() => window.floatframe!.time);
  await page.keyboard.press('Home');
  assert.equal(await time(), 0);
  await page.keyboard.press('ArrowRight');
  assert.ok(Math.abs((await time()) - 0.02) < 1e-12);
  await page.keyboard.press('Shift+ArrowRight');
  assert.ok(Math.abs((await time()) - 0.22) < 1e-12);
  await page.keyboard.press('End');
  assert.equal(await time(), 4);
  await page.keyboard.press('[');
  assert.equal(await page.getByLabel('Speed').inputValue(), '0.5');
  await page.keyboard.press('Home');
  await page.keyboard.press(' ');
  await page.waitForFunction(() => window.floatframe!.time > 0.05);
  await page.keyboard.press(' ');
  const stopped = await time();
  await page.waitForTimeout(150);
  assert.equal(await time(), stopped);
  await page.keyboard.press('?');
  assert.ok(await page.locator('dialog.help').isVisible());
  await page.keyboard.press('Escape');
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save a picture' }).click();
  assert.match((await download).suggestedFilename(), /^vehicle-.*s\.png$/);
  assert.match((await page.evaluate(() => window.floatframe!.screenshot()))!, /^data:image\/png;base64,.{5000}/);
  assert.deepEqual(errors, []);
  await page.context().close();
});

test('a second run is dropped on the page', async () => {
  const { page, errors } = await open(browser, path('vehicle', vehicle()));
  const drop = (name: string, text: string): Promise<void> =>
    page.evaluate(
      ({ name: file, text: content }) => {
        const transfer = new DataTransfer();
        transfer.items.add(new File([content], file, { type: 'text/csv' }));
        window.dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }));
      },
      { name, text },
    );
  const message = page.locator('#curves .message');
  await drop('wrong.csv', 'x,y\n1,2\n');
  await message.getByText('first column is "x", expected "time"').waitFor();
  await drop('other.csv', 'time,elsewhere\n0,1\n');
  await message.getByText('has no channel of this page').waitFor();
  await drop('second.csv', `# run 2\ntime,${CHANNEL},elsewhere\n0,6,1\n2,6.1,1\n4,6.2,1\n`);
  await message.getByText(/1 of 18 channels is laid over/).waitFor();
  assert.match((await message.textContent())!, /The file has no chassis_x.*This page has no elsewhere\./);
  const plot = page.locator('#curves .plot', { has: page.locator(`[title="${CHANNEL}"]`) });
  await plot.scrollIntoViewIfNeeded();
  await plot.getByText(/Δ max 0\.\d+, rms/).waitFor();
  await page.getByRole('button', { name: 'Difference' }).click();
  await page.getByRole('button', { name: 'Take the second run away' }).click();
  assert.ok(await message.isHidden());
  assert.deepEqual(errors, []);
  await page.context().close();
});

test('results.csv that the program wrote is laid over the page it wrote', { skip: existsSync(program) ? false : 'no program: make build' }, async () => {
  const out = ['first', 'second'].map((name, k) => {
    const target = join(folder, `overlay_${name}`);
    const run = spawnSync(program, ['run', join('..', 'examples', 'slider_crank', 'slider_crank.yaml'), '--duration', '0.02', '--step', k === 0 ? '1e-4' : '2e-4', '--out', target], { encoding: 'utf8' });
    assert.equal(run.status, 0, run.stderr);
    return target;
  });
  const { page, errors } = await open(browser, join(out[0], 'report.html'));
  const text = readFileSync(join(out[1], 'results.csv'), 'utf8');
  const drop = (content: string): Promise<void> =>
    page.evaluate((csv) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([csv], 'results.csv', { type: 'text/csv' }));
      window.dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }));
    }, content);
  const message = page.locator('#curves .message');
  await drop(text);
  const channels = text.split('\n')[0].split(',').length - 1;
  await message.getByText(`results.csv: ${channels} of ${channels} channels are laid over`).waitFor();
  await drop(text.replace('[m]', '[ft]'));
  await message.getByText(/Left out: .* is in ft, here in m/).waitFor();
  await drop('time [s],x [m]\n100,1\n101,2\n');
  await message.getByText(/lie outside those of this page/).waitFor();
  assert.deepEqual(errors, []);
  await page.context().close();
});

test('dark and narrow: nothing wider than the window', async () => {
  const file = path('vehicle', vehicle());
  const looks: [number, number, boolean][] = [[1440, 900, true], [390, 844, false], [390, 844, true], [2560, 1300, false]];
  const grounds = new Set<string>();
  for (const [width, height, dark] of looks) {
    const { page, errors } = await open(browser, file, { width, height, dark });
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), `${width} pixels`);
    const clipped = await page.evaluate(() => [...document.querySelectorAll('main *')].filter((e) => e.getBoundingClientRect().right > window.innerWidth + 1 && !e.closest('.scroll, .frame, .plot-box')).map((e) => e.className));
    assert.deepEqual(clipped, []);
    grounds.add(await page.evaluate(() => getComputedStyle(document.body).backgroundColor));
    await snap(page, `look_${width}_${dark ? 'dark' : 'light'}`);
    assert.deepEqual(errors, []);
    if (width === 1440) {
      await page.getByRole('button', { name: 'Light or dark' }).click();
      grounds.add(await page.evaluate(() => getComputedStyle(document.body).backgroundColor));
    }
    await page.context().close();
  }
  assert.equal(grounds.size, 2);
});

test('a comparison by the program: largest difference first, both curves, a verdict', { skip: existsSync(program) ? false : 'no program: make build' }, async (t) => {
  const table = (pitch: number): string => `time [s],height [m],<img src=x onerror="window.hacked=1"> [rad],same [m]\n${Array.from({ length: 50 }, (_, k) => `${k / 10},${Math.sin(k)},${Math.cos(k) + pitch * k},${k}\n`).join('')}`;
  writeFileSync(join(folder, 'first.csv'), table(0));
  writeFileSync(join(folder, 'second.csv'), table(0.01));
  const target = join(folder, 'compared.html');
  const run = spawnSync(program, ['compare', join(folder, 'first.csv'), join(folder, 'second.csv'), '--tolerance', '1e-6', '--report', target], { encoding: 'utf8' });
  assert.equal(run.status, 1, run.stderr);
  const { page, errors } = await open(browser, target);
  if ((await page.locator('#floatframe-page').count()) === 0) return t.skip('the program was built without the viewer');
  assert.deepEqual(await page.evaluate(() => window.floatframe!.problems), []);
  assert.match((await page.locator('#status').textContent())!, /They differ.*1 of 3 channels at 50 instants beyond 1e-06/);
  const titles = await page.locator('#curves .plot-title').allTextContents();
  assert.equal(titles.length, 3);
  assert.match(titles[0], /^<img src=x/);
  assert.match((await page.locator('#curves tbody tr.beyond').textContent())!, /0\.49/);
  await page.locator('#curves .plot').first().scrollIntoViewIfNeeded();
  await page.locator('#curves .chip-note').first().filter({ hasText: 'Δ max 0.49' }).waitFor();
  assert.match((await page.locator('#facts').textContent())!, /first\.csv.*second\.csv/);
  assert.equal(await page.evaluate(() => (window as { hacked?: number }).hacked), undefined);
  assert.equal(await page.locator('img').count(), 0);
  assert.deepEqual(errors, []);
  await page.context().close();
});

test('fingers: the view turns and comes nearer, plots zoom', async () => {
  const { page, errors } = await open(browser, path('vehicle', vehicle()), { width: 420, height: 900 });
  const session = await page.context().newCDPSession(page);
  await session.send('Emulation.setTouchEmulationEnabled', { enabled: true, maxTouchPoints: 2 });
  type Places = [number, number][];
  const touch = (type: 'touchStart' | 'touchMove' | 'touchEnd', places: Places): Promise<unknown> => session.send('Input.dispatchTouchEvent', { type, touchPoints: places.map(([x, y], id) => ({ x, y, id })) });
  const glide = async (from: Places, to: Places): Promise<void> => {
    await touch('touchStart', from);
    for (let k = 1; k <= 5; ++k) await touch('touchMove', from.map(([x, y], i) => [x + ((to[i][0] - x) * k) / 5, y + ((to[i][1] - y) * k) / 5]));
    await touch('touchEnd', []);
  };
  const canvas = page.locator('canvas.canvas');
  await canvas.scrollIntoViewIfNeeded();
  const frame = (await canvas.boundingBox())!;
  const [x, y] = [frame.x + frame.width / 2, frame.y + frame.height / 2];
  const bar = (): Promise<string> => page.locator('.gizmo .scale').evaluate((e) => `${e.textContent} ${(e.firstElementChild as HTMLElement).style.width}`);
  const axes = (): Promise<string> => page.locator('.gizmo svg').innerHTML();
  const [bar0, axes0] = [await bar(), await axes()];
  await glide([[x, y]], [[x + 90, y + 20]]);
  await page.waitForFunction((old) => document.querySelector('.gizmo svg')!.innerHTML !== old, axes0);
  await glide([[x - 30, y], [x + 30, y]], [[x - 120, y], [x + 120, y]]);
  await page.waitForFunction((old) => { const e = document.querySelector('.gizmo .scale')!; return `${e.textContent} ${(e.firstElementChild as HTMLElement).style.width}` !== old; }, bar0);

  // Plots are made when they are near.
  await page.locator('#curves .plot').first().scrollIntoViewIfNeeded();
  const over = page.locator('#curves .plot .u-over').first();
  await over.scrollIntoViewIfNeeded();
  const box = (await over.boundingBox())!;
  const [left, middle] = [box.x + box.width / 2, box.y + box.height / 2];
  const ticks = (): Promise<number> => page.evaluate(() => window.floatframe!.time);
  const before = await ticks();
  await glide([[left - 20, middle], [left + 20, middle]], [[left - 80, middle], [left + 80, middle]]);
  assert.ok(await page.getByRole('button', { name: 'Whole run' }).isEnabled());
  assert.equal(await ticks(), before, 'zooming is not seeking');
  await page.getByRole('button', { name: 'Whole run' }).click();
  assert.ok(await page.getByRole('button', { name: 'Whole run' }).isDisabled());
  assert.deepEqual(errors, []);
  await page.context().close();
});

test('check, reduce and compare', async () => {
  const first = await open(browser, path('check', check()));
  assert.ok(await first.page.getByLabel('Names', { exact: true }).isChecked());
  assert.ok(await first.page.getByLabel('Joints').isChecked());
  assert.equal(await first.page.locator('.player').count(), 0);
  assert.equal(await first.page.locator('#curves').count(), 0);
  assert.deepEqual(first.errors, []);
  await first.page.context().close();

  const part = await open(browser, path('reduce', reduce()));
  const swing = (): Promise<number[]> =>
    part.page.evaluate(() => {
      window.floatframe!.setTime(0.5);
      return window.floatframe!.pointPosition(1)!;
    });
  await part.page.getByRole('button', { name: /210.6 Hz/ }).click();
  const torsion = await swing();
  await part.page.getByRole('button', { name: /31.2 Hz/ }).click();
  const bending = await swing();
  // A quarter of a swing: the largest displacement is a tenth of the length.
  assert.ok(Math.abs(bending[2] - 0.08) < 0.004, String(bending));
  assert.ok(Math.abs(torsion[2]) < 1e-9);
  assert.equal(await part.page.locator('.mode').count(), 9);
  assert.deepEqual(part.errors, []);
  await part.page.context().close();

  const two = await open(browser, path('compare', compare()));
  assert.match((await two.page.locator('#curves tbody').textContent())!, /travelm0.062/);
  await two.page.getByRole('button', { name: 'Difference' }).click();
  assert.deepEqual(two.errors, []);
  await two.page.context().close();
});

test('hostile names are text', async () => {
  const { page, errors } = await open(browser, path('hostile', vehicle({ hostile: true })));
  await page.getByLabel('Names', { exact: true }).check();
  await page.getByRole('tab', { name: 'Bodies' }).click();
  await page.locator('.body-name').first().click();
  assert.equal(await page.evaluate(() => (window as { hacked?: number }).hacked), undefined);
  assert.equal(await page.locator('img').count(), 0);
  assert.match((await page.locator('h1').textContent())!, /vehicle<img src=x/);
  assert.deepEqual(errors, []);
  await page.context().close();
});

test('the longest names stay within the window', async () => {
  const { page: json, writer } = vehicle();
  const long = 'W'.repeat(100);
  json.title = long;
  json.scene!.bodies.slice(0, 2).forEach((body) => (body.name = long + body.name));
  json.scene!.joints![0].name = long;
  json.curves!.channels.forEach((channel, k) => {
    if (k < 3) channel.body = channel.name = long;
  });
  json.facts = [...(json.facts ?? []), { heading: long, columns: ['body', long], rows: [[long, long]] }];
  json.status = { ...json.status, sentences: [long], warnings: [long] };
  const file = path('long', { page: json, writer });
  for (const width of [1400, 420]) {
    const { page, errors } = await open(browser, file, { width, height: 900 });
    const wide = await page.evaluate(() => [...document.querySelectorAll('body *')].filter((e) => e.getBoundingClientRect().right > window.innerWidth + 1 && !e.closest('.scroll, .frame, .plot-box, nav')).map((e) => `${e.tagName}.${e.className}`));
    assert.deepEqual(wide, [], `${width} pixels`);
    const wider = await page.evaluate(() => [...document.querySelectorAll('body *')].filter((e) => e.getBoundingClientRect().right > window.innerWidth + 1).map((e) => `${e.tagName}.${String(e.className)} in ${String(e.parentElement!.className)} ${e.getBoundingClientRect().right}`));
    assert.deepEqual(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth) ? [] : wider.slice(0, 8), [], `${width} pixels`);
    assert.deepEqual(errors, []);
    await page.context().close();
  }
});

test('damaged pages say what is wrong and are never blank', async () => {
  for (const [name, { html: text, says }] of Object.entries(damaged(html))) {
    const { page, errors } = await open(browser, write(`damaged_${name}`, text));
    await page.waitForFunction((pattern) => new RegExp(pattern).test(document.querySelector('main')?.textContent ?? ''), says.source, { timeout: 15_000 }).catch(async () => {
      assert.fail(`${name}: expected ${says}, found: ${(await page.locator('main').textContent())!.slice(0, 300)}`);
    });
    assert.deepEqual(errors, [], name);
    await page.context().close();
  }
});

test('without WebGL the rest works and says why', async () => {
  const plain = await launch([], false);
  const { page } = await open(plain, path('vehicle', vehicle()));
  assert.match((await page.locator('#view').textContent())!, /needs WebGL 2, which this browser does not give/);
  assert.ok((await page.locator('#curves .plot').count()) > 4);
  await page.locator('#curves .u-over').first().waitFor();
  assert.ok(await page.locator('#trust').isVisible());
  await plain.close();
});

test('trust: curves of their own times, limits, terms that are small, and step times', async () => {
  const made = vehicle();
  const { page, errors } = await open(browser, path('trust', made));
  const trust = page.locator('#trust');
  await trust.scrollIntoViewIfNeeded();
  assert.deepEqual(
    await trust.locator('h3').allTextContents(),
    ['Constraints', 'Energy balance', 'Iterations and substeps', 'Range of the method'],
  );
  // Terms of the balance share an axis; what is small beside them has one of its own.
  const titles = await trust.locator('.trust-energy .plot-title').allTextContents();
  assert.deepEqual(titles, ['Terms of the balance', 'Small terms']);
  const small = await trust.locator('.trust-energy .plot').nth(1).locator('.chip-label').allTextContents();
  assert.deepEqual(small, ['elastic', 'balance'], 'below a fiftieth of the largest term');
  assert.equal(await trust.locator('.trust-energy .hint').textContent(), made.page.trust!.notes!.energy);
  // The body that deforms most comes first; its limit is on the axis, since it comes near.
  const range = trust.locator('.trust-range .plot');
  assert.equal((await range.locator('.chip-label').allTextContents())[0], 'rear_right_arm');
  assert.equal(await range.locator('.plot-note').textContent(), 'limit 10 %');
  await at(page, 1.5);
  await range.scrollIntoViewIfNeeded();
  const shown = Number((await range.locator('.chip-value').first().textContent())!.replace('\u2212', '-'));
  assert.ok(Math.abs(shown - 4.5 * Math.sin(13.5) ** 2) < 0.1, String(shown));
  assert.ok(await range.locator('.time-cursor').isVisible());
  // Before the first step nothing is counted.
  await at(page, 0);
  assert.ok(Number.isNaN(await page.evaluate(() => window.floatframe!.channelValue('iterations'))));
  // Zooming one zooms all.
  const before = await range.locator('.u-over').boundingBox();
  await page.mouse.move(before!.x + 0.3 * before!.width, before!.y + 40);
  await page.mouse.down();
  await page.mouse.move(before!.x + 0.6 * before!.width, before!.y + 40, { steps: 4 });
  await page.mouse.up();
  await at(page, 3.9);
  await page.waitForTimeout(100);
  assert.ok(!(await range.locator('.time-cursor').isVisible()), 'the time is outside of what is shown');
  const speed = page.locator('#speed');
  assert.deepEqual(await speed.locator('.quantile').allTextContents(), ['median 0.086 ms', '99 % 0.17 ms']);
  const bars = (await speed.locator('.bars').boundingBox())!;
  const { edges } = made.page.speed!.step_times!;
  const line = (await speed.locator('.quantile').first().boundingBox())!;
  const expected = (0.086 - edges[0]) / (edges[edges.length - 1] - edges[0]);
  assert.ok(Math.abs((line.x - bars.x) / bars.width - expected) < 0.01);
  assert.deepEqual(errors, []);
  await page.context().close();
});
