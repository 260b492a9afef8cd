// What there is to know of the run, and how to steer it.

import { Breakpoints } from "../breakpoints/Breakpoints.tsx";
import { Compare } from "../compare/Compare.tsx";
import { Log } from "../inspect/Log.tsx";
import { Properties } from "../inspect/Properties.tsx";
import { Robots } from "../inspect/Robots.tsx";
import { violations } from "../inspect/violations.ts";
import { Steer } from "../meddle/Steer.tsx";
import { Messages } from "../messages/Messages.tsx";
import { Plots } from "../plots/Plots.tsx";
import { run } from "./context.ts";
import { sideTab } from "./side-tab.ts";
import { type Tab, Tabs } from "./Tabs.tsx";

export function Side() {
  const tabs: Tab[] = [
    { name: "robots", label: "Robots", panel: Robots },
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
