import { describe, expect, it } from "vitest";
import { SseParser, backoffMs } from "./sse";

describe("SseParser", () => {
  it("reads events whatever the chunking", () => {
    const stream = 'id: 7\nevent: progress\ndata: {"a":\ndata: 1}\n\n: ping\n\nid: 8\r\ndata:x\r\n\r\n';
    const whole = new SseParser().push(stream);
    const bytewise = new SseParser();
    const pieces = stream.split(/(?:)/).flatMap((character) => bytewise.push(character));
    expect(whole).toEqual([
      { id: "7", type: "progress", data: '{"a":\n1}' },
      { id: "8", type: "message", data: "x" },
    ]);
    expect(pieces).toEqual(whole);
  });

  it("keeps the last id for events without one, and forgets the event name", () => {
    const events = new SseParser().push("id: 3\nevent: state\ndata: a\n\ndata: b\n\n");
    expect(events[1]).toEqual({ id: "3", type: "message", data: "b" });
  });

  it("dispatches nothing for comments and for events without data", () => {
    expect(new SseParser().push(": ping\n\nevent: x\n\n")).toEqual([]);
  });

  it("holds an unfinished event back", () => {
    const parser = new SseParser();
    expect(parser.push("data: half")).toEqual([]);
    expect(parser.push(" done\n\n")).toEqual([{ id: "", type: "message", data: "half done" }]);
  });
});

describe("backoffMs", () => {
  it("grows to its ceiling and stays there", () => {
    expect(backoffMs(0, 0)).toBe(250);
    expect(backoffMs(3, 0.5)).toBe(3000);
    expect(backoffMs(50, 0.999)).toBeLessThanOrEqual(15_000);
  });
});
