// A picture of the view with its ground, its title and its legend, as a PNG file.

import { mapStops } from '../scene/palette';
import type { Legend } from './legend';
import { cssColour } from './theme';

export function takePicture(view: HTMLCanvasElement, legend: Legend, caption: string): HTMLCanvasElement {
  const picture = document.createElement('canvas');
  picture.width = view.width;
  picture.height = view.height;
  const context = picture.getContext('2d')!;
  const ratio = view.width / Math.max(1, view.clientWidth);
  const ground = context.createLinearGradient(0, 0, 0, picture.height);
  ground.addColorStop(0, cssColour('--sky-top'));
  ground.addColorStop(1, cssColour('--sky-bottom'));
  context.fillStyle = ground;
  context.fillRect(0, 0, picture.width, picture.height);
  context.drawImage(view, 0, 0);
  context.scale(ratio, ratio);
  const width = picture.width / ratio;
  const height = picture.height / ratio;
  context.fillStyle = cssColour('--text');
  context.font = '600 14px system-ui, sans-serif';
  context.textBaseline = 'alphabetic';
  context.fillText(caption, 16, 26);
  if (!legend.element.hidden) {
    const size = 200;
    const left = width - size - 20;
    const top = height - 44;
    const bar = context.createLinearGradient(left, 0, left + size, 0);
    const stops = mapStops(legend.map);
    stops.forEach((colour, k) => bar.addColorStop(k / (stops.length - 1), colour));
    context.font = '12px system-ui, sans-serif';
    context.fillText(legend.text, left, top - 7);
    context.fillStyle = bar;
    context.fillRect(left, top, size, 10);
    context.fillStyle = cssColour('--text');
    legend.values.forEach((value, k) => {
      context.textAlign = (['left', 'center', 'right'] as const)[k];
      context.fillText(value, left + (k * size) / 2, top + 25);
    });
  }
  return picture;
}

export async function saveScreenshot(picture: HTMLCanvasElement, name: string): Promise<void> {
  const blob = await new Promise<Blob | null>((resolve) => picture.toBlob(resolve, 'image/png'));
  if (!blob) return;
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name.replace(/[^\w.-]+/g, '-');
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
