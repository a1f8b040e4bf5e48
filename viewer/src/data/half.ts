// Half floats: 1 sign bit, 5 of exponent, 10 of mantissa.

let table: Float32Array | null = null;

function decode(bits: number): number {
  const sign = bits & 0x8000 ? -1 : 1;
  const exponent = (bits >> 10) & 31;
  const mantissa = bits & 1023;
  if (exponent === 0) return sign * mantissa * 2 ** -24;
  if (exponent === 31) return mantissa ? NaN : sign * Infinity;
  return sign * (1 + mantissa / 1024) * 2 ** (exponent - 15);
}

/** All 65536 values; meshes of many modes are decoded through it. */
export function halfTable(): Float32Array {
  if (!table) {
    table = new Float32Array(65536);
    for (let bits = 0; bits < 65536; ++bits) table[bits] = decode(bits);
  }
  return table;
}

export function halfToFloat(bits: number): number {
  return halfTable()[bits & 0xffff];
}
