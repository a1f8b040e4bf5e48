// Quaternions as x, y, z, w.

/** Shortest great arc from qa to qb (at offsets of arrays), at s in 0..1, normalised. */
export function slerp(a: ArrayLike<number>, ia: number, b: ArrayLike<number>, ib: number, s: number, out: Float64Array, io: number): void {
  let cosine = a[ia] * b[ib] + a[ia + 1] * b[ib + 1] + a[ia + 2] * b[ib + 2] + a[ia + 3] * b[ib + 3];
  const sign = cosine < 0 ? -1 : 1;
  cosine *= sign;
  let wa = 1 - s;
  let wb = s;
  if (cosine < 0.9995) {
    const angle = Math.acos(Math.min(1, cosine));
    const sine = Math.sin(angle);
    wa = Math.sin((1 - s) * angle) / sine;
    wb = Math.sin(s * angle) / sine;
  }
  wb *= sign;
  let square = 0;
  for (let k = 0; k < 4; ++k) {
    const value = wa * a[ia + k] + wb * b[ib + k];
    out[io + k] = value;
    square += value * value;
  }
  const length = Math.sqrt(square) || 1;
  for (let k = 0; k < 4; ++k) out[io + k] /= length;
}

/** v turned by the quaternion at q[i..i+3]. */
export function rotate(q: ArrayLike<number>, i: number, x: number, y: number, z: number): [number, number, number] {
  const qx = q[i];
  const qy = q[i + 1];
  const qz = q[i + 2];
  const qw = q[i + 3];
  const tx = 2 * (qy * z - qz * y);
  const ty = 2 * (qz * x - qx * z);
  const tz = 2 * (qx * y - qy * x);
  return [x + qw * tx + qy * tz - qz * ty, y + qw * ty + qz * tx - qx * tz, z + qw * tz + qx * ty - qy * tx];
}
