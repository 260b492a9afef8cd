export function Scenario() {
  return null;
}
