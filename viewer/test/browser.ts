// Pages written to a folder and opened from there, with no network.

import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { chromium, type Browser, type Page } from 'playwright-core';

export const template = (): string => readFileSync(join(process.cwd(), 'dist', 'template.html'), 'utf8');

/** Kept when FLOATFRAME_PICTURES names a folder: pages and pictures to look at. */
export const folder = process.env.FLOATFRAME_PICTURES ?? join(process.cwd(), 'node_modules', '.pages');
mkdirSync(folder, { recursive: true });

export async function launch(more: string[] = [], webgl = true): Promise<Browser> {
  const executablePath = process.env.FLOATFRAME_BROWSER;
  if (!executablePath) throw new Error('FLOATFRAME_BROWSER names no browser');
  const gl = webgl ? ['--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'] : ['--disable-gpu', '--disable-3d-apis', '--disable-webgl', '--disable-webgl2'];
  return chromium.launch({ executablePath, headless: true, args: ['--no-sandbox', '--disable-background-networking', ...gl, ...more] });
}

export interface Opened {
  page: Page;
  errors: string[];
  requests: string[];
  /** Milliseconds from navigation until the page is ready. */
  readyAfter: number;
}

export function write(name: string, html: string): string {
  const path = join(folder, `${name}.html`);
  writeFileSync(path, html);
  return path;
}

export async function open(browser: Browser, path: string, options: { width?: number; height?: number; dark?: boolean; still?: boolean } = {}): Promise<Opened> {
  const context = await browser.newContext({ viewport: { width: options.width ?? 1440, height: options.height ?? 900 }, colorScheme: options.dark ? 'dark' : 'light', reducedMotion: options.still ? 'reduce' : 'no-preference', acceptDownloads: true });
  const page = await context.newPage();
  page.setDefaultTimeout(60_000);
  const errors: string[] = [];
  const requests: string[] = [];
  page.on('console', (message) => {
    if (message.type() === 'error' || message.type() === 'warning') errors.push(`${message.type()}: ${message.text()}`);
  });
  page.on('pageerror', (error) => errors.push(`page error: ${error.message}`));
  page.on('request', (request) => {
    if (!/^(file|data|blob):/.test(request.url())) requests.push(request.url());
  });
  const url = pathToFileURL(path).href;
  const begin = Date.now();
  await page.goto(url);
  await page.waitForFunction(() => window.floatframe?.ready === true);
  return { page, errors, requests, readyAfter: Date.now() - begin };
}

export async function snap(page: Page, name: string, whole = false): Promise<Buffer> {
  return page.screenshot({ path: join(folder, `${name}.png`), fullPage: whole });
}
