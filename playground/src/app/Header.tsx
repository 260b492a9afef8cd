// The title bar.

import { HeaderActions } from "./actions.tsx";
import { run } from "./context.ts";
import { theme, toggleTheme } from "./theme.ts";

export function Header() {
  const opened = run.opened.value;
  return (
    <header class="bar">
      <span class="brand">
        <img src="./icon.svg" alt="" width="22" height="22" />
        StarL
      </span>
      <h1 class="title">{opened ? opened.title : "Programs for teams of robots"}</h1>
      {opened?.seed && <span class="muted">seed {opened.seed}</span>}
      <span class="spread" />
      <HeaderActions />
      <button
        type="button"
        class="icon"
        onClick={toggleTheme}
        aria-label={theme.value === "dark" ? "Use light colours" : "Use dark colours"}
        title={theme.value === "dark" ? "Use light colours" : "Use dark colours"}
      >
        {theme.value === "dark" ? "☀" : "☾"}
      </button>
    </header>
  );
}
