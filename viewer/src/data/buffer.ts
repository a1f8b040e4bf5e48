// The buffer of the page: base64 text, possibly deflated, with arrays named by views.

import type { View, ViewType } from './page';

/** What is wrong with the data of the page, as a sentence for its reader. */
export class PageError extends Error {}

type Typed = Float32Array | Float64Array | Uint16Array | Uint32Array;

const BYTES: Record<ViewType, number> = { f16: 2, f32: 4, f64: 8, u16: 2, u32: 4 };

function decodeBase64(text: string): Uint8Array {
  const fast = (Uint8Array as unknown as { fromBase64?: (text: string) => Uint8Array }).fromBase64;
  try {
    if (fast) return fast.call(Uint8Array, text);
    const binary = atob(text);
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
    return bytes;
  } catch {
    throw new PageError('The numbers of this page are damaged: their base64 text cannot be read.');
  }
}

async function inflate(bytes: Uint8Array): Promise<Uint8Array> {
  if (typeof DecompressionStream === 'undefined') {
    throw new PageError('This browser cannot unpack the numbers of this page; one of 2023 or later can.');
  }
  try {
    const stream = new Blob([bytes as BlobPart]).stream().pipeThrough(new DecompressionStream('deflate'));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  } catch {
    throw new PageError('The numbers of this page are damaged or cut short: they cannot be unpacked.');
  }
}

export async function decodeBuffer(text: string, compression: string | null | undefined): Promise<PageBuffer> {
  const bytes = decodeBase64(text);
  if (!compression || compression === 'none') return new PageBuffer(bytes);
  if (compression !== 'deflate') throw new PageError(`The numbers of this page are packed as "${compression}", expected "deflate".`);
  return new PageBuffer(await inflate(bytes));
}

export class PageBuffer {
  readonly bytes: Uint8Array;

  constructor(bytes: Uint8Array) {
    this.bytes = bytes;
  }

  /** The array of a view. `types` and `shape` are what is expected; null in a shape is any length. */
  read(view: View, what: string, types: ViewType[], shape: (number | null)[]): Typed {
    const found = view && Array.isArray(view.shape) ? view : null;
    if (!found || !(found.type in BYTES)) throw new PageError(`${what}: no array is given.`);
    if (!types.includes(found.type)) throw new PageError(`${what}: numbers are of type ${found.type}, expected ${types.join(' or ')}.`);
    const fits = found.shape.length === shape.length && found.shape.every((n, k) => Number.isInteger(n) && n >= 0 && (shape[k] === null || shape[k] === n));
    if (!fits) {
      const expected = shape.map((n) => n ?? 'any').join(' x ');
      throw new PageError(`${what}: the shape is ${found.shape.join(' x ')}, expected ${expected}.`);
    }
    const count = found.shape.reduce((product, n) => product * n, 1);
    const size = count * BYTES[found.type];
    const offset = found.offset;
    if (!Number.isInteger(offset) || offset < 0 || offset + size > this.bytes.length) {
      throw new PageError(`${what}: the numbers end beyond the data of the page, which are cut short or damaged.`);
    }
    const start = this.bytes.byteOffset + offset;
    const aligned = start % BYTES[found.type] === 0;
    const buffer = aligned ? this.bytes.buffer : this.bytes.slice(offset, offset + size).buffer;
    const at = aligned ? start : 0;
    switch (found.type) {
      case 'f32':
        return new Float32Array(buffer, at, count);
      case 'f64':
        return new Float64Array(buffer, at, count);
      case 'u32':
        return new Uint32Array(buffer, at, count);
      default:
        return new Uint16Array(buffer, at, count);
    }
  }
}
