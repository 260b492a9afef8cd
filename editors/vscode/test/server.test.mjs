// The server understands the client that the editor uses, and the other way round. The environment variable
// STARL names the command; without it there is nothing to test.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { createRequire } from "node:module";
import { test } from "node:test";

const require = createRequire(import.meta.url);
const protocol = require("vscode-languageserver-protocol/node");

const uri = "untitled:Program";
const text = `program P
/// How many.
count: Int = 0
go()
    pre count < 3
    eff count += unknown
`;

const skip = process.env.STARL ? false : "STARL names no command";

test("the editor's own client talks to the server", { skip }, async () => {
  const server = spawn(process.env.STARL, ["lsp", "--stdio"], { stdio: ["pipe", "pipe", "inherit"] });
  const ended = new Promise((resolve) => server.on("exit", resolve));
  const connection = protocol.createProtocolConnection(
    new protocol.StreamMessageReader(server.stdout),
    new protocol.StreamMessageWriter(server.stdin),
  );
  const told = new Promise((resolve) =>
    connection.onNotification(protocol.PublishDiagnosticsNotification.type, resolve),
  );
  connection.listen();

  const { capabilities } = await connection.sendRequest(protocol.InitializeRequest.type, {
    processId: process.pid,
    rootUri: null,
    capabilities: {},
  });
  assert.equal(capabilities.textDocumentSync.change, protocol.TextDocumentSyncKind.Incremental);
  connection.sendNotification(protocol.InitializedNotification.type, {});
  connection.sendNotification(protocol.DidOpenTextDocumentNotification.type, {
    textDocument: { uri, languageId: "starl", version: 1, text },
  });

  const { diagnostics } = await told;
  assert.deepEqual(
    diagnostics.map(({ code, range }) => [code, range.start.line, range.start.character]),
    [["E0201", 5, 17]],
  );
  const at = { textDocument: { uri }, position: { line: 4, character: 10 } };
  const hover = await connection.sendRequest(protocol.HoverRequest.type, at);
  assert.match(hover.contents.value, /count: Int = 0[^]*How many\./);
  const definition = await connection.sendRequest(protocol.DefinitionRequest.type, at);
  assert.equal(definition.range.start.line, 2);
  const list = await connection.sendRequest(protocol.CompletionRequest.type, at);
  assert.ok(list.items.some(({ label }) => label === "count"));
  const edit = await connection.sendRequest(protocol.RenameRequest.type, { ...at, newName: "number" });
  assert.equal(edit.changes[uri].length, 3);
  await assert.rejects(
    connection.sendRequest(protocol.RenameRequest.type, { ...at, newName: "if" }),
    /`if` is a word of the language/,
  );

  await connection.sendRequest(protocol.ShutdownRequest.type);
  await connection.sendNotification(protocol.ExitNotification.type);
  assert.equal(await ended, 0);
  connection.dispose();
});
