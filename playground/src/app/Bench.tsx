// The editing side of the page: programs, the scenario, and where to begin.

import { Editor } from "../editor/Editor.tsx";
import { Gallery } from "../gallery/Gallery.tsx";
import { LessonStrip } from "../lesson/LessonStrip.tsx";
import { lazy } from "./lazy.tsx";
import { benchTab } from "./shown.ts";
import { type Tab, Tabs } from "./Tabs.tsx";

const Lesson = lazy(async () => (await import("../lesson/Lesson.tsx")).Lesson);
const Scenario = lazy(async () => (await import("../scenario/Scenario.tsx")).Scenario);
const Sweep = lazy(async () => (await import("../sweep/Sweep.tsx")).Sweep);

const TABS: Tab[] = [
  { name: "gallery", label: "Examples", panel: Gallery },
  { name: "lesson", label: "Lesson", panel: Lesson },
  { name: "program", label: "Program", panel: Editor },
  { name: "scenario", label: "Scenario", panel: Scenario },
  { name: "sweep", label: "Sweep", panel: Sweep },
];

export function Bench() {
  return (
    <>
      <LessonStrip />
      <Tabs tabs={TABS} chosen={benchTab} label="Program and scenario" />
    </>
  );
}
