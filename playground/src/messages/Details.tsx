// All there is to know of the message or the event that a person has chosen.

import { run } from "../app/context.ts";
import { seconds } from "../app/format.ts";
import { nameOf } from "../inspect/names.ts";
import type { Event } from "../run/events.ts";
import { describe } from "../timeline/lanes.ts";
import { chosen } from "./Diagram.tsx";
import { knownTraffic } from "./known.ts";
import type { Datagram, Traffic } from "./traffic.ts";

/** Of a broadcast, so many receivers are listed; of a payload, so many bytes. */
const RECEIVERS = 40;
const BYTES = 64;

export function Details() {
  void run.grown.value;
  const traffic = knownTraffic();
  const message = run.message.value;
  const datagram = message && traffic.datagram(message.from, message.sequence);
  const event = chosen.value;
  return (
    <div class="details" aria-live="polite">
      {datagram ? (
        <Message datagram={datagram} traffic={traffic} />
      ) : event ? (
        <p>
          <At event={event} /> {describe(event, nameOf)}
        </p>
      ) : (
        <p class="muted">
          Choose a message to see where it went; choose an event to go to its moment. Drag to move it; the
          wheel or two fingers zoom.
        </p>
      )}
    </div>
  );
}

function Message({ datagram, traffic }: { datagram: Datagram; traffic: Traffic }) {
  const { from, sequence, sent, ends } = datagram;
  const bytes = decode(String(sent.message.payload ?? ""));
  const to = sent.message.to;
  return (
    <>
      <h2>
        Message {sequence} of {nameOf(from)}
      </h2>
      <dl class="facts">
        <dt>Sent</dt>
        <dd>
          <At event={sent} /> to {typeof to === "number" ? nameOf(to) : "all in reach"}
        </dd>
        <dt>For</dt>
        <dd>{receiver(Number(sent.message.port ?? 0), traffic)}</dd>
        <dt>Payload</dt>
        <dd>
          {bytes.length} bytes
          {bytes.length > 0 && <code class="bytes">{hexadecimal(bytes)}</code>}
        </dd>
      </dl>
      {ends.length === 0 && <p>It has not arrived yet.</p>}
      <ul class="plain">
        {ends.slice(0, RECEIVERS).map((end) => (
          <li key={end.index}>
            <At event={end} /> {outcome(end)}{" "}
            <span class="muted">after {((end.time - sent.time) * 1000).toFixed(2)} ms</span>
          </li>
        ))}
        {ends.length > RECEIVERS && <li class="muted">and {ends.length - RECEIVERS} more</li>}
      </ul>
    </>
  );
}

const outcome = ({ topic, message }: Event): string =>
  topic === "/starl/delivered"
    ? `delivered to ${nameOf(Number(message.robot))}`
    : `lost${typeof message.to === "number" ? ` on the way to ${nameOf(message.to)}` : ""}: ${message.reason}`;

function At({ event }: { event: Event }) {
  return (
    <button type="button" class="link" title="Go to this moment" onClick={() => run.show(event)}>
      {seconds(event.time, 4)}
    </button>
  );
}

/** The name of a port: the primitive's name in the program if known, or its type. */
function receiver(port: number, traffic: Traffic): string {
  if (port === 0) return "the program";
  for (const robot of run.robots.value) {
    const primitive = robot.primitives.find((primitive) => primitive.port === port);
    if (primitive) return `${primitive.name} (${primitive.kind})`;
  }
  return traffic.ports.get(port) ?? `port ${port}`;
}

function decode(base64: string): Uint8Array {
  try {
    return Uint8Array.from(atob(base64), (char) => char.charCodeAt(0));
  } catch {
    return new Uint8Array();
  }
}

function hexadecimal(bytes: Uint8Array): string {
  const shown = Array.from(bytes.subarray(0, BYTES), (byte) => byte.toString(16).padStart(2, "0")).join(" ");
  return bytes.length > BYTES ? `${shown} ...` : shown;
}
