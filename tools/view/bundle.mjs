// node bundle.mjs NODE_MODULES OUT.html
// The page less its data, in one file: page/index.html with style.css and main.js, which brings three.js with it.
import { readFile, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [modules, out] = process.argv.slice(2);
if (!out) {
  console.error('usage: node bundle.mjs NODE_MODULES OUT.html');
  process.exit(2);
}
const nodeModules = resolve(modules);
const page = join(dirname(fileURLToPath(import.meta.url)), 'page');
const esbuild = createRequire(join(nodeModules, 'none.js'))('esbuild');

async function bundle(entry) {
  const result = await esbuild.build({
    entryPoints: [join(page, entry)], bundle: true, minify: true, write: false, format: 'iife', target: 'es2022',
    nodePaths: [nodeModules], legalComments: 'inline', logLevel: 'warning', charset: 'utf8',
  });
  return result.outputFiles[0].text;
}

function put(html, mark, text) {
  const parts = html.split(mark);
  if (parts.length !== 2) throw new Error(`index.html must hold ${mark} once`);
  return parts.join(text);
}

const [script, style, html] = await Promise.all([
  bundle('main.js'), bundle('style.css'), readFile(join(page, 'index.html'), 'utf8')]);
if (/<\/script/i.test(script)) throw new Error('the script would end its own element');
await writeFile(out, put(put(html, '<!--style-->', `<style>\n${style}</style>`), '<!--script-->', `<script>\n${script}</script>`));
