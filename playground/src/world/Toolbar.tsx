// How the world is looked at, and what the pointer does there.

import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { run } from "../app/context.ts";
import { Above, Cube, Fit, Follow, Layers, Measure, Move } from "./icons.tsx";
import { flat, LAYERS, type Layer, setFlat, shows, toggleLayer } from "./layers.ts";
import { followed, measured, tool } from "./pick.ts";

interface Props {
  fit: (whole: boolean) => void;
  /** Whether there is only the view from above. */
  onlyFlat: boolean;
}

export function Toolbar({ fit, onlyFlat }: Props) {
  const selected = run.selected.value.at(-1);
  const name = selected === undefined ? undefined : run.fleet.value[selected]?.name;
  return (
    <div class="world-tools" role="toolbar" aria-label="View of the world">
      <div class="group">
        <Tool label="From above" pressed={flat.value} act={() => setFlat(true)}>
          <Above />
        </Tool>
        {!onlyFlat && (
          <Tool label="3-D" pressed={!flat.value} act={() => setFlat(false)}>
            <Cube />
          </Tool>
        )}
      </div>
      <Tool
        label="Fit"
        title="Fit to what moves (F), with Shift to everything"
        act={(event) => fit(event.shiftKey)}
      >
        <Fit />
      </Tool>
      <Tool
        label="Follow"
        title={name ? `Follow ${name}` : "Select a robot to follow it"}
        disabled={selected === undefined}
        pressed={followed.value !== null}
        act={() => {
          followed.value = followed.value === null ? (selected ?? null) : null;
        }}
      >
        <Follow />
      </Tool>
      <Tool
        label="Measure"
        title="Measure a distance: click two places"
        pressed={tool.value === "measure"}
        act={() => {
          measured.value = [];
          tool.value = tool.value === "measure" ? "look" : "measure";
        }}
      >
        <Measure />
      </Tool>
      {run.live.value && (
        <Tool
          label="Move"
          title="Drag robots, waypoints, things and obstacles to another place"
          pressed={tool.value === "move"}
          act={() => {
            tool.value = tool.value === "move" ? "look" : "move";
          }}
        >
          <Move />
        </Tool>
      )}
      <LayerMenu />
    </div>
  );
}

function Tool(props: {
  label: string;
  title?: string;
  pressed?: boolean;
  disabled?: boolean;
  act: (event: MouseEvent) => void;
  children: ComponentChildren;
}) {
  return (
    <button
      type="button"
      title={props.title ?? props.label}
      aria-label={props.label}
      aria-pressed={props.pressed}
      disabled={props.disabled}
      onClick={props.act}
    >
      {props.children}
      <span class="text">{props.label}</span>
    </button>
  );
}

function LayerMenu() {
  const open = useSignal(false);
  const menu = useRef<HTMLDivElement>(null);
  const button = useRef<HTMLButtonElement>(null);
  useEffect(() => {
    if (!open.value) return;
    const close = (event: Event) => {
      if (
        event instanceof KeyboardEvent ? event.key !== "Escape" : menu.current?.contains(event.target as Node)
      )
        return;
      open.value = false;
      if (event instanceof KeyboardEvent) button.current?.focus();
    };
    addEventListener("keydown", close);
    addEventListener("pointerdown", close);
    return () => {
      removeEventListener("keydown", close);
      removeEventListener("pointerdown", close);
    };
  }, [open.value]);
  return (
    <div class="layers" ref={menu}>
      <button
        ref={button}
        type="button"
        title="What is shown"
        aria-label="Layers"
        aria-expanded={open.value}
        aria-controls="world-layers"
        onClick={() => {
          open.value = !open.value;
        }}
      >
        <Layers />
        <span class="text">Layers</span>
      </button>
      {open.value && (
        <fieldset id="world-layers">
          <legend>Show</legend>
          {(Object.keys(LAYERS) as Layer[]).map((layer) => (
            <label key={layer}>
              <input type="checkbox" checked={shows(layer)} onChange={() => toggleLayer(layer)} />
              {LAYERS[layer]}
            </label>
          ))}
        </fieldset>
      )}
    </div>
  );
}
