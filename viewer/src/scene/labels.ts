// Names in the view: small textures of text that keep their size on the screen.

import { CanvasTexture, LinearFilter, Sprite, SpriteMaterial, SRGBColorSpace, Vector2 } from 'three';

const HEIGHT = 22;
/** Where it stands from its point, in parts of its size; how many rows it may move up by. */
const BESIDE = 0.06;
const ABOVE = 0.35;
const ROWS = 4;

export interface Box {
  left: number;
  right: number;
  top: number;
  bottom: number;
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

  /** In pixels from the left and the top, `row` rows above its own place, if its point is at (x, y). */
  private box(x: number, y: number, row: number): Box {
    const left = x + BESIDE * this.width;
    const bottom = y - (ABOVE + row) * HEIGHT;
    return { left, right: left + this.width, top: bottom - HEIGHT, bottom };
  }

  /** Takes the lowest free row at its point, or none; `taken` grows by its place. */
  settle(x: number, y: number, taken: Box[]): void {
    for (let row = 0; row < ROWS; ++row) {
      const box = this.box(x, y, row);
      if (taken.some((other) => box.left < other.right && other.left < box.right && box.top < other.bottom && other.top < box.bottom)) continue;
      taken.push(box);
      this.sprite.center.set(-BESIDE, -ABOVE - row);
      this.sprite.visible = true;
      return;
    }
    this.sprite.visible = false;
  }

  dispose(): void {
    this.sprite.material.map?.dispose();
    this.sprite.material.dispose();
    this.sprite.removeFromParent();
  }
}
