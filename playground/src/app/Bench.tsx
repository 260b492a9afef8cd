// What a person writes: programs, the scenario, and where to begin.

import { signal } from "@preact/signals";
import { Editor } from "../editor/Editor.tsx";
import { Gallery } from "../gallery/Gallery.tsx";
import { Lesson } from "../lesson/Lesson.tsx";
import { LessonStrip } from "../lesson/LessonStrip.tsx";
import { Scenario } from "../scenario/Scenario.tsx";
import { Sweep } from "../sweep/Sweep.tsx";
import { type Tab, Tabs } from "./Tabs.tsx";

export const benchTab = signal("gallery");

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
