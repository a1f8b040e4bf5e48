// Writes pages as the program does: views into one buffer, JSON without "<", base64.

import { deflateSync } from 'node:zlib';
import type { PageJson, View, ViewType } from '../../src/data/page';

const SINGLE = new Float32Array(1);
const BITS = new Uint32Array(SINGLE.buffer);

/** Nearest half float, ties to even. */
export function toHalf(value: number): number {
  SINGLE[0] = value;
  const bits = BITS[0];
  const sign = (bits >>> 16) & 0x8000;
  const exponent = ((bits >>> 23) & 255) - 127 + 15;
  let mantissa = bits & 0x7fffff;
  if (((bits >>> 23) & 255) === 255) return sign | 0x7c00 | (mantissa ? 0x200 : 0);
  if (exponent >= 31) return sign | 0x7c00;
  if (exponent <= 0) {
    if (exponent < -10) return sign;
    mantissa |= 0x800000;
    const shift = 14 - exponent;
    const half = mantissa >>> shift;
    const rest = mantissa & ((1 << shift) - 1);
    const middle = 1 << (shift - 1);
    return sign | (half + (rest > middle || (rest === middle && half & 1) ? 1 : 0));
  }
  const half = (exponent << 10) | (mantissa >>> 13);
  const rest = mantissa & 0x1fff;
  return sign | (half + (rest > 0x1000 || (rest === 0x1000 && half & 1) ? 1 : 0));
}

export class BufferWriter {
  private readonly parts: Buffer[] = [];
  private size = 0;

  bytes(data: Uint8Array): { offset: number; length: number } {
    const offset = this.size;
    this.parts.push(Buffer.from(data));
    const pad = (8 - (data.length % 8)) % 8;
    if (pad) this.parts.push(Buffer.alloc(pad));
    this.size += data.length + pad;
    return { offset, length: data.length };
  }

  view(type: ViewType, values: ArrayLike<number>, shape: number[] = [values.length]): View {
    const array =
      type === 'f64' ? Float64Array.from(values)
      : type === 'f32' ? Float32Array.from(values)
      : type === 'u32' ? Uint32Array.from(values)
      : type === 'u16' ? Uint16Array.from(values)
      : Uint16Array.from(values, toHalf);
    const { offset } = this.bytes(new Uint8Array(array.buffer));
    return { type, offset, shape };
  }

  buffer(): Buffer {
    return Buffer.concat(this.parts);
  }
}

/** The template with its data; deflated unless `raw`. */
export function fillTemplate(template: string, page: PageJson, writer: BufferWriter, raw = false): string {
  const json = JSON.stringify({ ...page, ...(raw ? {} : { compression: 'deflate' }) }).replace(/</g, '\\u003c');
  const bytes = raw ? writer.buffer() : deflateSync(writer.buffer(), { level: 6 });
  return fillText(template, json, bytes.toString('base64'));
}

export function fillText(template: string, json: string, base64: string): string {
  const mark = '<!--FLOATFRAME-DATA-->';
  if (template.split(mark).length !== 2) throw new Error('the template has no place for data, or more than one');
  return template.replace(
    mark,
    () => `<script type="application/json" id="floatframe-page">${json}</script>\n<script type="application/octet-stream;base64" id="floatframe-buffer">${base64}</script>`,
  );
}
