// Colours: maps of scales, and those of bodies and symbols, which people with any colour vision can tell apart.

import { DataTexture, LinearFilter, NearestFilter, RGBAFormat, SRGBColorSpace } from 'three';

export type BaseMap = 'viridis' | 'cividis' | 'turbo';
/** A map, the number of its bands (0: smooth), and whether what is above the scale has a colour of its own: "turbo/10/over". */
export type MapName = BaseMap | `${BaseMap}/${number}` | `${BaseMap}/${number}/over`;

/** Turbo (A. Mikhailov 2019, as a polynomial) tells more steps apart, but not to all colour vision. */
function turbo(): string[] {
  const polynomials = [
    [34.61, 1172.33, -10793.56, 33300.12, -38394.49, 14825.05],
    [23.31, 557.33, 1225.33, -3574.96, 1073.77, 707.56],
    [27.2, 3211.1, -15327.97, 27814, -22569.18, 6838.66],
  ];
  const hex = (x: number): string =>
    polynomials.map((c) => Math.min(255, Math.max(0, Math.round(c.reduceRight((sum, a) => sum * x + a, 0)))).toString(16).padStart(2, '0')).join('');
  return Array.from({ length: 33 }, (_, k) => `#${hex(k / 32)}`);
}

const MAPS: Record<BaseMap, string[]> = {
  viridis: ['#440154', '#482475', '#414487', '#355f8d', '#2a788e', '#21918c', '#22a884', '#44bf70', '#7ad151', '#bddf26', '#fde725'],
  cividis: ['#00224e', '#123570', '#3b496c', '#575d6d', '#707173', '#8a8678', '#a59c74', '#c3b369', '#e1cc55', '#fee838'],
  turbo: turbo(),
};

/** Above the limit of a material. In none of the maps. */
export const OVER_COLOUR = '#e6007e';

/** Muted, of about equal lightness: bodies side by side, on a light and on a dark ground. */
export const BODY_COLOURS = ['#8197ae', '#c7a777', '#8db08c', '#b791a8', '#7cb0b8', '#a3a0c9', '#c5957f', '#aab08a'];
export const TYRE_COLOUR = '#43484f';
export const RIM_COLOUR = '#aeb6bf';
export const SPRING_COLOUR = '#d08a3c';
export const DAMPER_COLOUR = '#77818c';
export const ROD_COLOUR = '#8b949e';
export const JOINT_COLOUR = '#3f7fc4';
export const GUIDE_COLOUR = '#0f8f68';
export const CUT_COLOUR = '#c4563f';
export const FORCE_COLOUR = '#d5453b';
export const TORQUE_COLOUR = '#8a4fc4';
export const MARK_COLOUR = '#e8590c';
/** Outlines of the model at rest. */
export const STILL_COLOUR = '#7d8894';

/** Curves: Okabe and Ito's colours, the yellow darker, the black by theme. */
export const CURVE_COLOURS = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#56b4e9', '#e69f00', '#7a6ff0', '#8a8f98'];

function channels(hex: string): [number, number, number] {
  const value = parseInt(hex.slice(1), 16);
  return [value >> 16, (value >> 8) & 255, value & 255];
}

interface Look {
  base: BaseMap;
  bands: number;
  over: boolean;
}

export function mapName({ base, bands, over }: Look): MapName {
  return over ? `${base}/${bands}/over` : bands > 0 ? `${base}/${bands}` : base;
}

export function lookOf(name: MapName): Look {
  const [base, bands, over] = name.split('/');
  return { base: base as BaseMap, bands: Number(bands ?? 0), over: over !== undefined };
}

/** Red, green and blue at a part of the scale, 0 to 1. */
export function mapColour(name: MapName, part: number): [number, number, number] {
  const { base, bands } = lookOf(name);
  const stops = MAPS[base];
  const inside = Math.min(1, Math.max(0, part));
  const shown = bands > 1 ? Math.min(bands - 1, Math.floor(inside * bands)) / (bands - 1) : inside;
  const x = shown * (stops.length - 1);
  const k = Math.min(Math.floor(x), stops.length - 2);
  const [a, b] = [channels(stops[k]), channels(stops[k + 1])];
  return [0, 1, 2].map((c) => Math.round(a[c] + (x - k) * (b[c] - a[c]))) as [number, number, number];
}

function css(colour: [number, number, number]): string {
  return `rgb(${colour.join(' ')})`;
}

/** Places on the scale, 0 to 1, and colours, of a gradient from left to right. */
export function mapStops(name: MapName): [number, string][] {
  const { base, bands } = lookOf(name);
  if (bands > 1) return Array.from({ length: bands }, (_, k) => [k, k + 1].map((edge): [number, string] => [edge / bands, css(mapColour(name, (k + 0.5) / bands))])).flat();
  const stops = MAPS[base];
  return stops.map((colour, k) => [k / (stops.length - 1), colour]);
}

export function mapCss(name: MapName): string {
  return `linear-gradient(to right, ${mapStops(name).map(([at, colour]) => `${colour} ${(100 * at).toFixed(3)}%`).join(', ')})`;
}

const TEXELS = 256;

/** The range over which the texture is spread so that the colours between `low` and `high` are those of the scale. */
export function spreadOf([low, high]: [number, number], name: MapName): [number, number] {
  // The last texel is that of what is above: it begins half a texel before the end (scene/bending.ts).
  return lookOf(name).over ? [low, low + ((high - low) * (TEXELS - 1)) / (TEXELS - 1.5)] : [low, high];
}

const textures = new Map<MapName, DataTexture>();

export function mapTexture(name: MapName): DataTexture {
  const known = textures.get(name);
  if (known) return known;
  const { bands, over } = lookOf(name);
  const last = over ? TEXELS - 1.5 : TEXELS - 1;
  const data = new Uint8Array(TEXELS * 4);
  for (let i = 0; i < TEXELS; ++i) data.set([...(over && i === TEXELS - 1 ? channels(OVER_COLOUR) : mapColour(name, i / last)), 255], 4 * i);
  const texture = new DataTexture(data, TEXELS, 1, RGBAFormat);
  texture.colorSpace = SRGBColorSpace;
  texture.magFilter = bands > 0 || over ? NearestFilter : LinearFilter;
  texture.minFilter = texture.magFilter;
  texture.needsUpdate = true;
  textures.set(name, texture);
  return texture;
}
