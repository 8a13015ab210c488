// Starts the real binary on a free port with a fresh data directory, and talks to it as a script would.
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";

const ROOT = fileURLToPath(new URL("../../", import.meta.url));
export const BINARY = process.env["CGDA_BIN"] ?? join(ROOT, "target/debug/cgda");

/** A running server: `url` (the origin), `opening` (the printed address with its token), `api`, `kill`, `stop`. */
export async function startServer(options = {}) {
  if (!existsSync(BINARY)) throw new Error(`${BINARY} is missing: run \`cargo build\`, or set CGDA_BIN`);
  const dataDir = options.dataDir ?? mkdtempSync(join(tmpdir(), "cgda-e2e-"));
  const args = ["serve", "--data-dir", dataDir, "--listen", options.listen ?? "127.0.0.1:0"];
  const child = spawn(BINARY, args, { cwd: ROOT, stdio: ["ignore", "pipe", "pipe"] });
  const log = [];
  child.stderr.on("data", (chunk) => log.push(String(chunk)));
  const opening = await openingAddress(child, log);
  const address = new URL(opening);
  const token = address.searchParams.get("token");

  const api = async (method, path, body, headers = {}) => {
    const json = body !== undefined && !(body instanceof FormData);
    const response = await fetch(`${address.origin}/api/v1${path}`, {
      method,
      headers: { authorization: `Bearer ${token}`, ...(json ? { "content-type": "application/json" } : {}), ...headers },
      body: json ? JSON.stringify(body) : body,
    });
    const text = await response.text();
    if (!response.ok) throw new Error(`${method} ${path}: ${response.status} ${text}`);
    return text === "" ? null : JSON.parse(text);
  };
  const ended = new Promise((resolve) => child.once("exit", resolve));
  const kill = async (signal = "SIGKILL") => {
    child.kill(signal);
    await ended;
  };
  const stop = async () => {
    if (child.exitCode === null && child.signalCode === null) await kill("SIGTERM");
    rmSync(dataDir, { recursive: true, force: true });
  };
  return { url: address.origin, host: address.host, opening, token, dataDir, api, kill, stop, log };
}

function openingAddress(child, log) {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(() => reject(new Error(`no address within 60 s:\n${log.join("")}`)), 60_000);
    createInterface({ input: child.stdout }).on("line", (line) => {
      const found = /https?:\/\/\S+[?&]token=\S+/.exec(line);
      if (found === null) return;
      clearTimeout(timer);
      resolve(found[0]);
    });
    child.once("exit", (code) => reject(new Error(`the server ended with ${code}:\n${log.join("")}`)));
  });
}
