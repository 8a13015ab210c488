// Steps shared by several checks.

/** Opens the address the server printed. */
export async function signIn(page, server) {
  await page.goto(server.opening);
}

/** The number in the fact of a name, for example "Evaluations". */
export async function fact(page, name) {
  const value = await page.locator("dl.facts > div").filter({ has: page.getByText(name, { exact: true }) }).locator("dd").first().textContent();
  return Number(value.replaceAll(",", ""));
}

/** Longest wait for anything a page is expected to show, ms; an idle machine needs a fraction of a second. */
export const PATIENCE_MS = 60_000;

/** Waits until `met` answers true; `what` names the expectation in the error. */
export async function until(met, what) {
  const deadline = Date.now() + PATIENCE_MS;
  while (!(await met())) {
    if (Date.now() > deadline) throw new Error(`not within ${PATIENCE_MS / 1000} s: ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}
