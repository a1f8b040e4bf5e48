// Fingers on a plot: two stretch its axis of time, one shifts it while it is zoomed; up and down scroll the page.

import type uPlot from 'uplot';

/** Places of two fingers, and the times that they hold. */
export function stretched(times: [number, number], places: [number, number], width: number): [number, number] | null {
  const apart = places[1] - places[0];
  // Fingers that meet, or pass each other, hold nothing.
  if (!((times[1] - times[0]) * apart > 0) || Math.abs(apart) < 8) return null;
  const perPixel = (times[1] - times[0]) / apart;
  const min = times[0] - places[0] * perPixel;
  return [min, min + width * perPixel];
}

export function listenToTouches(u: uPlot, zoomed: () => boolean, show: (min: number, max: number) => void): void {
  const { over } = u;
  over.style.touchAction = 'pan-y';
  /** Place and time of each finger, in the order in which they came. */
  const fingers = new Map<number, { place: number; time: number }>();
  const place = (event: PointerEvent): number => event.clientX - over.getBoundingClientRect().left;
  const hold = (): void => {
    for (const finger of fingers.values()) finger.time = u.posToVal(finger.place, 'x');
  };
  over.addEventListener('pointerdown', (event) => {
    if (event.pointerType !== 'touch' || fingers.size >= 2) return;
    fingers.set(event.pointerId, { place: place(event), time: 0 });
    hold();
  });
  over.addEventListener('pointermove', (event) => {
    const finger = fingers.get(event.pointerId);
    if (!finger) return;
    finger.place = place(event);
    const [first, second] = [...fingers.values()];
    if (second) {
      const range = stretched([first.time, second.time], [first.place, second.place], over.clientWidth);
      if (range) show(...range);
    } else if (zoomed()) {
      const { min, max } = u.scales.x;
      const shift = first.time - u.posToVal(first.place, 'x');
      const [low, high] = [u.data[0][0], u.data[0][u.data[0].length - 1]];
      const kept = Math.min(high - max!, Math.max(low - min!, shift));
      if (kept !== 0) show(min! + kept, max! + kept);
    }
  });
  for (const end of ['pointerup', 'pointercancel'] as const) {
    over.addEventListener(end, (event) => {
      fingers.delete(event.pointerId);
      hold();
    });
  }
}
