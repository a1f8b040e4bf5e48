// Bundles TypeScript tests for node, and finds what page tests need.

import { spawnSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { readdir, rm } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

export const root = join(dirname(fileURLToPath(import.meta.url)), '..');
// Inside node_modules, so that packages are found from there.
const out = join(root, 'node_modules', '.tests');

export async function bundle(entries) {
  await rm(out, { recursive: true, force: true });
  await build({
    entryPoints: entries.map((entry) => join(root, entry)),
    outdir: out,
    outExtension: { '.js': '.mjs' },
    bundle: true,
    platform: 'node',
    format: 'esm',
    target: 'node18',
    packages: 'external',
    sourcemap: 'inline',
    logLevel: 'warning',
  });
  return entries.map((entry) => join(out, entry.split('/').pop().replace(/\.ts$/, '.mjs')));
}

export async function runTests(folder, extra = []) {
  const names = (await readdir(join(root, folder))).filter((name) => name.endsWith('.test.ts'));
  const files = await bundle(names.map((name) => `${folder}/${name}`));
  const result = spawnSync(process.execPath, ['--enable-source-maps', '--test', ...extra, ...files], { stdio: 'inherit' });
  process.exit(result.status ?? 1);
}

/** A Chromium or Chrome of the system, or null. */
export function findBrowser() {
  const names = ['chromium', 'chromium-browser', 'google-chrome', 'google-chrome-stable'];
  for (const name of names) {
    for (const folder of (process.env.PATH ?? '').split(':')) if (folder && existsSync(join(folder, name))) return join(folder, name);
  }
  return null;
}
