export function Plots() {
  return null;
}
