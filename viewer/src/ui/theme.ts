// Light and dark: the system's choice until the reader makes one.

type Listener = (dark: boolean) => void;

const listeners: Listener[] = [];
const system = window.matchMedia('(prefers-color-scheme: dark)');

export function isDark(): boolean {
  const chosen = document.documentElement.dataset.theme;
  return chosen === 'dark' || (chosen !== 'light' && system.matches);
}

export function onTheme(listener: Listener): void {
  listeners.push(listener);
}

function tell(): void {
  for (const listener of listeners) listener(isDark());
}

let kept: string | undefined;

/** For a while light, whatever the reader has chosen; then as it was. */
export function lendLight(on: boolean): void {
  const { dataset } = document.documentElement;
  if (on) {
    kept = dataset.theme;
    dataset.theme = 'light';
  } else if (kept === undefined) delete dataset.theme;
  else dataset.theme = kept;
  tell();
}

export function toggleTheme(): void {
  const theme = isDark() ? 'light' : 'dark';
  document.documentElement.dataset.theme = theme;
  try {
    localStorage.setItem('floatframe-theme', theme);
  } catch {
    // Not kept where storage is closed.
  }
  tell();
}

system.addEventListener('change', tell);

export function cssColour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}
