// What the title bar offers beside the title; each part of the page has its own file for what it offers.

export function HeaderActions() {
  return null;
}
