import { spawnSync } from 'node:child_process';
import { bundle, findBrowser } from './tools.mjs';

const [file] = await bundle(['test/loop.ts']);
const env = { ...process.env, FLOATFRAME_BROWSER: process.env.FLOATFRAME_BROWSER ?? findBrowser() ?? '' };
process.exit(spawnSync(process.execPath, [file, ...process.argv.slice(2)], { stdio: 'inherit', env }).status ?? 1);
