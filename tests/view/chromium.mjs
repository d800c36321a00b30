// Chromium without a window, spoken to over a pipe by its DevTools protocol: no package, no port.
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { decode } from './png.mjs';

const common = ['--headless', '--no-sandbox', '--remote-debugging-pipe', '--no-first-run', '--disable-extensions',
  '--disable-background-networking', '--disable-component-update', '--hide-scrollbars', '--disable-dev-shm-usage'];
export const softwareGl = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];

export class Chromium {
  #answers = new Map();
  #last = 0;
  #rest = '';
  #heard = [];

  static async start(program, flags) {
    const browser = new Chromium();
    browser.folder = await mkdtemp(join(tmpdir(), 'glcast-chromium-'));
    browser.process = spawn(program, [...common, ...flags, `--user-data-dir=${browser.folder}`, 'about:blank'],
      { stdio: ['ignore', 'ignore', 'pipe', 'pipe', 'pipe'], env: { ...process.env, HOME: browser.folder } });
    let errors = '';
    browser.process.stderr.on('data', (text) => { errors = (errors + text).slice(-2000); });
    browser.process.on('error', (error) => browser.#fail(`cannot start ${program}: ${error.message}`));
    browser.process.on('exit', (code) => browser.#fail(`${program} ended with ${code}: ${errors}`));
    browser.process.stdio[3].on('error', () => {}); // told by exit
    browser.process.stdio[4].setEncoding('utf8').on('data', (text) => browser.#hear(text));
    return browser;
  }

  #fail(why) {
    for (const { reject } of this.#answers.values()) reject(new Error(why));
    this.#answers.clear();
  }

  #hear(text) {
    const messages = (this.#rest + text).split('\0');
    this.#rest = messages.pop();
    for (const message of messages.map((m) => JSON.parse(m))) {
      const answer = this.#answers.get(message.id);
      if (!answer) {
        for (const heard of this.#heard) heard(message);
        continue;
      }
      this.#answers.delete(message.id);
      if (message.error) answer.reject(new Error(`${answer.method}: ${message.error.message}`));
      else answer.resolve(message.result);
    }
  }

  listen(heard) { this.#heard.push(heard); }

  send(method, params = {}, sessionId = undefined) {
    const id = ++this.#last;
    return new Promise((resolve, reject) => {
      this.#answers.set(id, { resolve, reject, method });
      this.process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
    });
  }

  async open(url, width, height) {
    const { targetId } = await this.send('Target.createTarget', { url: 'about:blank' });
    const { sessionId } = await this.send('Target.attachToTarget', { targetId, flatten: true });
    const tab = new Tab(this, sessionId);
    await tab.go(url, width, height);
    return tab;
  }

  async close() {
    const ended = this.process.exitCode === null ? once(this.process, 'exit') : null;
    this.send('Browser.close').catch(() => {});
    const hurry = setTimeout(() => this.process.kill('SIGKILL'), 5000);
    await ended;
    clearTimeout(hurry);
    await rm(this.folder, { recursive: true, force: true, maxRetries: 5 });
  }
}

export class Tab {
  requests = [];
  troubles = [];

  constructor(browser, session) {
    this.send = (method, params) => browser.send(method, params, session);
    this.browser = browser;
    browser.listen(({ method, params, sessionId }) => {
      if (sessionId !== session) return;
      if (method === 'Network.requestWillBeSent') this.requests.push(params.request.url);
      if (method === 'Runtime.exceptionThrown') this.troubles.push(params.exceptionDetails.exception?.description);
    });
  }

  async go(url, width, height) {
    for (const domain of ['Network', 'Runtime', 'Page']) await this.send(`${domain}.enable`);
    await this.resize(width, height);
    await this.send('Page.navigate', { url });
    await this.until('location.href !== "about:blank" && document.readyState === "complete"');
  }

  resize(width, height) {
    return this.send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: false });
  }

  async evaluate(expression) {
    const { result, exceptionDetails } = await this.send('Runtime.evaluate',
      { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception?.description ?? exceptionDetails.text}`);
    return result.value;
  }

  /** Waits for a condition, as long as 15 s. */
  async until(condition) {
    const ok = await this.evaluate(`new Promise((done) => {
      const end = performance.now() + 15000;
      const holds = () => { try { return ${condition}; } catch { return false; } };
      (function look() {
        if (holds()) done(true); else if (performance.now() > end) done(false); else setTimeout(look, 10);
      })();
    })`);
    if (!ok) throw new Error(`never came true: ${condition}`);
  }

  /** What is seen, once everything asked for is drawn. */
  async picture() {
    await this.evaluate('new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))');
    const { data } = await this.send('Page.captureScreenshot', { format: 'png' });
    return decode(Buffer.from(data, 'base64'));
  }

  rectangle(selector) {
    return this.evaluate(`(() => { const e = document.querySelector(${JSON.stringify(selector)});
      e.scrollIntoView({ block: 'nearest' });
      const { x, y, width, height } = e.getBoundingClientRect(); return { x, y, width, height }; })()`);
  }

  async mouse(type, x, y, extra = {}) {
    await this.send('Input.dispatchMouseEvent', { type, x, y, button: 'left', buttons: 1, clickCount: 1, ...extra });
  }

  async click(selector, across = 0.5) {
    const { x, y, width, height } = await this.rectangle(selector);
    for (const type of ['mousePressed', 'mouseReleased']) await this.mouse(type, x + width * across, y + height / 2);
  }

  /** What `act` makes the page save, in a folder. @returns {Promise<string>} the file's name */
  async download(folder, act) {
    await this.browser.send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: folder, eventsEnabled: true });
    let name;
    const saved = new Promise((done, failed) => {
      this.browser.listen(({ method, params }) => {
        if (method === 'Browser.downloadWillBegin') name = params.suggestedFilename;
        if (method === 'Browser.downloadProgress' && params.state === 'completed') done(name);
        if (method === 'Browser.downloadProgress' && params.state === 'canceled') failed(new Error(`${name}: not saved`));
      });
    });
    await act();
    return saved;
  }

  async drag(fromX, fromY, toX, toY) {
    await this.mouse('mousePressed', fromX, fromY);
    await this.mouse('mouseMoved', toX, toY);
    await this.mouse('mouseReleased', toX, toY);
  }

  async touchDrag(fromX, fromY, toX, toY) {
    const touch = (type, ...points) => this.send('Input.dispatchTouchEvent',
      { type, touchPoints: points.map(([x, y]) => ({ x, y })) });
    await touch('touchStart', [fromX, fromY]);
    await touch('touchMove', [toX, toY]);
    await touch('touchEnd');
  }

  async key(key, code = key, modifiers = 0) {
    for (const type of ['keyDown', 'keyUp'])
      await this.send('Input.dispatchKeyEvent', { type, key, code, modifiers, ...(key.length === 1 && type === 'keyDown' ? { text: key } : {}) });
  }
}
