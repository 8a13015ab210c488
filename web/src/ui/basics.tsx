// Small building blocks of every page.

import type { ReactNode } from "react";
import { Link } from "react-router";
import type { JobState } from "../api/types";
import { stateInfo, type Tone } from "../lib/states";
import type { VerdictInfo } from "../lib/verdicts";

export function StateBadge({ state }: { state: JobState }) {
  const info = stateInfo(state);
  return <span className={`badge tone-${info.tone} ${info.active ? "active" : ""}`}>{info.label}</span>;
}

export function Badge({ tone, children }: { tone: Tone; children: ReactNode }) {
  return <span className={`badge tone-${tone}`}>{children}</span>;
}

/** A verdict in its colour, explained when pointed at; a dash if there is none. */
export function VerdictBadge({ verdict }: { verdict: VerdictInfo | null }) {
  if (verdict === null) return <>–</>;
  return (
    <span className={`badge tone-${verdict.tone}`} title={verdict.meaning}>
      {verdict.label}
    </span>
  );
}

interface HeadProps {
  title: string;
  lead?: ReactNode;
  back?: { to: string; label: string };
  badge?: ReactNode;
  children?: ReactNode;
}

/** Title, one sentence, and the page's actions. */
export function PageHead({ title, lead, back, badge, children }: HeadProps) {
  return (
    <div className="page-head">
      <title>{`${title} · cgda`}</title>
      <div>
        {back && (
          <Link className="crumb" to={back.to}>
            ← {back.label}
          </Link>
        )}
        <div className="row">
          <h1>{title}</h1>
          {badge}
        </div>
        {lead && <p className="muted">{lead}</p>}
      </div>
      {children && <div className="row">{children}</div>}
    </div>
  );
}

interface CardProps {
  title?: string;
  aside?: ReactNode;
  flush?: boolean;
  children: ReactNode;
}

export function Card({ title, aside, flush, children }: CardProps) {
  return (
    <section className={flush ? "card flush" : "card"} aria-label={title}>
      {title !== undefined && (
        <header>
          <h2>{title}</h2>
          {aside}
        </header>
      )}
      {children}
    </section>
  );
}

export function ProgressBar({ share, label, slim }: { share: number; label: string; slim?: boolean }) {
  const percent = Math.round(Math.min(1, Math.max(0, share)) * 1000) / 10;
  return (
    <div
      className={slim ? "bar slim" : "bar"}
      role="progressbar"
      aria-label={label}
      aria-valuemin={0}
      aria-valuemax={100}
      aria-valuenow={percent}
    >
      <div style={{ width: `${percent}%` }} />
    </div>
  );
}

export interface Fact {
  name: string;
  value: ReactNode;
}

export function Facts({ facts, large }: { facts: Fact[]; large?: boolean }) {
  return (
    <dl className={large ? "facts large" : "facts"}>
      {facts.map((fact) => (
        <div key={fact.name}>
          <dt>{fact.name}</dt>
          <dd>{fact.value}</dd>
        </div>
      ))}
    </dl>
  );
}

export function Empty({ title, children }: { title: string; children: ReactNode }) {
  return (
    <div className="empty">
      <h2>{title}</h2>
      {children}
    </div>
  );
}
