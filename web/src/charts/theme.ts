// The current scheme's colours for canvases, which cannot inherit CSS; read once per scheme.

import { useSyncExternalStore } from "react";

const scheme = window.matchMedia("(prefers-color-scheme: dark)");

function subscribe(listener: () => void): () => void {
  scheme.addEventListener("change", listener);
  return () => scheme.removeEventListener("change", listener);
}

/** True in the dark scheme; re-renders the component on change. */
export function useDarkScheme(): boolean {
  return useSyncExternalStore(subscribe, () => scheme.matches);
}

/** The value of a design token such as `curve`. */
export function token(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}
