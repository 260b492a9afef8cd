// Small fields of the forms.

import type { Signal } from "@preact/signals";
import type { ComponentChildren } from "preact";

export function Text({
  label,
  value,
  placeholder,
}: {
  label: string;
  value: Signal<string>;
  placeholder?: string;
}) {
  return (
    <label class="field">
      <span>{label}</span>
      <input
        type="text"
        value={value.value}
        placeholder={placeholder}
        onInput={(event) => {
          value.value = event.currentTarget.value;
        }}
      />
    </label>
  );
}

/** A number, kept as the person types it. */
export function Numeric({
  label,
  value,
  step = "any",
}: {
  label: string;
  value: Signal<string>;
  step?: string;
}) {
  return (
    <label class="field number">
      <span>{label}</span>
      <input
        type="number"
        step={step}
        value={value.value}
        onInput={(event) => {
          value.value = event.currentTarget.value;
        }}
      />
    </label>
  );
}

export function Choice({
  label,
  value,
  children,
}: {
  label: string;
  value: Signal<string>;
  children: ComponentChildren;
}) {
  return (
    <label class="field">
      <span>{label}</span>
      <select
        value={value.value}
        onChange={(event) => {
          value.value = event.currentTarget.value;
        }}
      >
        {children}
      </select>
    </label>
  );
}
