# syntax=docker/dockerfile:1
# One static-enough binary with the dashboard inside, run by an ordinary user.
FROM node:22-bookworm-slim AS web
WORKDIR /src/web
COPY web/package.json web/package-lock.json ./
RUN npm ci --no-audit --no-fund
COPY web/ ./
COPY examples/ ../examples/
RUN npm run build

FROM rust:1.95-bookworm AS build
WORKDIR /src
COPY Cargo.toml Cargo.lock build.rs ./
COPY proto/ proto/
COPY migrations/ migrations/
COPY benches/ benches/
COPY examples/ examples/
COPY src/ src/
COPY --from=web /src/web/dist/ web/dist/
RUN cargo build --locked --profile dist --features embed-web --bin cgda

FROM debian:bookworm-slim
RUN useradd --system --uid 10001 --home-dir /var/lib/cgda --create-home cgda
COPY --from=build /src/target/dist/cgda /usr/local/bin/cgda
USER 10001
VOLUME ["/var/lib/cgda"]
EXPOSE 8080
ENV CGDA_SERVER__DATA_DIR=/var/lib/cgda CGDA_SERVER__LISTEN=0.0.0.0:8080 CGDA_SERVER__ALLOW_REMOTE=true
HEALTHCHECK --interval=10s --timeout=3s --start-period=20s CMD ["/usr/local/bin/cgda", "healthcheck", "--address", "127.0.0.1:8080"]
ENTRYPOINT ["/usr/local/bin/cgda"]
CMD ["serve"]
