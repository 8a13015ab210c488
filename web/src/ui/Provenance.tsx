// Where a fitness value comes from. The colours are the same wherever evaluations are drawn.

const KINDS = [
  { kind: "simulated", meaning: "executed in the simulation" },
  { kind: "real", meaning: "executed on a robot" },
  { kind: "inherited", meaning: "computed from its parents, not executed" },
  { kind: "granule", meaning: "taken from a similar candidate, not executed" },
  { kind: "penalised", meaning: "violates a constraint, not executed" },
] as const;

export type Provenance = (typeof KINDS)[number]["kind"];

/** The legend, with the number of evaluations of each kind that is known. */
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
