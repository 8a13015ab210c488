// Reads: one hook per resource. Query keys start with the resource's name, so that a write can invalidate all of them.

import { useInfiniteQuery, useQuery } from "@tanstack/react-query";
import { isFinal } from "../lib/states";
import { api, body } from "./client";

/** Polling intervals of lists, with and without active items. */
const LIVELY_MS = 1500;
const CALM_MS = 4000;

const nextPage = (page: { next_page_token: string }) => (page.next_page_token === "" ? undefined : page.next_page_token);
const pageQuery = (token: string) => ({ page_size: 50, ...(token === "" ? {} : { page_token: token }) });

export function useJobs() {
  return useInfiniteQuery({
    queryKey: ["jobs"],
    initialPageParam: "",
    queryFn: ({ pageParam }) => body(api.GET("/api/v1/jobs", { params: { query: pageQuery(pageParam) } })),
    getNextPageParam: nextPage,
    refetchInterval: ({ state }) => {
      const lively = state.data?.pages.some((page) => page.items.some((job) => !isFinal(job.state)));
      return lively === true ? LIVELY_MS : CALM_MS;
    },
  });
}

export function useJob(id: string) {
  return useQuery({
    queryKey: ["jobs", id],
    queryFn: () => body(api.GET("/api/v1/jobs/{id}", { params: { path: { id } } })),
    // The stream reports every change; polling only recovers a missed one.
    refetchInterval: ({ state }) => (state.data !== undefined && isFinal(state.data.state) ? false : CALM_MS),
  });
}

/** The catalogue of methods, which only another version of the server changes. */
export function useMethods() {
  return useQuery({ queryKey: ["methods"], queryFn: () => body(api.GET("/api/v1/methods")), staleTime: Infinity });
}

export function useRuns(job: string, enabled: boolean) {
  return useInfiniteQuery({
    queryKey: ["runs", { job }],
    enabled,
    initialPageParam: "",
    queryFn: ({ pageParam }) => body(api.GET("/api/v1/runs", { params: { query: { ...pageQuery(pageParam), job } } })),
    getNextPageParam: nextPage,
  });
}

export function useExperimentTable(id: string, final: boolean) {
  return useQuery({
    queryKey: ["experiments", id, "table", { final }],
    queryFn: () => body(api.GET("/api/v1/experiments/{id}/table", { params: { path: { id } } })),
    refetchInterval: final ? false : CALM_MS,
  });
}

export function useRun(id: string) {
  return useQuery({
    queryKey: ["runs", id],
    queryFn: () => body(api.GET("/api/v1/runs/{id}", { params: { path: { id } } })),
    staleTime: Infinity,
  });
}

export function useRunGoals(id: string) {
  return useQuery({
    queryKey: ["runs", id, "goals"],
    queryFn: () => body(api.GET("/api/v1/runs/{id}/goals", { params: { path: { id } } })),
    staleTime: Infinity,
  });
}

export function useConvergence(id: string) {
  return useQuery({
    queryKey: ["runs", id, "convergence"],
    queryFn: () =>
      body(api.GET("/api/v1/runs/{id}/convergence", { params: { path: { id }, query: { max_points: 1500 } } })),
    staleTime: Infinity,
  });
}

export function useRunTrajectory(id: string, enabled: boolean) {
  return useQuery({
    queryKey: ["runs", id, "trajectory"],
    enabled,
    queryFn: () => body(api.GET("/api/v1/runs/{id}/trajectory", { params: { path: { id } } })),
    staleTime: Infinity,
  });
}

export function useDemonstrations() {
  return useInfiniteQuery({
    queryKey: ["demonstrations"],
    initialPageParam: "",
    queryFn: ({ pageParam }) => body(api.GET("/api/v1/demonstrations", { params: { query: pageQuery(pageParam) } })),
    getNextPageParam: nextPage,
  });
}

export function useDemonstration(id: string) {
  return useQuery({
    queryKey: ["demonstrations", id],
    queryFn: () => body(api.GET("/api/v1/demonstrations/{id}", { params: { path: { id } } })),
  });
}

export function useSamples(id: string) {
  return useQuery({
    queryKey: ["demonstrations", id, "samples"],
    queryFn: () =>
      body(api.GET("/api/v1/demonstrations/{id}/samples", { params: { path: { id }, query: { max_points: 1200 } } })),
    staleTime: Infinity,
  });
}

export function useReport(id: string) {
  return useQuery({
    queryKey: ["demonstrations", id, "report"],
    queryFn: () => body(api.GET("/api/v1/demonstrations/{id}/report", { params: { path: { id } } })),
    staleTime: Infinity,
  });
}

export function useActions() {
  return useInfiniteQuery({
    queryKey: ["actions"],
    initialPageParam: "",
    queryFn: ({ pageParam }) => body(api.GET("/api/v1/actions", { params: { query: pageQuery(pageParam) } })),
    getNextPageParam: nextPage,
  });
}

export function useAction(id: string) {
  return useQuery({
    queryKey: ["actions", id],
    queryFn: () => body(api.GET("/api/v1/actions/{id}", { params: { path: { id } } })),
    staleTime: Infinity,
  });
}

export function useActionGoals(id: string) {
  return useQuery({
    queryKey: ["actions", id, "goals"],
    queryFn: () => body(api.GET("/api/v1/actions/{id}/goals", { params: { path: { id } } })),
    staleTime: Infinity,
  });
}

export function useInterpolation(id: string, n: number) {
  return useQuery({
    queryKey: ["actions", id, "interpolation", n],
    queryFn: () => body(api.GET("/api/v1/actions/{id}:interpolate", { params: { path: { id }, query: { n } } })),
    staleTime: Infinity,
  });
}

export function useRobots() {
  return useInfiniteQuery({
    queryKey: ["robots"],
    initialPageParam: "",
    queryFn: ({ pageParam }) => body(api.GET("/api/v1/robots", { params: { query: pageQuery(pageParam) } })),
    getNextPageParam: nextPage,
  });
}

export function useRobot(id: string | undefined) {
  return useQuery({
    queryKey: ["robots", id],
    enabled: id !== undefined,
    queryFn: () => body(api.GET("/api/v1/robots/{id}", { params: { path: { id: id ?? "" } } })),
    staleTime: Infinity,
  });
}

export function useUrdf(id: string | undefined) {
  return useQuery({
    queryKey: ["robots", id, "urdf"],
    enabled: id !== undefined,
    queryFn: () =>
      body(api.GET("/api/v1/robots/{id}/urdf", { params: { path: { id: id ?? "" } }, parseAs: "text" })),
    staleTime: Infinity,
  });
}

export function useWorlds() {
  return useInfiniteQuery({
    queryKey: ["worlds"],
    initialPageParam: "",
    queryFn: ({ pageParam }) => body(api.GET("/api/v1/worlds", { params: { query: pageQuery(pageParam) } })),
    getNextPageParam: nextPage,
  });
}

export function useWorld(id: string | undefined) {
  return useQuery({
    queryKey: ["worlds", id],
    enabled: id !== undefined,
    queryFn: () => body(api.GET("/api/v1/worlds/{id}", { params: { path: { id: id ?? "" } } })),
    staleTime: Infinity,
  });
}
