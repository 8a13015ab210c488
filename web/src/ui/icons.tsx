// Line icons, 20 px, drawn for this dashboard. Decorative only: adjacent text or the button's label carries the meaning.

const PATHS = {
  jobs: "M3 5h14M3 10h14M3 15h8",
  demonstrations: "M2 13c2-7 4-7 6-2s3 5 5 0 3-5 5-3",
  actions: "M4 15 8 8l4 4 4-8M4 15h.01M8 8h.01M12 12h.01M16 4h.01",
  robots: "M5 17h6M8 17v-5l5-4-3-5M13 8l4 1M10 3 7 4",
  plus: "M10 4v12M4 10h12",
  play: "M6 4v12l10-6z",
  pause: "M7 4v12M13 4v12",
  restart: "M4 4v12M16 4v12L7 10z",
} as const;

export type IconName = keyof typeof PATHS;

export function Icon({ name }: { name: IconName }) {
  return (
    <svg width="20" height="20" viewBox="0 0 20 20" aria-hidden="true" focusable="false">
      <path d={PATHS[name]} fill="none" stroke="currentColor" strokeWidth="1.8" strokeLinecap="round" strokeLinejoin="round" />
    </svg>
  );
}

export function Mark() {
  return <img src="/favicon.svg" width="26" height="26" alt="" />;
}
