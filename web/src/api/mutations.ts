// Writes: one hook per user action. Each invalidates the queries it affects.

import { useMutation, useQueryClient } from "@tanstack/react-query";
import { api, body } from "./client";
import type { CreateJob, Job } from "./types";

/** One idempotency key per submission: a repeated click or a lost response cannot start a job twice. */
const idempotencyKey = () => crypto.randomUUID();

export function useCreateJob() {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: (job: CreateJob) =>
      body(api.POST("/api/v1/jobs", { body: job, params: { header: { "Idempotency-Key": idempotencyKey() } } })),
    onSuccess: () => queries.invalidateQueries({ queryKey: ["jobs"] }),
  });
}

export type JobVerb = "pause" | "resume" | "cancel" | "clone";

function steer(id: string, verb: JobVerb): Promise<Job> {
  const params = { path: { id } };
  switch (verb) {
    case "pause":
      return body(api.POST("/api/v1/jobs/{id}:pause", { params }));
    case "resume":
      return body(api.POST("/api/v1/jobs/{id}:resume", { params }));
    case "cancel":
      return body(api.POST("/api/v1/jobs/{id}:cancel", { params }));
    case "clone":
      return body(
        api.POST("/api/v1/jobs/{id}:clone", { params: { ...params, header: { "Idempotency-Key": idempotencyKey() } } }),
      );
  }
}

export function useSteerJob(id: string) {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: (verb: JobVerb) => steer(id, verb),
    onSuccess: (job) => {
      queries.setQueryData(["jobs", job.id], job);
      return queries.invalidateQueries({ queryKey: ["jobs"] });
    },
  });
}

export interface Upload {
  name: string;
  files: File[];
  /** Units by feature, as typed: `x=m, force=N`. */
  units: string;
  alignStart: boolean;
}

export function useUpload() {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: ({ name, files, units, alignStart }: Upload) => {
      const form = new FormData();
      form.set("name", name);
      if (units.trim() !== "") form.set("units", units);
      if (alignStart) form.set("clock_policy", "align_by_start");
      for (const file of files) form.append("files", file, file.name);
      // openapi.json describes the form's fields as an object; a browser sends a FormData.
      return body(api.POST("/api/v1/demonstrations", { body: form as never, bodySerializer: () => form }));
    },
    onSuccess: () => queries.invalidateQueries({ queryKey: ["demonstrations"] }),
  });
}

export function usePatchDemonstration(id: string) {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: ({ excluded, revision }: { excluded: string; revision: number }) =>
      body(
        api.PATCH("/api/v1/demonstrations/{id}", {
          params: { path: { id }, header: { "If-Match": `"${revision}"` } },
          body: { excluded },
        }),
      ),
    onSuccess: () => queries.invalidateQueries({ queryKey: ["demonstrations"] }),
  });
}

export function useCreateRobot() {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: ({ name, urdf, tipLink }: { name: string; urdf: string; tipLink: string }) =>
      body(api.POST("/api/v1/robots", { body: { name, urdf, spec: tipLink === "" ? {} : { tip_link: tipLink } } })),
    onSuccess: () => queries.invalidateQueries({ queryKey: ["robots"] }),
  });
}
