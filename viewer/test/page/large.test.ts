// What a page of a large model costs.

import assert from 'node:assert/strict';
import { statSync } from 'node:fs';
import { after, before, test } from 'node:test';
import type { Browser } from 'playwright-core';
import { large } from '../pages/others';
import { fillTemplate } from '../pages/writer';
import { launch, open, template, write } from '../browser';

let browser: Browser;

before(async () => (browser = await launch()));
after(async () => browser?.close());

test('a large model: size of the page, and what a picture sends to the graphics processor', async () => {
  const made = large();
  const file = write('large', fillTemplate(template(), made.page, made.writer));
  const size = statSync(file).size;
  assert.ok(size < 15e6, `${size} bytes`);
  const { page, errors, readyAfter } = await open(browser, file);
  const time = (): Promise<number> => page.evaluate(() => window.floatframe!.time);
  // Bytes and calls are counted, not milliseconds: those belong to the machine and are printed only.
  await page.evaluate(() => {
    const counts = { bytes: 0, draws: 0 };
    const gl = WebGL2RenderingContext.prototype as unknown as Record<string, (...given: unknown[]) => unknown>;
    const count = (name: string, what: (given: unknown[]) => void): void => {
      const before = gl[name];
      gl[name] = function (this: unknown, ...given: unknown[]) {
        what(given);
        return before.apply(this, given);
      };
    };
    const bytes = (given: unknown[]): void => {
      for (const one of given) if (ArrayBuffer.isView(one)) counts.bytes += one.byteLength;
    };
    for (const name of ['bufferData', 'bufferSubData', 'texImage2D', 'texSubImage2D', 'uniformMatrix4fv', 'uniform3fv', 'uniform1fv']) count(name, bytes);
    for (const name of ['drawElements', 'drawArrays', 'drawElementsInstanced', 'drawArraysInstanced']) count(name, () => void ++counts.draws);
    (window as unknown as { counts: typeof counts }).counts = counts;
    window.floatframe!.resetScriptTime();
  });
  await page.keyboard.press(' ');
  // Enough pictures for a median, however busy the machine is.
  await page.waitForFunction(() => window.floatframe!.framesDrawn() >= 30, undefined, { timeout: 120_000 });
  const found = await page.evaluate(() => {
    const pictures = window.floatframe!.framesDrawn();
    const counts = (window as unknown as { counts: { bytes: number; draws: number } }).counts;
    return { bytes: counts.bytes / pictures, draws: counts.draws / pictures, script: window.floatframe!.frameScriptTime(), rate: window.floatframe!.frameRate() };
  });
  console.log(`large page: ${(size / 1e6).toFixed(1)} MB, ready after ${readyAfter} ms, ${found.bytes.toFixed(0)} bytes and ${found.draws.toFixed(1)} draws a picture, script ${found.script.toFixed(2)} ms, ${found.rate.toFixed(1)} pictures a second`);
  assert.ok((await time()) > 0);
  // 12 bodies of 10,000 triangles and 20 modes: amplitudes and matrices are sent, no vertex is.
  assert.ok(found.bytes > 12 * 20 * 4 && found.bytes < 65_536, `${found.bytes} bytes a picture`);
  assert.ok(found.draws >= 12 && found.draws < 120, `${found.draws} draws a picture`);
  assert.deepEqual(errors, []);
  await page.context().close();
});
