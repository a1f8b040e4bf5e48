import assert from 'node:assert/strict';
import { test } from 'node:test';
import { deflateSync } from 'node:zlib';
import { decodeBuffer, PageBuffer, PageError } from '../../src/data/buffer';
import { groupChannels, readChannel, shareAxes, type Channel } from '../../src/data/channels';
import { parseCsv } from '../../src/data/csv';
import { formatLength, formatNumber, niceBelow, tickText } from '../../src/data/format';
import { halfToFloat } from '../../src/data/half';
import { difference, interval, rangeOf, resample, union, valueAt } from '../../src/data/series';
import { BufferWriter, toHalf } from '../pages/writer';

test('half floats: every number is the nearest of its own', () => {
  for (const [bits, value] of [[0x0000, 0], [0x3c00, 1], [0xc000, -2], [0x7bff, 65504], [0x0001, 2 ** -24], [0x0400, 2 ** -14], [0x3555, 0.333251953125]]) {
    assert.equal(halfToFloat(bits), value);
  }
  assert.equal(halfToFloat(0x7c00), Infinity);
  assert.ok(Number.isNaN(halfToFloat(0x7e00)));
  for (let bits = 0; bits < 0x7c00; ++bits) assert.equal(toHalf(halfToFloat(bits)), bits);
});

test('views are read from the buffer, raw and deflated', async () => {
  const writer = new BufferWriter();
  const single = writer.view('f32', [1.5, -2, 3], [3]);
  const wide = writer.view('f64', [Math.PI, 1e300], [2]);
  const index = writer.view('u32', [7, 70000], [1, 2]);
  const half = writer.view('f16', [0.5, -4], [2]);
  for (const packed of [false, true]) {
    const bytes = packed ? deflateSync(writer.buffer()) : writer.buffer();
    const buffer = await decodeBuffer(bytes.toString('base64'), packed ? 'deflate' : null);
    assert.deepEqual([...buffer.read(single, 'x', ['f32'], [3])], [1.5, -2, 3]);
    assert.deepEqual([...buffer.read(wide, 'x', ['f64'], [null])], [Math.PI, 1e300]);
    assert.deepEqual([...buffer.read(index, 'x', ['u16', 'u32'], [1, 2])], [7, 70000]);
    assert.deepEqual([...buffer.read(half, 'x', ['f16'], [2])].map(halfToFloat), [0.5, -4]);
  }
});

test('views at any offset are read, also where the type would not allow it', () => {
  const bytes = new Uint8Array(14);
  new DataView(bytes.buffer).setFloat64(3, 42.5, true);
  assert.equal(new PageBuffer(bytes).read({ type: 'f64', offset: 3, shape: [1] }, 'x', ['f64'], [1])[0], 42.5);
});

test('views that do not fit are refused with a sentence', async () => {
  const buffer = new PageBuffer(new Uint8Array(16));
  const read = (view: object): unknown => buffer.read(view as never, 'Motion', ['f32'], [null, 2]);
  assert.throws(() => read({ type: 'f32', offset: 8, shape: [2, 2] }), /Motion: the numbers end beyond/);
  assert.throws(() => read({ type: 'f32', offset: -8, shape: [1, 2] }), /end beyond/);
  assert.throws(() => read({ type: 'f64', offset: 0, shape: [1, 2] }), /of type f64, expected f32/);
  assert.throws(() => read({ type: 'f32', offset: 0, shape: [4] }), /the shape is 4, expected any x 2/);
  assert.throws(() => read({ type: 'f32', offset: 0, shape: [0.5, 2] }), PageError);
  assert.throws(() => read(null as never), /no array/);
  await assert.rejects(decodeBuffer('***', null), /base64/);
  await assert.rejects(decodeBuffer('AAAA', 'deflate'), /cannot be unpacked/);
  await assert.rejects(decodeBuffer('', 'zip'), /packed as "zip"/);
});

test('results.csv: comments, quotes, gaps and torn lines', () => {
  const table = parseCsv('# floatframe\n\ufefftime,"a, ""b""",c\r\n0,1,2\n0.5,,3\n# between\n1,4,5\n1.5,6\nx,1,2\n0.2,0,0\n');
  assert.deepEqual([...table.time], [0, 0.5, 1]);
  assert.deepEqual([...table.columns.keys()], ['a, "b"', 'c']);
  assert.deepEqual([...table.columns.get('c')!], [2, 3, 5]);
  assert.ok(Number.isNaN(table.columns.get('a, "b"')![1]));
  assert.equal(table.skipped, 3);
  // As the program writes it.
  const units = parseCsv('time [s],chassis.z [m],e []\n0,1,2\n');
  assert.deepEqual([...units.columns.keys()], ['chassis.z', 'e']);
  assert.deepEqual([...units.units], [['chassis.z', 'm']]);
  assert.throws(() => parseCsv('time [ms],a\n0,1\n'), /times are in "ms"/);
  assert.throws(() => parseCsv('t,a\n0,1\n'), /first column is "t", expected "time"/);
  assert.throws(() => parseCsv('# only\n'), /no rows/);
  assert.throws(() => parseCsv('time,a\n'), /no rows of numbers/);
});

