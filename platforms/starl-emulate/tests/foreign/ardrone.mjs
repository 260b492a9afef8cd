// The npm package `ar-drone` flies the emulated AR.Drone, which so proves to be one.
//
//     node ardrone.mjs DEVICES
//
// DEVICES is the example of that name, built.

import arDrone from "ar-drone";
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { setTimeout as sleep } from "node:timers/promises";

const folder = await mkdtemp(join(tmpdir(), "starl-"));
const devices = spawn(process.argv[2], [folder], { stdio: ["pipe", "pipe", "inherit"] });
const lines = createInterface({ input: devices.stdout })[Symbol.asyncIterator]();
const answer = async () => JSON.parse((await lines.next()).value);
const where = await answer();
const pose = async () => {
  devices.stdin.write("\n");
  const [x, y, z, yaw] = (await answer()).drone;
  return { x, y, z, yaw };
};

const ip = "127.0.0.1";
const udpControl = arDrone.createUdpControl({ ip, port: where.commands });
const udpNavdataStream = arDrone.createUdpNavdataStream({ ip, port: where.navdata });
const client = arDrone.createClient({ udpControl, udpNavdataStream });
let navdata;
let received = 0;
client.on("navdata", (data) => {
  navdata = data;
  received += 1;
});
client.on("error", (error) => {
  throw error;
});

const patience = () => ({ signal: AbortSignal.timeout(8000) });
const near = (what, value, expected, tolerance) => {
  console.log(`${what}: ${value.toFixed(3)}, expected ${expected.toFixed(3)}`);
  assert.ok(Math.abs(value - expected) <= tolerance, `${what} is ${value}, not within ${tolerance} of ${expected}`);
};
const agrees = async () => {
  const truth = await pose();
  near("altitude, m", navdata.demo.altitudeMeters, truth.z, 0.1);
  near("degrees to the right", navdata.demo.clockwiseDegrees, ((-0.4 - truth.yaw) * 180) / Math.PI, 8);
  return truth;
};

const start = await pose();
client.config("control:euler_angle_max", "0.30");
await sleep(1000);
assert.ok(navdata.demo, "general:navdata_demo brings the option demo");
assert.equal(navdata.demo.controlState, "CTRL_LANDED");
assert.equal(navdata.droneState.flying, 0);

client.takeoff();
await once(client, "hovering", patience());
assert.equal(navdata.droneState.flying, 1);
const risen = await agrees();
assert.ok(risen.z > 0.4, "it has taken off");

client.front(0.4);
await sleep(1500);
const direction = (await pose()).yaw;
assert.ok(navdata.demo.frontBackDegrees < -3, "the nose is down");
near("pitch, degrees", navdata.demo.frontBackDegrees, -0.4 * 0.3 * (180 / Math.PI), 1);
assert.ok(navdata.demo.xVelocity > 300, "it flies ahead");
client.stop();
await sleep(2000);
const ahead = await pose();
const way = Math.hypot(ahead.x - start.x, ahead.y - start.y);
assert.ok(way > 0.8, `it has flown ${way} m`);
near("direction, rad", Math.atan2(ahead.y - start.y, ahead.x - start.x), direction, 0.05);

client.right(0.3);
await sleep(800);
assert.ok(navdata.demo.leftRightDegrees > 2 && navdata.demo.yVelocity > 100, "it flies to the right");
client.stop();
client.clockwise(0.5);
client.up(0.3);
await sleep(1000);
client.stop();
await sleep(500);
const turned = await agrees();
assert.ok(turned.yaw < start.yaw - 0.3 && turned.z > risen.z + 0.1, "it has turned to the right and risen");

client.land();
await once(client, "landed", patience());
assert.equal((await pose()).z, 0);
assert.equal(navdata.demo.batteryPercentage, client.battery());
assert.ok(received > 80, `${received} datagrams of navdata`);
console.log(`the package ar-drone flies the emulated AR.Drone; ${received} datagrams of navdata`);

devices.stdin.end();
await rm(folder, { recursive: true });
process.exit(0);
