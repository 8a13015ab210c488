// Formatting of values for display. Every function takes SI, or the unit in its name, and returns text.

const MISSING = "–";

const integers = new Intl.NumberFormat("en-GB", { maximumFractionDigits: 0 });

/** 9679 -> "9,679". */
export function formatCount(value: number | null | undefined): string {
  return value == null || !Number.isFinite(value) ? MISSING : integers.format(value);
}

/** Four significant digits, no exponent between 0.001 and a million: 273.5123 -> "273.5", 0.00001234 -> "1.234e-5". */
export function formatNumber(value: number | null | undefined, digits = 4): string {
  if (value == null || Number.isNaN(value)) return MISSING;
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  if (value === 0) return "0";
  const magnitude = Math.abs(value);
  if (magnitude < 1e-3 || magnitude >= 1e6) return value.toExponential(digits - 1).replace("e+", "e");
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(magnitude)));
  return integersOr(value, decimals);
}

function integersOr(value: number, decimals: number): string {
  return new Intl.NumberFormat("en-GB", { maximumFractionDigits: decimals }).format(value);
}

/** A value with its unit, if it has one: (94.4, "%") -> "94.4 %". */
export function formatQuantity(value: number | null | undefined, unit: string | null | undefined, digits = 4): string {
  const text = formatNumber(value, digits);
  return unit && text !== MISSING ? `${text}\u202f${unit}` : text;
}

/** 0.42 -> "0.42 s", 75 -> "1 min 15 s", 7300 -> "2 h 1 min". */
export function formatDuration(seconds: number | null | undefined): string {
  if (seconds == null || !Number.isFinite(seconds) || seconds < 0) return MISSING;
  if (seconds < 10) return `${formatNumber(seconds, 2)} s`;
  const whole = Math.round(seconds);
  if (whole < 60) return `${whole} s`;
  if (whole < 3600) return joinUnits(Math.floor(whole / 60), "min", whole % 60, "s");
  if (whole < 86_400) return joinUnits(Math.floor(whole / 3600), "h", Math.floor((whole % 3600) / 60), "min");
  return joinUnits(Math.floor(whole / 86_400), "d", Math.floor((whole % 86_400) / 3600), "h");
}

function joinUnits(large: number, largeUnit: string, small: number, smallUnit: string): string {
  return small === 0 ? `${large} ${largeUnit}` : `${large} ${largeUnit} ${small} ${smallUnit}`;
}

/** "just now", "12 s ago", "3 min ago"; the date if older. */
export function formatAgo(atMs: number | null | undefined, nowMs: number): string {
  if (atMs == null) return MISSING;
  const seconds = Math.round((nowMs - atMs) / 1000);
  if (seconds < 5) return "just now";
  if (seconds < 60) return `${seconds} s ago`;
  if (seconds < 3600) return `${Math.floor(seconds / 60)} min ago`;
  if (seconds < 86_400) return `${Math.floor(seconds / 3600)} h ago`;
  return formatDateTime(atMs);
}

/** Local date and time to the second, sortable: "2026-11-22 01:10:44". */
export function formatDateTime(atMs: number | null | undefined): string {
  if (atMs == null) return MISSING;
  const date = new Date(atMs);
  const two = (n: number) => String(n).padStart(2, "0");
  const day = `${date.getFullYear()}-${two(date.getMonth() + 1)}-${two(date.getDate())}`;
  return `${day} ${two(date.getHours())}:${two(date.getMinutes())}:${two(date.getSeconds())}`;
}

/** A share between 0 and 1 as whole percent, rounded down so that 100 % means done: 0.999 -> "99 %". */
export function formatPercent(share: number): string {
  const bounded = Math.min(1, Math.max(0, share));
  return `${Math.floor(bounded * 100 + 1e-9)}\u202f%`;
}

/** snake_case or UPPER_CASE from the server as words: "max_evaluations" -> "max evaluations". */
export function humanize(code: string | null | undefined): string {
  return code ? code.replace(/[_-]+/g, " ").toLowerCase() : MISSING;
}

/** Bytes with a decimal unit: 56578 -> "57 kB". */
export function formatBytes(bytes: number): string {
  if (bytes < 1000) return `${bytes} B`;
  if (bytes < 1e6) return `${formatNumber(bytes / 1e3, 2)} kB`;
  return `${formatNumber(bytes / 1e6, 2)} MB`;
}