test('values between samples', () => {
  const time = [0, 1, 3];
  assert.equal(interval(time, -1), 0);
  assert.equal(interval(time, 1), 1);
  assert.equal(interval(time, 99), 1);
  assert.equal(interval([0, 1, 2, 3, 4], 3.5, 2), 3);
  assert.equal(valueAt(time, [0, 10, 30], 2), 20);
  assert.equal(valueAt(time, [0, 10, 30], 3), 30);
  assert.ok(Number.isNaN(valueAt(time, [0, 10, 30], 3.1)));
  assert.equal(valueAt([5], [7], 5), 7);
  assert.deepEqual([...union([0, 1, 2], [0.5, 1, 3])], [0, 0.5, 1, 2, 3]);
  assert.deepEqual([...resample(time, [0, 10, 30], [0, 0.5, 2.5, 3])], [0, 5, 25, 30]);
  assert.equal(rangeOf([NaN]), null);
});

test('differences of curves on different instants', () => {
  const fine = Array.from({ length: 1001 }, (_, k) => k / 1000);
  const coarse = [0, 0.25, 1];
  const found = difference(fine, fine.map((t) => 2 * t), coarse, coarse.map((t) => 2 * t + 3 * t))!;
  assert.ok(Math.abs(found.max - 3) < 1e-12);
  assert.equal(found.at, 1);
  assert.ok(Math.abs(found.rms - Math.sqrt(3)) < 1e-9);
  assert.equal(difference([0, 1], [1, 1], [2, 3], [1, 1]), null);
});

function channel(name: string, low: number, high: number, more: Partial<Channel> = {}): Channel {
  const values = Float64Array.of(low, high);
  return { name, label: name, unit: 'm', body: 'a', kind: 'position', group: '', time: Float64Array.of(0, 1), values, range: rangeOf(values), still: null, other: null, stated: null, ...more };
}

test('channels share an axis only where it fits each', () => {
  const names = (groups: Channel[][]): string[] => groups.map((group) => group.map((c) => c.name).join(' '));
  assert.deepEqual(names(shareAxes([channel('x', 0, 100), channel('z', 0.5, 0.7), channel('y', 0, 40)])), ['x y', 'z']);
  // The same span, but far from each other.
  assert.deepEqual(names(shareAxes([channel('p', 0, 1), channel('q', 50, 51)])), ['p', 'q']);
  assert.equal(shareAxes(Array.from({ length: 20 }, (_, k) => channel(`c${k}`, 0, 1))).length, 3);
});

test('channels are grouped by body, kind and unit; still ones are text', () => {
  const groups = groupChannels([channel('a', 0, 1), channel('b', 0, 1, { kind: 'angle' }), channel('c', 0, 1, { body: null }), channel('d', 1, 1, { still: 'constant' }), channel('e', 0, 1, { unit: 'mm' })]);
  assert.deepEqual(groups.map((g) => g.body), [null, 'a']);
  assert.deepEqual(groups[1].plots.map((p) => p.channels.map((c) => c.name)), [['a'], ['b'], ['e']]);
  assert.deepEqual(groups[1].still.map((c) => c.name), ['d']);
});

test('a channel adds its offset; equal values are constant', () => {
  const writer = new BufferWriter();
  const json = { name: 'z', data: writer.view('f32', [0, 0.25]), offset: 1e6 };
  const flat = { name: 'f', data: writer.view('f32', [2, 2]), offset: 0 };
  const curves = { time: writer.view('f64', [0, 1]), channels: [] };
  const buffer = new PageBuffer(writer.buffer());
  assert.deepEqual([...readChannel(json, curves, Float64Array.of(0, 1), buffer).values], [1e6, 1e6 + 0.25]);
  assert.equal(readChannel(flat, curves, Float64Array.of(0, 1), buffer).still, 'constant');
  assert.throws(() => readChannel({ ...json, data: { ...json.data, shape: [1] } }, curves, Float64Array.of(0, 1), buffer), /Channel "z": the shape is 1, expected 2/);
});

test('numbers as text', () => {
  assert.equal(formatNumber(0), '0');
  assert.equal(formatNumber(-1234.5678), '\u22121235');
  assert.equal(formatNumber(0.00123456), '0.001235');
  assert.equal(formatNumber(1.5e-9), '1.5e\u22129');
  assert.equal(formatNumber(100), '100');
  assert.equal(formatLength(0.0025), '2.5 mm');
  assert.equal(niceBelow(0.073), 0.05);
});

test('numbers along an axis have the digits of their step', () => {
  assert.deepEqual(tickText([0, 2.5, 5, 7.5, 10]), ['0.0', '2.5', '5.0', '7.5', '10.0'].map((t) => (t === '0.0' ? '0' : t)));
  assert.deepEqual(tickText([0, 0.025, 0.05]), ['0', '0.025', '0.050']);
  assert.deepEqual(tickText([-20, 0, 20]), ['\u221220', '0', '20']);
  assert.deepEqual(tickText([0, 0.5, 1]), ['0', '0.5', '1.0']);
  assert.deepEqual(tickText([0, 2.5e-10, 5e-10]), ['0', '2.5e\u221210', '5.0e\u221210']);
  assert.ok(new Set(tickText([0, 1 / 3, 2 / 3])).size === 3);
});
