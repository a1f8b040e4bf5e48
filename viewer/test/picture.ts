// A picture of the 3-D view of a report: npm run picture -- REPORT.html OUT.png [SECONDS [SCALE [MODE]]]; OUT.webp is 900 pixels wide.

import { writeFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { launch, open } from './browser';

const [report, out, time, scale, mode] = process.argv.slice(2);
if (!report || !out) {
  console.error('usage: npm run picture -- REPORT.html OUT.png [SECONDS [SCALE [MODE]]]');
  process.exit(2);
}
const browser = await launch();
const { page, errors } = await open(browser, resolve(process.env.INIT_CWD ?? '.', report), { width: 1500, height: 1000 });
await page.evaluate(
  ([t, factor, number]) => {
    const shown = window.floatframe!;
    const numbers = [...document.querySelectorAll('.mode-number')].map((element) => Number(element.textContent));
    if (number !== null) shown.chooseMode(numbers.indexOf(number));
    if (t !== null) shown.setTime(t);
    if (factor !== null) shown.setScale(factor);
  },
  [time, scale, mode].map((text) => (text ? Number(text) : null)),
);
await page.waitForTimeout(2000);
const url = await page.evaluate(async (small) => {
  const whole = await window.floatframe!.screenshot();
  if (!whole || !small) return whole;
  const image = new Image();
  image.src = whole;
  await image.decode();
  const canvas = document.createElement('canvas');
  canvas.width = 900;
  canvas.height = Math.round((900 * image.height) / image.width);
  const context = canvas.getContext('2d')!;
  context.imageSmoothingQuality = 'high';
  context.drawImage(image, 0, 0, canvas.width, canvas.height);
  return canvas.toDataURL('image/webp', 0.85);
}, out.endsWith('.webp'));
await browser.close();
if (!url) {
  console.error(`${report} has no 3-D view here: ${errors.join('; ')}`);
  process.exit(1);
}
writeFileSync(resolve(process.env.INIT_CWD ?? '.', out), Buffer.from(url.slice(url.indexOf(',') + 1), 'base64'));
