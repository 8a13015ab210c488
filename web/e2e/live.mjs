// One job while it runs: numbers that grow, steering, a lost server.
import assert from "node:assert/strict";
import { openPage } from "./browser.mjs";
import { fill, startSlowJob } from "./data.mjs";
import { startServer } from "./server.mjs";
import { fact, signIn } from "./steps.mjs";

const state = (page, name, timeout = 15_000) =>
  page.locator(".badge").getByText(name, { exact: true }).waitFor({ timeout });

async function grows(page) {
  const before = await fact(page, "Evaluations");
  await page.waitForFunction(
    (from) => {
      const facts = [...document.querySelectorAll("dl.facts > div")];
      const found = facts.find((each) => each.querySelector("dt")?.textContent === "Evaluations");
      return Number(found?.querySelector("dd")?.textContent?.replaceAll(",", "")) > from;
    },
    before,
  );
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

/** A server that dies while it is watched: the page says how old its data is, and goes on where it was. */
async function lostServer({ browser }) {
  const first = await startServer();
  const page = await openPage(browser);
  try {
    const own = await fill(first);
    const job = await startSlowJob(first, own, 1500);
    await signIn(page, first);
    await page.goto(`${first.url}/jobs/${job.id}`);
    await state(page, "Live");
    await grows(page);
    await first.kill();
    await page.getByText(/Data is .* old, reconnecting/).waitFor();

    const second = await startServer({ dataDir: first.dataDir, listen: first.host });
    try {
      // The restarted server may have another token; its address signs the same browser in again.
      if (second.token !== first.token) {
        await signIn(page, second);
        await page.goto(`${second.url}/jobs/${job.id}`);
      }
      await state(page, "Succeeded", 60_000).catch(async (error) => {
        const told = await second.api("GET", `/jobs/${job.id}`);
        throw new Error(`${error.message}; the server says ${told.state}, ${told.progress.total_evaluations} evaluations`);
      });
      const rungs = await page.locator(".rung.done").count();
      const told = await second.api("GET", `/jobs/${job.id}`);
      assert.equal(rungs, told.progress.goals, "the ladder is complete after the loss");
      assert.equal(await fact(page, "Evaluations"), told.progress.total_evaluations);
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
