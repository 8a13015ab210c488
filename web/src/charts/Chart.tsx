// Charts; their chunk is loaded on first use.

import { lazy, Suspense, type ComponentProps } from "react";

const Lazy = lazy(async () => ({ default: (await import("./LineChart")).LineChart }));

export function Chart(props: ComponentProps<typeof Lazy>) {
  return (
    <Suspense fallback={<div className="chart" style={{ minHeight: props.height ?? 240 }} />}>
      <Lazy {...props} />
    </Suspense>
  );
}
