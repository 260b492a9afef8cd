// Information about the run, and its steering.

import { violations } from "../inspect/violations.ts";
import { run } from "./context.ts";
import { lazy } from "./lazy.tsx";
import { loadRobots } from "./loads.ts";
import { sideTab } from "./shown.ts";
import { type Tab, Tabs } from "./Tabs.tsx";

const Breakpoints = lazy(async () => (await import("../breakpoints/Breakpoints.tsx")).Breakpoints);
const Compare = lazy(async () => (await import("../compare/Compare.tsx")).Compare);
const Messages = lazy(async () => (await import("../messages/Messages.tsx")).Messages);
const Plots = lazy(async () => (await import("../plots/Plots.tsx")).Plots);
const Steer = lazy(async () => (await import("../meddle/Steer.tsx")).Steer);
const Robots = lazy(loadRobots);
const Properties = lazy(async () => (await import("../inspect/Properties.tsx")).Properties);
const Log = lazy(async () => (await import("../inspect/Log.tsx")).Log);

const NoRobots = () => <p class="muted">Open an example or a program to see its robots.</p>;

export function Side() {
  const tabs: Tab[] = [
    { name: "robots", label: "Robots", panel: run.opened.value ? Robots : NoRobots },
    { name: "messages", label: "Messages", panel: Messages },
    { name: "properties", label: "Properties", panel: Properties, count: violations.value.length },
    { name: "log", label: "Log", panel: Log },
    { name: "plots", label: "Plots", panel: Plots },
  ];
  if (run.live.value) {
    tabs.push({ name: "steer", label: "Steer", panel: Steer });
    tabs.push({ name: "breakpoints", label: "Breakpoints", panel: Breakpoints });
  }
  tabs.push({ name: "compare", label: "Compare", panel: Compare });
  return <Tabs tabs={tabs} chosen={sideTab} label="Inspector" />;
}
