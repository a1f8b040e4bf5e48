import { runTests } from './tools.mjs';

await runTests('test/unit');
