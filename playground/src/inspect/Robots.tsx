export function Robots() {
  return null;
}
