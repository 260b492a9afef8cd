// Every example with a picture, where a click opens its files and its run; and the tasks for learning.

import { useEffect } from "preact/hooks";
import { run } from "../app/context.ts";
import { lazy } from "../app/lazy.tsx";
import { benchTab } from "../app/shown.ts";
import { Projects } from "../project/Projects.tsx";
import { recent } from "../project/project.ts";
import { examples, loadExamples, openExample, titleOf } from "./examples.ts";
import { grouped } from "./groups.ts";
import "../styles/gallery.css";

const PICTURES: Record<string, string> = import.meta.glob("./pictures/*.svg", {
  query: "?url",
  import: "default",
  eager: true,
});

const Tasks = lazy(async () => (await import("./Tasks.tsx")).Tasks);

export function Gallery() {
  useEffect(() => {
    loadExamples().catch((error) => {
      run.problem.value = error;
    });
  }, []);
  return (
    <div class="gallery">
      {recent.value.length === 0 && <Welcome />}
      <Projects />
      {examples.value.length === 0 && <p class="muted">Loading examples …</p>}
      {grouped(examples.value).map(([heading, members]) => (
        <section key={heading}>
          <h2>{heading}</h2>
          <ul class="cards">
            {members.map((example) => (
              <li key={example.name}>
                <button type="button" class="card" onClick={() => openExample(example.name)}>
                  <img
                    src={PICTURES[`./pictures/${example.name}.svg`]}
                    alt=""
                    width="240"
                    height="150"
                    loading="lazy"
                  />
                  <span class="name">{titleOf(example)}</span>
                  <span class="muted">{sentence(example.summary)}</span>
                </button>
              </li>
            ))}
          </ul>
        </section>
      ))}
      {examples.value.length > 0 && <Tasks />}
    </div>
  );
}

/** For a first visit. */
function Welcome() {
  return (
    <section class="welcome">
      <p>
        <b>New here?</b> Click an example to see it run. In the first lesson you write a program for a team of
        robots, in ten minutes.
      </p>
      <button
        type="button"
        onClick={() => {
          benchTab.value = "lesson";
        }}
      >
        First lesson
      </button>
    </section>
  );
}

const sentence = (text: string) => `${text.charAt(0).toUpperCase()}${text.slice(1)}.`;
