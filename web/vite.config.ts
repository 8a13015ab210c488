import react from "@vitejs/plugin-react";
import { defineConfig } from "vitest/config";

// `npm run dev` proxies to a server started with `cgda serve --listen 127.0.0.1:8080`; open its token URL through vite.
const server = process.env["CGDA_URL"] ?? "http://127.0.0.1:8080";
const proxied = ["/api", "/openapi.json", "/livez", "/readyz"];

export default defineConfig({
  plugins: [react()],
  build: {
    target: "es2023",
    // three is one lazy chunk by itself; it is larger than the default warning limit.
    chunkSizeWarningLimit: 900,
    assetsInlineLimit: 0,
  },
  server: { proxy: Object.fromEntries(proxied.map((path) => [path, { target: server }])) },
  test: { include: ["src/**/*.test.ts", "src/**/*.test.tsx"], environment: "node" },
});
