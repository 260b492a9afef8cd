// The extension starts the command that the settings name, and says so where there is none. The editor and
// its client are played.
import assert from "node:assert/strict";
import { chmodSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import Module from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, beforeEach, test } from "node:test";

const folder = mkdtempSync(join(tmpdir(), "starl-extension-"));
after(() => rmSync(folder, { recursive: true }));

const shown = [];
const clients = [];
const listeners = { configuration: [] };
let path = "starl";
let startError;

class LanguageClient {
  constructor(id, name, server, options) {
    Object.assign(this, { id, name, server, options, running: false });
    clients.push(this);
  }
  async start() {
    if (startError) throw startError;
    this.running = true;
  }
  async stop() {
    this.running = false;
  }
  isRunning() {
    return this.running;
  }
  async sendRequest(method, params) {
    return `${method} ${params.uri}`;
  }
}

const commands = new Map();
const providers = new Map();
const vscode = {
  commands: {
    registerCommand: (name, run) => commands.set(name, run),
    executeCommand: (...command) => shown.push(command),
  },
  window: { showErrorMessage: async (message) => void shown.push(message) },
  workspace: {
    workspaceFolders: [{ uri: { fsPath: folder } }],
    getConfiguration: () => ({ get: (name, other) => (name === "path" ? path : other) }),
    onDidChangeConfiguration: (listener) => listeners.configuration.push(listener),
    registerTextDocumentContentProvider: (scheme, provider) => providers.set(scheme, provider),
  },
};

const load = Module._load;
Module._load = (name, ...rest) => {
  if (name === "vscode") return vscode;
  if (name === "vscode-languageclient/node") return { LanguageClient, TransportKind: { stdio: 0 } };
  return load(name, ...rest);
};
const extension = createRequire(import.meta.url)("../extension.js");
Module._load = load;

function executable(...parts) {
  const file = join(folder, ...parts);
  mkdirSync(join(file, ".."), { recursive: true });
  writeFileSync(file, "");
  chmodSync(file, 0o755);
  return file;
}

beforeEach(async () => {
  await extension.deactivate();
  shown.length = 0;
  clients.length = 0;
  startError = undefined;
  process.env.PATH = "";
});

const activate = () => extension.activate({ subscriptions: [] });

test("the command is started by its whole path", async () => {
  path = executable("whole", "starl");
  await activate();
  assert.deepEqual(shown, []);
  assert.equal(clients[0].server.command, path);
  assert.deepEqual(clients[0].server.args, ["lsp"]);
  assert.equal(clients[0].options.documentSelector[0].language, "starl");
});

test("the command is found in the search path", async () => {
  const file = executable("search", "starl");
  path = "starl";
  process.env.PATH = join(folder, "search");
  await activate();
  assert.equal(clients[0].server.command, file);
});

test("a path may begin at the folder that is open", async () => {
  const file = executable("target", "release", "starl");
  path = "./target/release/starl";
  await activate();
  assert.equal(clients[0].server.command, file);
});

test("a command that is missing is told, with what to do", async () => {
  path = join(folder, "nowhere", "starl");
  await activate();
  assert.equal(clients.length, 0);
  assert.match(shown[0], /there is no command ".*nowhere.*starl"/);
  assert.match(shown[0], /cargo install --path apps\/starl/);
  assert.match(shown[0], /"starl\.path"/);
});

test("a command that does not start is told, with the reason", async () => {
  path = executable("broken", "starl");
  startError = new Error("exec format error");
  await activate();
  assert.match(shown[0], /could not be started: exec format error/);
});

test("another path in the settings starts another server", async () => {
  path = executable("first", "starl");
  await activate();
  path = executable("second", "starl");
  listeners.configuration.at(-1)({ affectsConfiguration: (name) => name === "starl.path" });
  await new Promise(setImmediate);
  assert.equal(clients[0].running, false);
  assert.equal(clients.at(-1).server.command, path);
});

test("texts that are part of the command are asked for", async () => {
  path = executable("whole", "starl");
  await activate();
  const provider = providers.get("starl-library");
  const text = await provider.provideTextDocumentContent(new URL("starl-library:/prelude.starl"));
  assert.equal(text, "starl/library starl-library:/prelude.starl");
});
