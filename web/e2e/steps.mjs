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
