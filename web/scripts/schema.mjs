// Makes the client's types of openapi.json: `node scripts/schema.mjs`; with --check it only looks whether they are stale.
//
// src/api/schema.d.ts is thousands of lines and therefore not committed: it is made before build, lint and typecheck.
// openapi.json is committed; the server's tests hold it equal to `cgda openapi`, and so does --check with CGDA_BIN=path.
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import openapiTS, { astToString } from "openapi-typescript";

const source = new URL("../openapi.json", import.meta.url);
const target = new URL("../src/api/schema.d.ts", import.meta.url);
const HEADER = "// Made of openapi.json by `npm run generate`. Not committed.\n\n";

const document = JSON.parse(readFileSync(source, "utf8"));
// A field with a default may be left out of a request.
const fresh = HEADER + astToString(await openapiTS(document, { defaultNonNullable: false }));

function fail(message) {
  console.error(message);
  process.exitCode = 1;
}

const checking = process.argv.includes("--check");
const present = existsSync(target) ? readFileSync(target, "utf8") : null;
if (present === null || !checking) writeFileSync(target, fresh);
else if (present !== fresh) fail("src/api/schema.d.ts is stale: run `npm run generate`");

const binary = process.env["CGDA_BIN"];
if (checking && binary) {
  const told = JSON.parse(execFileSync(binary, ["openapi"], { encoding: "utf8", maxBuffer: 64 << 20 }));
  if (JSON.stringify(told) !== JSON.stringify(document)) fail("openapi.json is stale: run `make openapi`");
}
if (checking && !process.exitCode) console.log("the client's types match openapi.json");
