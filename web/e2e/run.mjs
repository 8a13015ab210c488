// The dashboard in a real browser against the real server: `npm run test:e2e [-- --screenshots]`.
//
// Each check opens pages as a person would, and fails on wrong content, any console error, any WCAG A or AA violation, and
// anything wider than the screen. With --screenshots, docs/images is updated.
import { CHECKS } from "./checks.mjs";
import { launch } from "./browser.mjs";
import { fill } from "./data.mjs";
import { startServer } from "./server.mjs";

const only = process.argv.slice(2).filter((argument) => !argument.startsWith("--"));
const screenshots = process.argv.includes("--screenshots");

const server = await startServer();
const browser = await launch();
let passed = 0;
const failures = [];
try {
  const data = await fill(server);
  for (const { name, run } of CHECKS) {
    if (only.length > 0 && !only.some((word) => name.includes(word))) continue;
    const started = Date.now();
    try {
      await run({ browser, server, data, screenshots });
      passed += 1;
      console.log(`ok   ${name} (${Date.now() - started} ms)`);
    } catch (error) {
      failures.push(name);
      console.log(`FAIL ${name}\n     ${String(error.stack ?? error).replaceAll("\n", "\n     ")}`);
    }
  }
} finally {
  await browser.close();
  await server.stop();
}
if (failures.length > 0) console.log(`\nthe server's last words:\n${server.log.join("").slice(-4000)}`);
console.log(`\n${passed} passed, ${failures.length} failed`);
process.exitCode = failures.length > 0 || passed === 0 ? 1 : 0;
