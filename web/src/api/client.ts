// The only client of the REST API, typed by openapi.json. Every failure is an ApiError.

import createClient from "openapi-fetch";
import type { paths } from "./schema";
import { session } from "./session";

/** One invalid field of a request. */
export interface WrongPlace {
  pointer: string;
  code: string;
  detail: string;
}

/** A rejected or failed request: RFC 9457 problem details, or whatever is known if the response has none. */
export class ApiError extends Error {
  readonly status: number;
  readonly code: string;
  readonly requestId: string | undefined;
  readonly errors: readonly WrongPlace[];

  constructor(status: number, code: string, message: string, requestId?: string, errors: readonly WrongPlace[] = []) {
    super(message);
    this.name = "ApiError";
    this.status = status;
    this.code = code;
    this.requestId = requestId;
    this.errors = errors;
  }
}

/** Parses problem details of any shape; never throws. */
export function problemFrom(status: number, body: unknown): ApiError {
  const problem = typeof body === "object" && body !== null ? (body as Record<string, unknown>) : {};
  const text = (key: string) => (typeof problem[key] === "string" ? problem[key] : undefined);
  const message = text("detail") ?? text("title") ?? `the server answered ${status}`;
  const places = Array.isArray(problem["errors"]) ? (problem["errors"] as WrongPlace[]) : [];
  return new ApiError(status, text("code") ?? "unknown", message, text("request_id"), places);
}

async function checkedFetch(request: Request): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(request);
  } catch (cause) {
    if (request.signal.aborted) throw cause;
    throw new ApiError(0, "unreachable", "the server cannot be reached; is it running?");
  }
  if (response.status === 401) session.signOut();
  if (response.ok) return response;
  throw problemFrom(response.status, await response.json().catch(() => null));
}

export const api = createClient<paths>({ fetch: checkedFetch });

/** Unwraps the body of a successful response; throws an ApiError otherwise. */
export async function body<T>(answer: Promise<{ data?: T }>): Promise<T> {
  const { data } = await answer;
  if (data === undefined) throw new ApiError(0, "empty_answer", "the server sent an empty answer");
  return data;
}
