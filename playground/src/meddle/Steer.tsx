export function Steer() {
  return null;
}
