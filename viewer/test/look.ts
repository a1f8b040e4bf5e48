// Writes all pages and pictures of them, to be looked at: npm run look.

import { check, compare, large, reduce, sweep } from './pages/others';
import { vehicle } from './pages/vehicle';
import { modes } from './pages/vibrations';
import { fillTemplate } from './pages/writer';
import { launch, open, snap, template, write } from './browser';

const html = template();
const only = process.argv.slice(2);
const pages: Record<string, () => ReturnType<typeof vehicle>> = { vehicle, check, reduce, compare, large, modes, sweep };
const looks: [string, string, { width: number; height: number; dark?: boolean }, boolean][] = [
  ['vehicle', 'vehicle', { width: 1440, height: 900 }, true],
  ['vehicle_dark', 'vehicle', { width: 1440, height: 900, dark: true }, false],
  ['vehicle_narrow', 'vehicle', { width: 390, height: 844 }, true],
  ['vehicle_wide', 'vehicle', { width: 2560, height: 1300 }, false],
  ['check', 'check', { width: 1440, height: 900 }, false],
  ['reduce', 'reduce', { width: 1440, height: 900, dark: true }, true],
  ['compare', 'compare', { width: 1440, height: 900 }, true],
  ['large', 'large', { width: 1440, height: 900 }, false],
  ['modes', 'modes', { width: 1440, height: 900 }, true],
  ['sweep', 'sweep', { width: 1440, height: 900 }, true],
  ['sweep_narrow', 'sweep', { width: 390, height: 844, dark: true }, true],
  ['modes_narrow', 'modes', { width: 390, height: 844, dark: true }, true],
];
const browser = await launch();
for (const [name, source, size, whole] of looks) {
  if (only.length > 0 && !only.includes(name)) continue;
  const { page: json, writer } = pages[source]();
  const { page, errors, readyAfter } = await open(browser, write(source, fillTemplate(html, json, writer)), size);
  await page.evaluate(() => window.floatframe!.setTime(1.3));
  await page.waitForTimeout(1200);
  await snap(page, name, whole);
  console.log(name, `ready after ${readyAfter} ms`, errors, await page.evaluate(() => window.floatframe!.problems));
  await page.context().close();
}
await browser.close();
