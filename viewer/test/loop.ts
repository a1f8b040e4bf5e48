// A short film of the 3-D view of a report: npm run loop -- REPORT.html OUT.webp FROM TO [SCALE [MODE]].
//
// An animated WebP, which shows a second of a run in two, and modes at the pace of their page: the browser compresses each picture, here they are put into one file
// (https://developers.google.com/speed/webp/docs/riff_container).

import { writeFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { launch, open } from './browser';

const WIDTH = 780;
const PICTURES_A_SECOND = 20;
const SLOWER = 2;
const QUALITY = 0.62;

/** A chunk of a RIFF file: name, length, content, padded to an even length. */
function chunk(name: string, content: Buffer): Buffer {
  const head = Buffer.alloc(8);
  head.write(name, 0, 'latin1');
  head.writeUInt32LE(content.length, 4);
  return Buffer.concat([head, content, Buffer.alloc(content.length % 2)]);
}

/** The compressed picture of a still WebP file. */
function pictureOf(file: Buffer): Buffer {
  for (let at = 12; at + 8 <= file.length; ) {
    const name = file.toString('latin1', at, at + 4);
    const length = file.readUInt32LE(at + 4);
    if (name === 'VP8 ' || name === 'VP8L') return chunk(name, file.subarray(at + 8, at + 8 + length));
    at += 8 + length + (length % 2);
  }
  throw new Error('the browser gave no WebP picture');
}

function animated(stills: Buffer[], width: number, height: number, milliseconds: number): Buffer {
  const canvas = Buffer.alloc(10);
  canvas[0] = 0x02; // animated
  canvas.writeUIntLE(width - 1, 4, 3);
  canvas.writeUIntLE(height - 1, 7, 3);
  const frames = stills.map((still) => {
    const head = Buffer.alloc(16); // at 0, 0
    head.writeUIntLE(width - 1, 6, 3);
    head.writeUIntLE(height - 1, 9, 3);
    head.writeUIntLE(milliseconds, 12, 3);
    head[15] = 0x02; // in the place of the one before
    return chunk('ANMF', Buffer.concat([head, pictureOf(still)]));
  });
  const content = Buffer.concat([Buffer.from('WEBP'), chunk('VP8X', canvas), chunk('ANIM', Buffer.from([255, 255, 255, 255, 0, 0])), ...frames]);
  return chunk('RIFF', content);
}

const [report, out, from, to, scale, mode] = process.argv.slice(2);
const [begin, end] = [Number(from), Number(to)];
if (!report || !out || !(end > begin)) {
  console.error('usage: npm run loop -- REPORT.html OUT.webp FROM TO [SCALE [MODE]]    FROM and TO in seconds of the run');
  process.exit(2);
}
const here = process.env.INIT_CWD ?? '.';
const browser = await launch();
// A window in which the view is about as wide as the film, with room for its panel.
const { page, errors } = await open(browser, resolve(here, report), { width: 1180, height: 800 });
const count = Math.max(2, Math.round((end - begin) * PICTURES_A_SECOND * (mode ? 1 : SLOWER)));
const stills: Buffer[] = [];
let height = 0;
await page.evaluate(
  ([factor, number]) => {
    const numbers = [...document.querySelectorAll('.mode-number')].map((element) => Number(element.textContent));
    if (number !== null) window.floatframe!.chooseMode(numbers.indexOf(number));
    if (factor !== null) window.floatframe!.setScale(factor);
  },
  [scale, mode].map((text) => (text ? Number(text) : null)),
);
for (let k = 0; k < count; ++k) {
  const picture = await page.evaluate(
    async ({ time, width, quality }) => {
      window.floatframe!.setTime(time);
      const source = window.floatframe!.screenshot();
      if (!source) return null;
      const image = new Image();
      image.src = source;
      await image.decode();
      const height = 2 * Math.round((0.5 * width * image.height) / image.width);
      const canvas = Object.assign(document.createElement('canvas'), { width, height });
      const context = canvas.getContext('2d', { alpha: false })!;
      context.imageSmoothingQuality = 'high';
      context.drawImage(image, 0, 0, width, height);
      return { url: canvas.toDataURL('image/webp', quality), height };
    },
    { time: begin + ((end - begin) * k) / count, width: WIDTH, quality: QUALITY },
  );
  if (!picture) {
    console.error(`${report} has no 3-D view here: ${errors.join('; ')}`);
    await browser.close();
    process.exit(1);
  }
  height = picture.height;
  stills.push(Buffer.from(picture.url.slice(picture.url.indexOf(',') + 1), 'base64'));
}
await browser.close();
const file = animated(stills, WIDTH, height, Math.round(1000 / PICTURES_A_SECOND));
writeFileSync(resolve(here, out), file);
console.log(`${out}: ${count} pictures, ${(file.length / 1e6).toFixed(2)} MB`);
