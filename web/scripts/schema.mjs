// Makes the client's types and the bounds of its forms of openapi.json: `node scripts/schema.mjs`; with --check it only
// looks whether they are stale.
//
// src/api/schema.d.ts is thousands of lines and therefore not committed, nor is src/api/bounds.ts: they are made before
// build, lint, typecheck and tests. openapi.json is committed; the server's tests hold it equal to `cgda openapi`, and
// so does --check with CGDA_BIN=path.
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import openapiTS, { astToString } from "openapi-typescript";

const source = new URL("../openapi.json", import.meta.url);
const HEADER = "// Made of openapi.json by `npm run generate`. Not committed.\n\n";

const document = JSON.parse(readFileSync(source, "utf8"));
// A field with a default may be left out of a request.
const types = HEADER + astToString(await openapiTS(document, { defaultNonNullable: false }));

const KEYWORDS = ["minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum", "minLength", "maxLength"];

/** What every count has. */
const NOT_NEGATIVE = JSON.stringify({ minimum: 0 });

/** The bounds of each component's properties, where there is more to say than that a count is not negative. */
function boundsOf(schemas) {
  const bounded = (property) => KEYWORDS.filter((keyword) => keyword in property).map((keyword) => [keyword, property[keyword]]);
  const entries = Object.entries(schemas).map(([name, { properties = {} }]) => {
    const fields = Object.entries(properties).map(([field, property]) => [field, Object.fromEntries(bounded(property))]);
    return [name, Object.fromEntries(fields.filter(([, bounds]) => !["{}", NOT_NEGATIVE].includes(JSON.stringify(bounds))))];
  });
  return Object.fromEntries(entries.filter(([, fields]) => Object.keys(fields).length > 0));
}

const bounds = `${HEADER}export const bounds = ${JSON.stringify(boundsOf(document.components.schemas), null, 2)} as const;\n`;

function fail(message) {
  console.error(message);
  process.exitCode = 1;
}

const checking = process.argv.includes("--check");
for (const [name, fresh] of [["schema.d.ts", types], ["bounds.ts", bounds]]) {
  const target = new URL(`../src/api/${name}`, import.meta.url);
  const present = existsSync(target) ? readFileSync(target, "utf8") : null;
  if (present === null || !checking) writeFileSync(target, fresh);
  else if (present !== fresh) fail(`src/api/${name} is stale: run \`npm run generate\``);
}

const binary = process.env["CGDA_BIN"];
if (checking && binary) {
  const told = JSON.parse(execFileSync(binary, ["openapi"], { encoding: "utf8", maxBuffer: 64 << 20 }));
  if (JSON.stringify(told) !== JSON.stringify(document)) fail("openapi.json is stale: run `make openapi`");
}
if (checking && !process.exitCode) console.log("the client's types match openapi.json");
