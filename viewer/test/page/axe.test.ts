// Pages of all kinds, light and dark, judged by axe-core.

import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import type { Browser, Page } from 'playwright-core';
import { check, compare, reduce, sweep } from '../pages/others';
import { vehicle } from '../pages/vehicle';
import { modes } from '../pages/vibrations';
import { fillTemplate } from '../pages/writer';
import { launch, open, template, write } from '../browser';

const axe = createRequire(join(process.cwd(), 'package.json')).resolve('axe-core/axe.min.js');
let browser: Browser;

before(async () => (browser = await launch()));
after(async () => browser?.close());

interface Finding {
  id: string;
  nodes: { html: string; failureSummary?: string }[];
}

async function findings(page: Page): Promise<string[]> {
  const found = await page.evaluate(async () => {
    const { axe } = window as unknown as { axe: { run: () => Promise<{ violations: Finding[]; passes: unknown[] }> } };
    const result = await axe.run();
    if (result.passes.length < 10) throw new Error(`only ${result.passes.length} rules were applied`);
    return result.violations;
  });
  return found.map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map((node) => `${node.html.slice(0, 160)} ${node.failureSummary ?? ''}`).join(' | ')}`);
}

const kinds = { vehicle: () => vehicle({ uniform: [300, -120, 50, 200, -90, 60] }), check, reduce, compare, modes, sweep };

for (const [kind, make] of Object.entries(kinds)) {
  test(`axe-core: ${kind}`, async () => {
    const made = make();
    const path = write(`axe_${kind}`, fillTemplate(template(), made.page, made.writer));
    for (const dark of [false, true]) {
      // Still: colours on their way from one to another are none.
      const { page } = await open(browser, path, { dark, still: true });
      await page.addScriptTag({ path: axe });
      assert.deepEqual(await findings(page), [], `${kind}, ${dark ? 'dark' : 'light'}`);
      for (const tab of await page.getByRole('tab').all()) {
        await tab.click();
        assert.deepEqual(await findings(page), [], `${kind}, ${dark ? 'dark' : 'light'}, ${await tab.textContent()}`);
      }
      await page.context().close();
    }
  });
}
