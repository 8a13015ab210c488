// Fails when the generated client types are stale. src/api/schema.d.ts is not committed (thousands of lines): it is
// generated from the committed openapi.json before build, lint and typecheck; `cgda openapi` is held equal to openapi.json by
// the server's own tests. With CGDA_BIN=path/to/cgda this script compares that end as well.
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import openapiTS, { astToString } from "openapi-typescript";

const root = new URL("..", import.meta.url);
const document = new URL("openapi.json", root);
const types = new URL("src/api/schema.d.ts", root);

// The command line prepends a header; the types themselves begin at the first export.
const body = (text) => text.slice(text.indexOf("export ")).trim();

function fail(message) {
  console.error(message);
  process.exitCode = 1;
}

const fresh = astToString(await openapiTS(JSON.parse(readFileSync(document, "utf8"))));
if (!existsSync(types)) fail("src/api/schema.d.ts is missing: run `npm run generate`");
else if (body(readFileSync(types, "utf8")) !== body(fresh)) fail("src/api/schema.d.ts is stale: run `npm run generate`");

const binary = process.env["CGDA_BIN"];
if (binary) {
  const served = JSON.parse(execFileSync(binary, ["openapi"], { encoding: "utf8" }));
  const committed = JSON.parse(readFileSync(document, "utf8"));
  if (JSON.stringify(served) !== JSON.stringify(committed))
    fail("openapi.json differs from `cgda openapi`: run `cargo run -- openapi > web/openapi.json`");
}
if (!process.exitCode) console.log("client types match openapi.json");
