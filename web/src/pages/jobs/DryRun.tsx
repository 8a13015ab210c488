import { keepPreviousData, skipToken, useQuery } from "@tanstack/react-query";
import { useDeferredValue } from "react";
import { api, body } from "../../api/client";
import type { CreateJob } from "../../api/types";
import { formatCount, formatDuration } from "../../lib/format";
import { Card, Facts } from "../../ui/basics";
import { Loaded, Notice } from "../../ui/feedback";

const capitalized = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

/** The server's dry run of the job: its errors, or its estimated cost. */
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
        <p className="muted">Choose an action, a robot and a world to see the estimated cost.</p>
      ) : (
        <Loaded query={answer}>
          {({ valid, errors, estimate }) => (
            <div className="stack" aria-live="polite">
              {!valid && (
                <Notice tone="bad" title="The job would be rejected">
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
                      { name: "Estimated evaluations", value: formatCount(estimate.evaluations) },
                      { name: "In simulation", value: formatDuration(estimate.simulated_s) },
                      { name: "On a real robot", value: formatDuration(estimate.robot_s) },
                    ]}
                  />
                  <p>{capitalized(estimate.text)}.</p>
                  <p className="small muted">Basis of the estimate: {estimate.basis}.</p>
                </>
              )}
            </div>
          )}
        </Loaded>
      )}
    </Card>
  );
}
