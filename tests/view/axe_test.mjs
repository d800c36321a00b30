// node axe_test.mjs CHROMIUM PAGE.html
// The page of glcast view as axe-core judges it: in every state that the page can be in, no finding. Ends with 1 on any.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';
import { Chromium, softwareGl } from './chromium.mjs';

const [program, page] = process.argv.slice(2);
const axe = await readFile(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
let found = 0;

async function judge(tab, state) {
  const { violations, passes } = await tab.evaluate('axe.run(document, { resultTypes: ["violations"] })'
    + '.then(({ violations, passes }) => ({ passes: passes.length, violations: violations.map(({ id, help, nodes }) =>'
    + ' ({ id, help, nodes: nodes.map(({ html, failureSummary }) => `${html}: ${failureSummary}`) })) }))');
  console.log(`${state}: ${passes} rules hold`);
  if (passes < 20) throw new Error(`axe has looked at ${passes} rules only`);
  for (const { id, help, nodes } of violations) {
    ++found;
    console.log(`  ${id}: ${help}`);
    for (const node of nodes) console.log(`    ${node.replaceAll('\n', ' ')}`);
  }
}

const states = {
  'as it opens': async () => {},
  'the error and its scale': (tab) => tab.click('#show-error'),
  'another level': async (tab) => {
    await tab.click('#level', 0.98);
    await tab.until('document.getElementById("canvas").dataset.level !== "1"');
  },
  'a captured view chosen': (tab) => tab.click('#view-2'),
  'the keys shown': (tab) => tab.click('#help summary'),
  'on a phone': (tab) => tab.resize(390, 800),
};

async function browse(flags, work) {
  const browser = await Chromium.start(program, flags);
  try {
    const tab = await browser.open(pathToFileURL(page).href, 900, 560);
    await tab.evaluate(axe);
    await work(tab);
  } finally {
    await browser.close();
  }
}

await browse(softwareGl, async (tab) => {
  await tab.until('document.getElementById("canvas").dataset.drawn');
  for (const [state, enter] of Object.entries(states)) {
    await enter(tab);
    await judge(tab, state);
  }
});
await browse(['--disable-3d-apis'], async (tab) => {
  await tab.until('document.getElementById("message").innerText.includes("WebGL 2 is missing")');
  await judge(tab, 'without WebGL');
});
if (found > 0) process.exit(1);
console.log('all is well');
