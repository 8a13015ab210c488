import { keepPreviousData, skipToken, useQuery } from "@tanstack/react-query";
import { useDeferredValue } from "react";
import { api, body } from "../../api/client";
import type { CreateJob } from "../../api/types";
import { formatCount, formatDuration } from "../../lib/format";
import { Card, Facts } from "../../ui/basics";
import { Loaded, Notice } from "../../ui/feedback";

const capitalized = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

/** What the server says of the job before it is started: what is wrong with it, or what it will cost. */
export function DryRun({ request }: { request: CreateJob | null }) {
  const asked = useDeferredValue(request);
  const answer = useQuery({
    queryKey: ["validation", asked],
    queryFn:
      asked === null ? skipToken : ({ signal }) => body(api.POST("/api/v1/jobs:validate", { body: asked, signal })),
    placeholderData: keepPreviousData,
  });
  return (
    <Card title="Before you start">
      {asked === null ? (
        <p className="muted">Choose action, robot and world; the cost is estimated here.</p>
      ) : (
        <Loaded query={answer}>
          {({ valid, errors, estimate }) => (
            <div className="stack" aria-live="polite">
              {!valid && (
                <Notice tone="bad" title="The job would be refused">
                  <ul>
                    {errors.map((error, index) => (
                      <li key={index}>
                        <code>{error.pointer}</code> {error.detail}
                      </li>
                    ))}
                  </ul>
                </Notice>
              )}
              {estimate != null && (
                <>
                  <Facts
                    facts={[
                      { name: "Evaluations, about", value: formatCount(estimate.evaluations) },
                      { name: "In simulation", value: formatDuration(estimate.simulated_s) },
                      { name: "If each were a trial on a robot", value: formatDuration(estimate.robot_s) },
                    ]}
                  />
                  <p>{capitalized(estimate.text)}.</p>
                  <p className="small muted">How this is known: {estimate.basis}.</p>
                </>
              )}
            </div>
          )}
        </Loaded>
      )}
    </Card>
  );
}
