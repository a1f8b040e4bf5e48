// Names in the view: small textures of text that keep their size on the screen.

import { CanvasTexture, LinearFilter, Sprite, SpriteMaterial, SRGBColorSpace, Vector2 } from 'three';

const HEIGHT = 22;

export class Label {
  readonly sprite: Sprite;
  private readonly width: number;

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
    this.sprite.center = new Vector2(-0.06, -0.35);
    this.sprite.renderOrder = 10;
    this.width = wide;
  }

  /** `pixel`: part of the picture's height that one pixel is, at distance one. */
  resize(pixel: number): void {
    this.sprite.scale.set(this.width * pixel, HEIGHT * pixel, 1);
  }

  dispose(): void {
    this.sprite.material.map?.dispose();
    this.sprite.material.dispose();
    this.sprite.removeFromParent();
  }
}
