// Drives Chromium through a pipe, by the DevTools protocol, with nothing but node's own modules.

import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

export class Browser {
  constructor(program) {
    this.profile = mkdtempSync(join(tmpdir(), "report_page_"));
    this.process = spawn(program, [
      "--headless", "--no-sandbox", "--disable-gpu-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
      "--no-first-run", "--disable-extensions", "--disable-background-networking", "--disable-component-update",
      "--disable-dev-shm-usage", "--hide-scrollbars", "--user-data-dir=" + this.profile, "--remote-debugging-pipe", "about:blank",
    ], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    this.answers = new Map();
    this.listeners = [];
    this.number = 0;
    let rest = Buffer.alloc(0);
    this.process.stdio[4].on("data", (data) => {
      rest = Buffer.concat([rest, data]);
      for (let end; (end = rest.indexOf(0)) >= 0; rest = rest.subarray(end + 1)) this.receive(JSON.parse(rest.subarray(0, end).toString()));
    });
    this.process.stdio[3].on("error", () => {});
    this.process.on("exit", () => {
      for (const { reject } of this.answers.values()) reject(new Error("the browser has ended"));
    });
  }

  receive(message) {
    if (message.id === undefined) {
      for (const listener of this.listeners) listener(message);
      return;
    }
    const { resolve, reject, method } = this.answers.get(message.id);
    this.answers.delete(message.id);
    if (message.error) reject(new Error(method + ": " + message.error.message));
    else resolve(message.result);
  }

  send(method, params = {}, sessionId = undefined) {
    return new Promise((resolve, reject) => {
      const id = ++this.number;
      this.answers.set(id, { resolve, reject, method });
      this.process.stdio[3].write(JSON.stringify({ id, method, params, sessionId }) + "\0");
    });
  }

  async close() {
    const ended = new Promise((resolve) => this.process.once("exit", resolve));
    this.send("Browser.close").catch(() => {});
    await ended;
    rmSync(this.profile, { recursive: true, force: true, maxRetries: 5 });
  }
}

// A page of a file. `complaints`: what its console, its exceptions and the browser's log say; `requests`: what it asked for.
export class Page {
  static async open(browser, file, { width, height, dark = false }) {
    const page = new Page();
    page.browser = browser;
    page.complaints = [];
    page.requests = [];
    const { targetId } = await browser.send("Target.createTarget", { url: "about:blank" });
    page.target = targetId;
    page.session = (await browser.send("Target.attachToTarget", { targetId, flatten: true })).sessionId;
    browser.listeners.push((message) => {
      if (message.sessionId !== page.session) return;
      const { method, params } = message;
      if (method === "Runtime.consoleAPICalled" && ["error", "warning", "assert"].includes(params.type))
        page.complaints.push(params.type + ": " + params.args.map((a) => a.value ?? a.description).join(" "));
      if (method === "Runtime.exceptionThrown") page.complaints.push("exception: " + (params.exceptionDetails.exception?.description ?? params.exceptionDetails.text));
      if (method === "Log.entryAdded" && params.entry.level === "error") page.complaints.push("log: " + params.entry.text);
      if (method === "Network.requestWillBeSent" && !params.request.url.startsWith("data:")) page.requests.push(params.request.url);
    });
    for (const domain of ["Runtime", "Log", "Network", "Page"]) await page.send(domain + ".enable");
    await page.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
    await page.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }] });
    page.url = pathToFileURL(file).href;
    await page.send("Page.navigate", { url: page.url });
    await page.until("document.readyState === 'complete'");
    return page;
  }

  send(method, params = {}) {
    return this.browser.send(method, params, this.session);
  }

  async value(expression) {
    const answer = await this.send("Runtime.evaluate", { expression, returnByValue: true, awaitPromise: true });
    if (answer.exceptionDetails) throw new Error(expression + ": " + (answer.exceptionDetails.exception?.description ?? answer.exceptionDetails.text));
    return answer.result.value;
  }

  async until(expression, seconds = 60) {
    for (const end = Date.now() + 1000 * seconds; Date.now() < end; await new Promise((resolve) => setTimeout(resolve, 50)))
      if (await this.value(expression)) return;
    throw new Error("it never came to be that " + expression);
  }

  // Until all that was asked for is drawn.
  async drawn() {
    await this.value("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))");
    await this.until("!report_state.has_view || report_state.complete");
  }

  mouse(type, x, y, more = {}) {
    return this.send("Input.dispatchMouseEvent", { type, x, y, button: "left", buttons: type === "mouseReleased" ? 0 : 1, clickCount: 1, ...more });
  }

  async click(x, y) {
    await this.mouse("mousePressed", x, y);
    await this.mouse("mouseReleased", x, y);
    await this.drawn();
  }

  async drag(x, y, dx, dy, more = {}) {
    await this.mouse("mousePressed", x, y, more);
    for (let k = 1; k <= 4; ++k) await this.mouse("mouseMoved", x + (dx * k) / 4, y + (dy * k) / 4, more);
    await this.mouse("mouseReleased", x + dx, y + dy, more);
    await this.drawn();
  }

  async screenshot() {
    const { cssContentSize } = await this.send("Page.getLayoutMetrics");
    const clip = { x: 0, y: 0, width: cssContentSize.width, height: cssContentSize.height, scale: 1 };
    return Buffer.from((await this.send("Page.captureScreenshot", { format: "png", captureBeyondViewport: true, clip })).data, "base64");
  }

  close() {
    return this.browser.send("Target.closeTarget", { targetId: this.target });
  }
}
