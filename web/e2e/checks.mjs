// The dashboard's required behaviour, one check each.
import assert from "node:assert/strict";
import { accessibility, colours, openPage, overflow } from "./browser.mjs";
import { startSlowJob, waitForJob } from "./data.mjs";
import { live } from "./live.mjs";
import { pictures } from "./pictures.mjs";
import { signIn, until } from "./steps.mjs";

/** Every page, with a text that only it has once its data is there. */
const pagesOf = (data) => [
  { path: "/jobs", text: "loop" },
  { path: "/jobs/new", text: "Before you start" },
  { path: `/jobs/${data.loopJob.id}`, text: "Succeeded" },
  { path: `/jobs/${data.fewJob.id}`, text: "was made for goal" },
  { path: `/runs/${data.loopJob.result.runs[0]}`, text: "goals passed" },
  { path: `/runs/${data.paintJob.result.runs[0]}`, text: "cells painted" },
  { path: "/demonstrations", text: "loop-1" },
  { path: `/demonstrations/${data.demonstration}`, text: "Findings" },
  { path: "/actions", text: "paint" },
  { path: `/actions/${data.loop}`, text: "Execute on a robot" },
  { path: "/robots", text: "wall of 4 x 4" },
  { path: `/robots/${data.robot}`, text: "shoulder_roll" },
  { path: "/no/such/page", text: "Page not found" },
];

async function everyPage({ browser, server, data }) {
  for (const shape of [
    { width: 1280, scheme: "light" },
    { width: 1280, scheme: "dark" },
    { width: 390, height: 844, scheme: "light" },
    { width: 390, height: 844, scheme: "dark" },
  ]) {
    const page = await openPage(browser, shape);
    await signIn(page, server);
    for (const { path, text } of pagesOf(data)) {
      const place = `${path} at ${shape.width} px, ${shape.scheme}`;
      await page.goto(server.url + path);
      await page.getByText(text).first().waitFor();
      await page.waitForLoadState("networkidle").catch(() => {});
      assert.equal(await overflow(page), 0, `${place} is wider than the screen`);
      assert.deepEqual(await accessibility(page), [], place);
    }
    assert.deepEqual(page.troubles, []);
    await page.context().close();
  }
}

async function token({ browser, server }) {
  const page = await openPage(browser);
  const refused = await page.goto(`${server.url}/jobs`);
  assert.equal(refused.status(), 401);
  assert.match(await page.textContent("body"), /\?token=/, "the refusal says where to find the address");
  await signIn(page, server);
  assert.ok(!page.url().includes("token"), "the token stays in the address");
  await page.getByRole("heading", { name: "Jobs" }).waitFor();
  const stranger = await page.evaluate(async () => {
    const answer = await fetch("/api/v1/nothing", { headers: { accept: "text/html" } });
    return [answer.status, answer.headers.get("content-type"), (await answer.json()).code];
  });
  assert.deepEqual(stranger.slice(0, 2), [404, "application/problem+json"]);
  await page.context().close();
}

async function signedOut({ browser, server }) {
  const page = await openPage(browser);
  await signIn(page, server);
  await page.getByRole("heading", { name: "Jobs" }).waitFor();
  await page.context().clearCookies();
  await page.getByRole("link", { name: "Robots" }).click();
  await page.getByRole("heading", { name: "This browser has no valid token" }).waitFor();
  await page.context().close();
}

async function replay({ browser, server, data }) {
  const page = await openPage(browser);
  await signIn(page, server);
  await page.goto(`${server.url}/runs/${data.loopJob.result.runs[0]}`);
  await page.locator(".viewer canvas").waitFor();
  await until(async () => (await colours(page, ".viewer canvas")) > 50, "a 3-D view that is not blank");
  const goals = data.loopJob.progress.goals;

  const time = page.getByRole("slider", { name: "Time in the trajectory" });
  await time.focus();
  await page.keyboard.press("End");
  await page.getByText(`${goals} of ${goals} goals passed`).waitFor();
  await page.keyboard.press("Home");
  await page.getByText(`0 of ${goals} goals passed`).waitFor();
  await page.getByRole("combobox", { name: "Speed" }).selectOption("4");
  await page.getByRole("button", { name: "Play" }).press("Enter");
  await page.getByText(`${goals} of ${goals} goals passed`).waitFor();
  await page.getByRole("button", { name: "Play" }).waitFor();

  assert.ok((await server.api("GET", `/runs/${data.loopJob.result.runs[0]}`)).trajectory, "the run has a trajectory");
  for (const format of ["CSV", "JSON", "ROS 2"]) {
    const waiting = page.waitForEvent("download");
    await page.getByRole("link", { name: format, exact: true }).click();
    assert.equal(await (await waiting).failure(), null, `the trajectory as ${format}`);
  }
  assert.deepEqual(page.troubles, []);
  await page.context().close();
}

/** Code that is loaded on first use may fail to load: the part that needs it says so, the page stays. */
async function lostCode({ browser, server, data }) {
  const page = await openPage(browser);
  await signIn(page, server);
  await page.route(/\/assets\/RobotViewer-.*\.js/, (route) => route.abort());
  await page.goto(`${server.url}/robots/${data.robot}`);
  await page.getByRole("alert").getByText("The 3-D view could not be loaded").waitFor();
  await page.getByRole("slider", { name: /shoulder_pitch/ }).waitFor();
  await page.context().close();
}

