// The fields of a form, from the JSON Schema of scenario files, which the reader of scenarios makes of its own tables.

export interface Schema {
  description?: string;
  properties?: Record<string, Schema>;
  required?: string[];
  items?: Schema;
  anyOf?: Schema[];
  allOf?: { if?: Schema; then?: Schema }[];
  enum?: string[];
  const?: unknown;
  default?: unknown;
  minimum?: number;
  maximum?: number;
  "x-kind"?: string;
  "x-quantity"?: string;
  "x-units"?: string[];
  "x-unit"?: string;
  "x-default"?: string;
  "x-minimum"?: number | string;
  "x-exclusive-minimum"?: number | string;
  "x-maximum"?: number | string;
}

export interface Field {
  name: string;
  label: string;
  about: string;
  /** Its kind, as the reader names it: `quantity`, `choice`, `tables` and so on. */
  kind: string;
  required: boolean;
  /** The default. */
  default: string;
  /** The words that it may be, in place of another value or as the only ones. */
  choices: string[];
  units: string[];
  /** Such as `0 to 1`; empty if there is none to tell. */
  limits: string;
  /** Of a table, or of each element of a list of tables. */
  table: Schema | null;
}

/** The fields of a table in the order of the reference. */
export function fieldsOf(table: Schema): Field[] {
  const required = new Set(table.required);
  return Object.entries(table.properties ?? {}).map(([name, schema]) =>
    fieldOf(name, schema, required.has(name)),
  );
}

function fieldOf(name: string, schema: Schema, required: boolean): Field {
  const forms = [schema, ...(schema.anyOf ?? [])];
  const words = forms.flatMap((form) => (typeof form.const === "string" ? [form.const] : []));
  return {
    name,
    label: labelOf(name),
    about: schema.description ?? "",
    kind: schema["x-kind"] ?? "text",
    required,
    default: schema["x-default"] ?? worded(schema.default),
    choices: [...words, ...forms.flatMap((form) => form.enum ?? [])],
    units: schema["x-units"] ?? [],
    limits: limitsOf(schema, forms),
    table: forms.map((form) => form.items ?? form).find((form) => form.properties) ?? null,
  };
}

/** The fields that only robots of one model have. */
export function fieldsOfModel(robots: Schema, model: string): Field[] {
  for (const { if: condition, then } of robots.allOf ?? []) {
    if (condition?.properties?.model?.const !== model) continue;
    const [parameters] = Object.values(then?.properties ?? {});
    if (parameters) return fieldsOf(parameters);
  }
  return [];
}

/** `start_area` is shown as "Start area". */
export function labelOf(name: string): string {
  const text = name.replaceAll("_", " ");
  return text.charAt(0).toUpperCase() + text.slice(1);
}

function worded(value: unknown): string {
  if (value === undefined) return "";
  return typeof value === "string" ? value : JSON.stringify(value);
}

function limitsOf(schema: Schema, forms: Schema[]): string {
  const unit = schema["x-unit"] ?? "";
  const plain = forms.find((form) => form.minimum !== undefined || form.maximum !== undefined);
  const [least, most] = [schema["x-minimum"] ?? plain?.minimum, schema["x-maximum"] ?? plain?.maximum];
  const above = schema["x-exclusive-minimum"];
  // Of whole numbers of 64 bits, no person wants to know the greatest.
  const isEndless = typeof most === "number" && most > Number.MAX_SAFE_INTEGER;
  if (least !== undefined && most !== undefined && !isEndless) return `${least} to ${most} ${unit}`.trim();
  if (least !== undefined) return `at least ${least} ${unit}`.trim();
  return above === undefined ? "" : `above ${above}`;
}
