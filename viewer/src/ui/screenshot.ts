// A picture of the view with its ground, its title and its legend, as a PNG file.

import { lookOf, mapStops, OVER_COLOUR } from '../scene/palette';
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
    const top = height - (legend.scopeText ? 60 : 44);
    const bar = context.createLinearGradient(left, 0, left + size, 0);
    for (const [at, colour] of mapStops(legend.map)) bar.addColorStop(at, colour);
    context.font = '12px system-ui, sans-serif';
    context.textAlign = 'right';
    if (legend.scopeText) context.fillText(legend.scopeText, left + size, top + 41);
    context.textAlign = 'left';
    context.fillText(legend.text, left, top - 7);
    context.fillStyle = bar;
    context.fillRect(left, top, size, 10);
    context.fillStyle = cssColour('--text');
    for (const { part, text } of legend.ticksShown) {
      context.textAlign = part === 0 ? 'left' : part === 1 ? 'right' : 'center';
      context.fillText(text, left + part * size, top + 25);
    }
    if (lookOf(legend.map).over) {
      context.fillStyle = OVER_COLOUR;
      context.fillRect(left + size + 3, top, 14, 10);
    }
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
