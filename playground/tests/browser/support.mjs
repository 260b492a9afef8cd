// Shared code of the browser tests: the built page, served from this machine, in a headless Chromium of the system.

import { existsSync, readdirSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, normalize } from "node:path";
import { after, before } from "node:test";
import { fileURLToPath } from "node:url";
import { brotliCompressSync, gzipSync } from "node:zlib";
import { chromium } from "playwright-core";

export const DIST = fileURLToPath(new URL("../../dist/", import.meta.url));
const TYPES = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".css": "text/css",
  ".wasm": "application/wasm",
  ".svg": "image/svg+xml",
  ".png": "image/png",
  ".json": "application/json",
};

/** Ways to send a file. */
const CODINGS = { br: brotliCompressSync, gzip: (content) => gzipSync(content, { level: 9 }) };

/** Serves a folder on a free port of the loopback interface; `close` ends it. `coding` compresses all files. */
async function serve({ folder = DIST, coding = null } = {}) {
  if (!existsSync(join(folder, "index.html")))
    throw new Error(`${folder} holds no page: run "make page" first`);
  // Compressed before anything is asked for, so that no visit waits for it.
  const sent = new Map();
  for (const entry of coding ? readdirSync(folder, { recursive: true, withFileTypes: true }) : []) {
    const file = join(entry.parentPath ?? entry.path, entry.name);
    if (entry.isFile()) sent.set(file, CODINGS[coding](readFileSync(file)));
  }
  const contentOf = (file) => sent.get(file) ?? readFileSync(file);
  const server = createServer((request, answer) => {
    const path = normalize(decodeURIComponent(new URL(request.url, "http://localhost").pathname));
    const file = join(folder, path.endsWith("/") ? `${path}index.html` : path);
    if (!file.startsWith(folder) || !existsSync(file)) {
      answer.writeHead(404).end();
      return;
    }
    answer
      .writeHead(200, {
        "content-type": TYPES[extname(file)] ?? "application/octet-stream",
        ...(coding && { "content-encoding": coding }),
      })
      .end(contentOf(file));
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const close = () => {
    server.closeAllConnections();
    return new Promise((resolve) => server.close(resolve));
  };
  return { url: `http://127.0.0.1:${server.address().port}/`, close };
}

/** A browser that draws without a graphics card: the page is painted by the processor, which takes a third less time. */
function launch() {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: [
      "--no-sandbox",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--disable-gpu-compositing",
    ],
  });
}

/** The page and the browser of the tests of a file, or of a script. */
export let site;
export let browser;

export async function start(options = {}) {
  [browser, site] = [await launch(), await serve(options)];
}

export async function stop() {
  await browser?.close();
  await site?.close();
}

/** Starts both before the tests of the file that calls this, and ends them after. */
export function useBrowser() {
  before(() => start());
  after(stop);
}

/** Clicks a tab. */
export const tab = (page, name) => page.getByRole("tab", { name }).click();

/** Opens a page, in which `script` runs first, and collects the errors that it reports. */
export async function visit(url, { script, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1400, height: 850 }, ...options });
  if (script) await context.addInitScript(script);
  const page = await context.newPage();
  const errors = [];
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  await page.goto(url);
  return { page, context, errors };
}

/** Opens the page with a project that an earlier visit has left. */
export async function revisit(url, { name, files, scenario }, options = {}) {
  const visited = await visit(url, options);
  await visited.page.evaluate(
    ({ name, files, scenario }) => {
      const active = Object.keys(files)[0];
      const project = { id: "test", name, files, active, scenario, example: null, touched: true, changed: 1 };
      localStorage.setItem("starl.project.test", JSON.stringify(project));
      localStorage.setItem("starl.projects", JSON.stringify([{ id: "test", name, changed: 1 }]));
      localStorage.setItem("starl.current", "test");
    },
    { name, files, scenario },
  );
  await visited.page.reload();
  return visited;
}
