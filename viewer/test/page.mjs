import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { findBrowser, root, runTests } from './tools.mjs';

process.env.FLOATFRAME_BROWSER ??= findBrowser() ?? '';
if (process.env.FLOATFRAME_BROWSER === '') {
  console.error('The pages need a browser to be tested in: chromium is not installed (scripts/install_packages.sh --viewer).');
  process.exit(1);
}
if (!existsSync(join(root, 'dist', 'template.html'))) {
  console.error('dist/template.html is missing: npm run build');
  process.exit(1);
}
process.chdir(root);
// One browser at a time; script times are measured in it.
await runTests('test/page', ['--test-concurrency=1', ...process.argv.slice(2)]);
