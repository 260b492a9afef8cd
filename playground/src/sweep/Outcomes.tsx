// How runs ended, by profile.

import { type Counts, OUTCOMES } from "./results.ts";
import { shown, sweep } from "./sweep.ts";

const WORDS = { reached: "reached", timed_out: "timed out", violated: "violated", failed: "failed" };

export function Outcomes() {
  void shown.value;
  const results = sweep.value?.results;
  if (!results) return null;
  return (
    <section aria-label="Outcomes">
      <h3>How the runs ended</h3>
      <table class="outcomes">
        <thead>
          <tr>
            <th scope="col">Profile</th>
            <th scope="col">Runs</th>
            {OUTCOMES.map((outcome) => (
              <th scope="col" key={outcome}>
                <span class={`key ${outcome}`} aria-hidden="true" />
                {WORDS[outcome]}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {[...results.counts].map(([profile, counts]) => (
            <Row key={profile} profile={profile} counts={counts} />
          ))}
        </tbody>
      </table>
    </section>
  );
}

function Row({ profile, counts }: { profile: string; counts: Counts }) {
  const { runs, by } = counts;
  return (
    <>
      <tr>
        <th scope="row">{profile}</th>
        <td>{runs}</td>
        {OUTCOMES.map((outcome) => (
          <td key={outcome} class={by[outcome] === 0 ? "muted" : ""}>
            {by[outcome]}
          </td>
        ))}
      </tr>
      <tr class="bars">
        <td colSpan={2 + OUTCOMES.length}>
          <div class="stack" aria-hidden="true">
            {OUTCOMES.map((outcome) => (
              <span
                key={outcome}
                class={`key ${outcome}`}
                style={{ width: `${runs > 0 ? (by[outcome] / runs) * 100 : 0}%` }}
              />
            ))}
          </div>
        </td>
      </tr>
    </>
  );
}
