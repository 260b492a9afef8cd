// The values at a moment of the run, by key, from a list of changes in the order of the records. It goes forth and
// back by doing and undoing the changes in between, so a step costs what has changed.

interface Change<Value> {
  /** The place of the record among all of the run. */
  index: number;
  key: string;
  /** Null takes the entry away. */
  value: Value | null;
  /** The previous value, once it is done. */
  before: Value | undefined;
}

export class Ledger<Value> {
  readonly current = new Map<string, Value>();
  /** Changes whenever `current` does. */
  version = 0;
  #changes: Change<Value>[] = [];
  #done = 0;

  /** Adds a change; its record comes after all that were added before. */
  record(index: number, key: string, value: Value | null): void {
    this.#changes.push({ index, key, value, before: undefined });
  }

  /** Goes to the moment at which the first `position` records of the run have been made. */
  go(position: number): void {
    const from = this.#done;
    for (;;) {
      const change = this.#changes[this.#done];
      if (!change || change.index >= position) break;
      change.before = this.current.get(change.key);
      this.#set(change.key, change.value ?? undefined);
      this.#done++;
    }
    for (;;) {
      const change = this.#changes[this.#done - 1];
      if (!change || change.index < position) break;
      this.#set(change.key, change.before);
      this.#done--;
    }
    if (this.#done !== from) this.version++;
  }

  clear(): void {
    this.current.clear();
    this.#changes = [];
    this.#done = 0;
    this.version++;
  }

  #set(key: string, value: Value | undefined): void {
    if (value === undefined) this.current.delete(key);
    else this.current.set(key, value);
  }
}
