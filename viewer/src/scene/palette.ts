// Colours that people with any colour vision can tell apart.

import { DataTexture, LinearFilter, RGBAFormat, SRGBColorSpace } from 'three';

export type MapName = 'viridis' | 'cividis';

const MAPS: Record<MapName, string[]> = {
  viridis: ['#440154', '#482475', '#414487', '#355f8d', '#2a788e', '#21918c', '#22a884', '#44bf70', '#7ad151', '#bddf26', '#fde725'],
  cividis: ['#00224e', '#123570', '#3b496c', '#575d6d', '#707173', '#8a8678', '#a59c74', '#c3b369', '#e1cc55', '#fee838'],
};

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

export function mapCss(name: MapName): string {
  return `linear-gradient(to right, ${MAPS[name].join(', ')})`;
}

export function mapStops(name: MapName): string[] {
  return MAPS[name];
}

const textures = new Map<MapName, DataTexture>();

export function mapTexture(name: MapName): DataTexture {
  const known = textures.get(name);
  if (known) return known;
  const stops = MAPS[name].map(channels);
  const data = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; ++i) {
    const x = (i / 255) * (stops.length - 1);
    const k = Math.min(Math.floor(x), stops.length - 2);
    for (let c = 0; c < 3; ++c) data[4 * i + c] = Math.round(stops[k][c] + (x - k) * (stops[k + 1][c] - stops[k][c]));
    data[4 * i + 3] = 255;
  }
  const texture = new DataTexture(data, 256, 1, RGBAFormat);
  texture.colorSpace = SRGBColorSpace;
  texture.magFilter = LinearFilter;
  texture.minFilter = LinearFilter;
  texture.needsUpdate = true;
  textures.set(name, texture);
  return texture;
}
