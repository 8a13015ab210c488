// Legend of where fitness values come from; the colours are the same in every chart of evaluations.

const KINDS = [
  { kind: "simulated", meaning: "executed in the simulation" },
  { kind: "real", meaning: "executed on a robot" },
  { kind: "inherited", meaning: "computed from its parents, not executed" },
  { kind: "granule", meaning: "taken from a similar candidate, not executed" },
  { kind: "penalised", meaning: "violates a constraint, not executed" },
] as const;

export type Provenance = (typeof KINDS)[number]["kind"];

/** The legend, with a count next to each kind that has one. */
export function ProvenanceLegend({ counts }: { counts: Partial<Record<Provenance, string>> }) {
  return (
    <ul className="legend" aria-label="Provenance of evaluations">
      {KINDS.map(({ kind, meaning }) => (
        <li key={kind} title={meaning}>
          <i style={{ ["--swatch" as string]: `var(--${kind})` }} />
          {kind} {counts[kind]}
        </li>
      ))}
    </ul>
  );
}
