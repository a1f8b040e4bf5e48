// Names in the view: small textures of text that keep their size on the screen.

import { CanvasTexture, LinearFilter, Sprite, SpriteMaterial, SRGBColorSpace, Vector2 } from 'three';

const HEIGHT = 22;
/** Where it stands from its point, in parts of its size; how many rows it may move up by. */
const BESIDE = 0.06;
const ABOVE = 0.35;
const ROWS = 4;
/** Left of its point a name ends as far from it as it begins right of it. */
const SIDES = ['right', 'left'] as const;

export interface Box {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

let kept: Box[] = [];
let [pictureWidth, pictureHeight] = [Infinity, Infinity];

/** Parts of the picture that other things cover, and its size: names lie within and beside them. Pixels from the left and the top. */
export function keepFree(boxes: Box[], width: number, height: number): void {
  kept = boxes;
  [pictureWidth, pictureHeight] = [width, height];
}

function overlap(a: Box, b: Box): boolean {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

interface Place {
  box: Box;
  /** Rows above its own place; below the point where negative. */
  row: number;
  side: (typeof SIDES)[number];
}

/** The free place of a name that is nearest to its point - right, left, above, below -, in pixels from the left and the top. */
export function placeBeside(width: number, x: number, y: number, taken: Box[]): Place | null {
  for (let k = 0; k < ROWS; ++k) {
    for (const side of SIDES) {
      for (const row of k === 0 ? [0] : [k, -k - 2 * ABOVE]) {
        const left = side === 'right' ? x + BESIDE * width : x - (1 + BESIDE) * width;
        const bottom = y - (ABOVE + row) * HEIGHT;
        const box = { left, right: left + width, top: bottom - HEIGHT, bottom };
        if (box.left < 0 || box.top < 0 || box.right > pictureWidth || box.bottom > pictureHeight) continue;
        if (![...taken, ...kept].some((other) => overlap(box, other))) return { box, row, side };
      }
    }
  }
  return null;
}

export class Label {
  readonly sprite: Sprite;
  private readonly width: number;
  /** It belongs into the picture; whether there is room for it, `arrange` says. */
  wanted = false;

  constructor(text: string, dark: boolean, strong: boolean) {
    const ratio = Math.min(3, Math.max(2, window.devicePixelRatio || 1));
    const canvas = document.createElement('canvas');
    const shown = text.length > 40 ? `${text.slice(0, 39)}…` : text;
    const font = `${strong ? 600 : 500} ${12 * ratio}px system-ui, -apple-system, "Segoe UI", sans-serif`;
    let context = canvas.getContext('2d')!;
    context.font = font;
    const wide = Math.ceil(context.measureText(shown).width / ratio) + 14;
    canvas.width = wide * ratio;
    canvas.height = HEIGHT * ratio;
    context = canvas.getContext('2d')!;
    context.font = font;
    context.textBaseline = 'middle';
    context.beginPath();
    context.roundRect(0.5 * ratio, 1.5 * ratio, (wide - 1) * ratio, (HEIGHT - 3) * ratio, 5 * ratio);
    context.fillStyle = dark ? 'rgba(24, 29, 35, 0.82)' : 'rgba(255, 255, 255, 0.86)';
    context.fill();
    context.lineWidth = ratio;
    context.strokeStyle = dark ? 'rgba(160, 175, 190, 0.25)' : 'rgba(60, 75, 90, 0.2)';
    context.stroke();
    context.fillStyle = dark ? '#e4e9ee' : '#1d2730';
    context.fillText(shown, 7 * ratio, (HEIGHT / 2 + 0.5) * ratio);
    const texture = new CanvasTexture(canvas);
    texture.colorSpace = SRGBColorSpace;
    texture.minFilter = LinearFilter;
    texture.generateMipmaps = false;
    this.sprite = new Sprite(new SpriteMaterial({ map: texture, depthTest: false, depthWrite: false, sizeAttenuation: false, transparent: true, toneMapped: false }));
    this.sprite.center = new Vector2(-BESIDE, -ABOVE);
    this.sprite.renderOrder = 10;
    this.width = wide;
  }

  /** `pixel`: part of the picture's height that one pixel is, at distance one. */
  resize(pixel: number): void {
    this.sprite.scale.set(this.width * pixel, HEIGHT * pixel, 1);
  }

  /** Takes the free place nearest to its point, or none; `taken` grows by it. */
  settle(x: number, y: number, taken: Box[]): void {
    const place = placeBeside(this.width, x, y, taken);
    this.sprite.visible = place !== null;
    if (!place) return;
    taken.push(place.box);
    this.sprite.center.set(place.side === 'right' ? -BESIDE : 1 + BESIDE, -ABOVE - place.row);
  }

  dispose(): void {
    this.sprite.material.map?.dispose();
    this.sprite.material.dispose();
    this.sprite.removeFromParent();
  }
}