/** The browser's own kinematics and coverage agree with what the server painted. */
async function coverage({ browser, server, data }) {
  const page = await openPage(browser);
  await signIn(page, server);
  for (const id of data.paintJob.result.runs) {
    const run = await server.api("GET", `/runs/${id}`);
    await page.goto(`${server.url}/runs/${id}`);
    await page.getByRole("slider", { name: "Time in the trajectory" }).focus();
    await page.keyboard.press("End");
    await page.getByText(`${(run.painted_percent * 16) / 100} of 16 cells painted`).waitFor();
  }
  assert.deepEqual(page.troubles, []);
  await page.context().close();
}

async function demonstrationsToJob({ browser, server }) {
  const page = await openPage(browser);
  await signIn(page, server);
  await page.goto(`${server.url}/demonstrations`);
  const bad = { name: "ragged.csv", mimeType: "text/csv", buffer: Buffer.from("time_s,painted [%]\n0,0\n1\n2,nan\n") };
  await page.getByLabel("Files to upload").setInputFiles(bad);
  const refusal = page.getByRole("alert");
  await refusal.getByText("ragged was rejected").waitFor();
  assert.match(await refusal.textContent(), /row|3/, "the refusal names the place");
  page.troubles = page.troubles.filter((trouble) => !trouble.includes("422"));

  const rows = (pace) => Array.from({ length: 50 }, (_, step) => `${(step * pace).toFixed(2)},${step * 2}`).join("\n");
  const good = (name, pace) => ({ name, mimeType: "text/csv", buffer: Buffer.from(`time_s,painted [%]\n${rows(pace)}\n`) });
  await page.getByLabel("Files to upload").setInputFiles([good("rollers-1.csv", 0.2), good("rollers-2.csv", 0.21)]);
  await page.getByText("rollers-2 was imported").waitFor();
  await page.getByRole("checkbox", { name: "Select rollers-1" }).check();
  await page.getByRole("checkbox", { name: "Select rollers-2" }).check();
  await page.getByLabel("Name of the action").fill("rollers");
  await page.getByLabel("Min. time between goals").fill("2");
  await page.getByText("gives about 5 goals").waitFor();
  await page.getByRole("button", { name: "Generalize" }).click();
  await page.getByRole("link", { name: "Open the action" }).click();
  await page.getByRole("link", { name: "Execute on a robot" }).click();

  await page.getByLabel("Robot", { exact: true }).selectOption({ index: 1 });
  await page.getByLabel("World").selectOption({ label: "wall of 4 x 4 (painted)" });
  assert.equal(await page.getByLabel("Method", { exact: true }).inputValue(), "particle", "a wall suggests its method");
  await page.getByLabel("Method", { exact: true }).selectOption("sst");
  assert.equal(await page.getByLabel("Population").inputValue(), "10", "a wall suggests a small population");
  await page.getByText("Estimated evaluations").waitFor();
  await page.getByLabel("Seed").fill("5");
  await page.getByRole("button", { name: "Start job" }).click();
  await page.getByText("Succeeded", { exact: true }).waitFor();
  const id = page.url().split("/").at(-1);
  assert.equal((await server.api("GET", `/jobs/${id}`)).request.seed, 5);
  assert.deepEqual(page.troubles, []);
  await page.context().close();
}

async function jobsListIsLive({ browser, server, data }) {
  const page = await openPage(browser);
  await signIn(page, server);
  await page.getByRole("heading", { name: "Jobs" }).waitFor();
  const job = await startSlowJob(server, data);
  const row = page.getByRole("row").filter({ has: page.locator(`a[href="/jobs/${job.id}"]`) });
  await row.getByText("Running").waitFor();
  await server.api("POST", `/jobs/${job.id}:cancel`);
  await row.getByText("Cancelled").waitFor();
  await waitForJob(server, job.id);
  assert.deepEqual(page.troubles, []);
  await page.context().close();
}

async function keyboard({ browser, server, data }) {
  const page = await openPage(browser);
  await signIn(page, server);
  await page.getByRole("heading", { name: "Jobs" }).waitFor();
  await page.keyboard.press("Tab");
  assert.equal(await page.evaluate(() => document.activeElement?.textContent), "Skip to content");
  await page.goto(`${server.url}/robots/${data.robot}`);
  const slider = page.getByRole("slider", { name: /shoulder_pitch/ });
  await slider.focus();
  await page.keyboard.press("End");
  assert.equal(await slider.getAttribute("aria-valuetext"), "100°", "the limit of the URDF");
  assert.deepEqual(page.troubles, []);
  await page.context().close();
}

export const CHECKS = [
  { name: "the token's address signs in, unknown API paths answer with problems", run: token },
  { name: "without a token the page says where to find one", run: signedOut },
  { name: "jobs list follows jobs", run: jobsListIsLive },
  ...live,
  { name: "replay plays, scrubs and exports", run: replay },
  { name: "a page outlives code that cannot be loaded", run: lostCode },
  { name: "coverage agrees with the server", run: coverage },
  { name: "demonstrations to job by hand", run: demonstrationsToJob },
  { name: "keyboard reaches", run: keyboard },
  { name: "every page: content, WCAG AA, no overflow, no console error", run: everyPage },
  { name: "pictures", run: pictures },
];
