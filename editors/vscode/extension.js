// Starts `starl lsp` and connects the editor to it. Everything that the editor knows of programs comes from
// there; this file has no knowledge of the language.
// @ts-check
"use strict";

const { existsSync } = require("node:fs");
const { homedir } = require("node:os");
const { delimiter, isAbsolute, join } = require("node:path");
const vscode = require("vscode");
const { LanguageClient, TransportKind } = require("vscode-languageclient/node");

/** The scheme of texts that are part of the command. */
const LIBRARY_SCHEME = "starl-library";

/** @type {LanguageClient | undefined} */
let client;

/** @param {vscode.ExtensionContext} context */
async function activate(context) {
  const restart = vscode.commands.registerCommand("starl.restart", start);
  const library = vscode.workspace.registerTextDocumentContentProvider(LIBRARY_SCHEME, {
    provideTextDocumentContent: (uri) =>
      client?.isRunning() ? client.sendRequest("starl/library", { uri: uri.toString() }) : "",
  });
  const changed = vscode.workspace.onDidChangeConfiguration((event) => {
    if (event.affectsConfiguration("starl.path")) start();
  });
  context.subscriptions.push(restart, library, changed);
  await start();
}

async function deactivate() {
  await client?.stop();
  client = undefined;
}

async function start() {
  await deactivate();
  const path = vscode.workspace.getConfiguration("starl").get("path", "starl").trim() || "starl";
  const command = find(path);
  if (!command) return missing(path);
  const run = { command, args: ["lsp"], transport: TransportKind.stdio };
  try {
    client = new LanguageClient("starl", "StarL", run, {
      documentSelector: [
        { language: "starl", scheme: "file" },
        { language: "starl", scheme: "untitled" },
      ],
      initializationOptions: { libraryDocuments: true },
    });
    await client.start();
  } catch (error) {
    client = undefined;
    const reason = error instanceof Error ? error.message : String(error);
    const answer = await vscode.window.showErrorMessage(
      `StarL: ${command} lsp could not be started: ${reason}`,
      "Open settings",
    );
    if (answer) openSettings();
  }
}

/**
 * The file that the setting names: a path, or a name that is looked for in the search path.
 * @param {string} path
 * @returns {string | undefined}
 */
function find(path) {
  const whole = path.replace(/^~(?=$|[\\/])/, homedir());
  if (isAbsolute(whole)) return existing(whole);
  if (/[\\/]/.test(whole)) {
    const folders = vscode.workspace.workspaceFolders ?? [];
    return folders.map((folder) => existing(join(folder.uri.fsPath, whole))).find(Boolean);
  }
  const folders = (process.env.PATH ?? "").split(delimiter).filter(Boolean);
  // Where cargo installs commands; editors that are started from a menu often do not search there.
  folders.push(join(homedir(), ".cargo", "bin"));
  return folders.map((folder) => existing(join(folder, whole))).find(Boolean);
}

/** @param {string} file */
function existing(file) {
  const names = process.platform === "win32" ? [`${file}.exe`, file] : [file];
  return names.find(existsSync);
}

/** @param {string} path */
async function missing(path) {
  const answer = await vscode.window.showErrorMessage(
    `StarL: there is no command "${path}". Build it with "cargo install --path apps/starl" in a copy ` +
      'of StarL, or say where it is in the setting "starl.path". Until then programs are coloured, ' +
      "but not checked.",
    "Open settings",
  );
  if (answer) openSettings();
}

function openSettings() {
  vscode.commands.executeCommand("workbench.action.openSettings", "starl.path");
}

module.exports = { activate, deactivate };
