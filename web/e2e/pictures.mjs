// Screenshots for docs/images, taken only on request.
import { mkdirSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { openPage } from "./browser.mjs";
import { startSlowJob } from "./data.mjs";
import { signIn } from "./steps.mjs";

const FOLDER = fileURLToPath(new URL("../../docs/images/", import.meta.url));

export async function pictures({ browser, server, data, screenshots }) {
  if (!screenshots) return;
  mkdirSync(FOLDER, { recursive: true });
  const page = await openPage(browser, { width: 1280, height: 820 });
  await signIn(page, server);
  const job = await startSlowJob(server, data, 700);
  await page.goto(`${server.url}/jobs/${job.id}`);
  await page.getByRole("listitem", { name: /^Goal 5, searching: \d{3} evaluations, best \d/ }).waitFor({ timeout: 60_000 });
  await page.screenshot({ path: `${FOLDER}dashboard.png` });
  await server.api("POST", `/jobs/${job.id}:cancel`);

  await page.goto(`${server.url}/runs/${data.paintJob.result.runs[0]}`);
  await page.locator(".viewer canvas").waitFor();
  await page.getByRole("slider", { name: "Time in the trajectory" }).focus();
  await page.keyboard.press("End");
  await page.waitForTimeout(1000);
  await page.locator("section:has(.viewer)").screenshot({ path: `${FOLDER}replay.png` });
  await page.context().close();
}
