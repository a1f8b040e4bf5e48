// While the page is printed it is light, as wide as a sheet, and its plots are drawn for that width.

import { lendLight } from './theme';

/** Pixels, as the style sheet has it. */
const SHEET = 718;
let onPaper = false;

/** The picture of the view keeps its shape, so that it shows what it shows on the screen. */
function keepShape(): void {
  const frame = document.querySelector('.frame');
  if (!frame || frame.clientWidth === 0) return;
  const height = Math.min(620, (SHEET * frame.clientHeight) / frame.clientWidth);
  document.documentElement.style.setProperty('--paper-view', `${height.toFixed(0)}px`);
}

function change(to: boolean): void {
  if (to === onPaper) return;
  onPaper = to;
  if (to) keepShape();
  document.documentElement.classList.toggle('paper', to);
  lendLight(to);
}

/** Before anything else that listens to printing. */
export function listenToPrinting(): void {
  window.addEventListener('beforeprint', () => change(true));
  window.addEventListener('afterprint', () => change(false));
  const print = window.matchMedia('print');
  print.addEventListener('change', () => change(print.matches));
}
