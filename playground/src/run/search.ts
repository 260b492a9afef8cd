// Binary search in lists that are in order.

/** The index of the first member for which `later` holds, as it does for all that follow; the length if there is none. */
export function firstWhere<Member>(list: readonly Member[], later: (member: Member) => boolean): number {
  let [low, high] = [0, list.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (later(list[middle] as Member)) high = middle;
    else low = middle + 1;
  }
  return low;
}
