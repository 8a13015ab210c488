import { describe, expect, it } from "vitest";
import * as format from "./format";

describe("numbers", () => {
  it.each([
    [273.5123, "273.5"],
    [0.0063074, "0.006307"],
    [0.00001234, "1.234e-5"],
    [9679.4, "9,679"],
    [1_234_567, "1.235e6"],
    [-0.5, "-0.5"],
    [0, "0"],
    [Number.POSITIVE_INFINITY, "∞"],
    [Number.NaN, "–"],
    [null, "–"],
  ])("%s is written %s", (value, text) => {
    expect(format.formatNumber(value)).toBe(text);
  });

  it("leaves out an empty unit and the unit of a missing value", () => {
    expect(format.formatQuantity(94.4, "%")).toBe("94.4\u202f%");
    expect(format.formatQuantity(94.4, "")).toBe("94.4");
    expect(format.formatQuantity(undefined, "mm")).toBe("–");
  });

  it("groups thousands of counts", () => {
    expect(format.formatCount(1_234_567)).toBe("1,234,567");
  });

  it("never says 100 % before the end", () => {
    expect(format.formatPercent(0.9999)).toBe("99\u202f%");
    expect(format.formatPercent(1)).toBe("100\u202f%");
    expect(format.formatPercent(1.2)).toBe("100\u202f%");
    expect(format.formatPercent(0.29)).toBe("29\u202f%");
  });
});

describe("times", () => {
  it.each([
    [0.421, "0.42 s"],
    [59.6, "1 min"],
    [75, "1 min 15 s"],
    [3600, "1 h"],
    [7300, "2 h 1 min"],
    [90_000, "1 d 1 h"],
    [-1, "–"],
  ])("%d s is written %s", (seconds, text) => {
    expect(format.formatDuration(seconds)).toBe(text);
  });

  it("says how long ago", () => {
    const now = 1_000_000_000;
    expect(format.formatAgo(now - 1000, now)).toBe("just now");
    expect(format.formatAgo(now - 12_000, now)).toBe("12 s ago");
    expect(format.formatAgo(now - 200_000, now)).toBe("3 min ago");
    expect(format.formatAgo(undefined, now)).toBe("–");
  });
});

it("turns codes into words", () => {
  expect(format.humanize("OUT_OF_REACH")).toBe("out of reach");
  expect(format.humanize(undefined)).toBe("–");
});

it("writes sizes", () => {
  expect(format.formatBytes(56_578)).toBe("57 kB");
  expect(format.formatBytes(12)).toBe("12 B");
});
