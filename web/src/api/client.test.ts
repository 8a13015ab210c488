import { describe, expect, it } from "vitest";
import { problemFrom } from "./client";

describe("problemFrom", () => {
  it("reads RFC 9457 problem details", () => {
    const error = problemFrom(422, {
      code: "invalid_job",
      detail: "population is 2: at least 3 are needed",
      request_id: "r1",
      errors: [{ pointer: "/execution/method/population", code: "too_small", detail: "2 < 3" }],
    });
    expect(error.message).toBe("population is 2: at least 3 are needed");
    expect([error.status, error.code, error.requestId]).toEqual([422, "invalid_job", "r1"]);
    expect(error.errors[0]?.pointer).toBe("/execution/method/population");
  });

  it("makes do with any other answer", () => {
    expect(problemFrom(502, null).message).toBe("the server answered 502");
    expect(problemFrom(500, { title: "Internal Server Error", errors: "x" }).message).toBe("Internal Server Error");
  });
});
