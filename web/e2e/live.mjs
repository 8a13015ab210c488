// One job while it runs: numbers that grow, steering, a lost server.
import assert from "node:assert/strict";
import { openPage } from "./browser.mjs";
import { fill, startSlowJob } from "./data.mjs";
import { startServer } from "./server.mjs";
import { fact, signIn, until } from "./steps.mjs";

const state = (page, name) => page.locator(".badge").getByText(name, { exact: true }).waitFor();

/** Waits for more evaluations than `before`. */
async function grows(page, before) {
  const from = before ?? (await fact(page, "Evaluations"));
  await until(async () => (await fact(page, "Evaluations")) > from, `more than ${from} evaluations`);
}

async function steering({ browser, server, data }) {
  const job = await startSlowJob(server, data);
  const page = await openPage(browser);
  await signIn(page, server);
  await page.goto(`${server.url}/jobs/${job.id}`);
  await state(page, "Live");
  await grows(page);
  await page.locator(".rung.active").waitFor();
  await page.locator(".chart canvas").first().waitFor();

  await page.getByRole("button", { name: "Pause" }).click();
  await state(page, "Paused");
  await page.getByRole("button", { name: "Resume" }).click();
  await state(page, "Running");
  await grows(page);

  await page.getByRole("button", { name: "Cancel" }).click();
  await page.getByRole("button", { name: "Confirm cancel" }).click();
  await state(page, "Cancelled");
  assert.deepEqual(page.troubles, []);
  await page.context().close();
}

/** The page of a job outlives its server: it says how old its data is, and continues where it was. */
async function lostServer({ browser }) {
  const first = await startServer();
  const page = await openPage(browser);
  try {
    const own = await fill(first);
    // Slow enough to be unfinished, on any machine, when the page is paused at the end.
    const job = await startSlowJob(first, own, 200);
    await signIn(page, first);
    await page.goto(`${first.url}/jobs/${job.id}`);
    await state(page, "Live");
    await page.locator(".rung.done").first().waitFor();
    await first.kill();
    await page.getByText(/Data is .* old, reconnecting/).waitFor();
    await page.locator(".chart canvas").first().waitFor();
    const seen = await fact(page, "Evaluations");

    const second = await startServer({ dataDir: first.dataDir, listen: first.host });
    try {
      // The restarted server may have another token; its address signs the same browser in again.
      if (second.token !== first.token) {
        await signIn(page, second);
        await page.goto(`${second.url}/jobs/${job.id}`);
      }
      await state(page, "Live");
      await grows(page, seen);
      await page.getByRole("button", { name: "Pause" }).click();
      await state(page, "Paused");
      const { state: rests, progress } = await second.api("GET", `/jobs/${job.id}`);
      assert.equal(rests, "PAUSED");
      const told = progress.total_evaluations;
      await until(async () => (await fact(page, "Evaluations")) === told, `${told} evaluations`);
      assert.equal(await page.locator(".rung.done").count(), progress.finished_goals.length, "the ladder is complete");
      assert.ok(progress.finished_goals.length > 0);
    } finally {
      await second.stop();
    }
  } finally {
    await page.context().close();
    await first.stop();
  }
}

export const live = [
  { name: "live job: grows, pauses, resumes, cancels", run: steering },
  { name: "live job: outlives a killed server", run: lostServer },
];
