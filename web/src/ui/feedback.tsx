// Loading states, notices and error reports.

import type { UseQueryResult } from "@tanstack/react-query";
import type { ReactNode } from "react";
import { ApiError } from "../api/client";
import type { Tone } from "../lib/states";

export function Notice({ tone, title, children }: { tone: Tone; title: string; children?: ReactNode }) {
  return (
    <div className={`notice tone-${tone}`} role={tone === "bad" ? "alert" : "status"}>
      <strong>{title}</strong>
      {children}
    </div>
  );
}

/** An error with its invalid fields and the request id under which it appears in the server's log. */
export function Problem({ error, title = "Something went wrong" }: { error: Error; title?: string }) {
  const places = error instanceof ApiError ? error.errors : [];
  const requestId = error instanceof ApiError ? error.requestId : undefined;
  return (
    <Notice tone="bad" title={title}>
      <p>{error.message}</p>
      {places.length > 0 && (
        <ul>
          {places.map((place, index) => (
            <li key={index}>
              {place.pointer && <code>{place.pointer}</code>} {place.detail}
            </li>
          ))}
        </ul>
      )}
      {requestId !== undefined && <p className="small muted">Request {requestId}</p>}
    </Notice>
  );
}

export function Loading({ lines = 4 }: { lines?: number }) {
  return (
    <div role="status" aria-label="Loading">
      {Array.from({ length: lines }, (_, line) => (
        <div key={line} className="skeleton" style={{ width: `${92 - 13 * (line % 4)}%` }} />
      ))}
    </div>
  );
}

interface LoadedProps<T> {
  query: Pick<UseQueryResult<T>, "data" | "error">;
  children: (data: T) => ReactNode;
}

/** Renders the data once it has loaded; if a later fetch fails, the error is shown above the last data. */
export function Loaded<T>({ query, children }: LoadedProps<T>) {
  return (
    <>
      {query.error && <Problem error={query.error} title="Loading failed" />}
      {query.data !== undefined ? children(query.data) : !query.error && <Loading />}
    </>
  );
}
